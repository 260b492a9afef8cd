//! The steps that are possible in a state of the fleet.

use crate::actors::{Actors, HEAD, Prospects};
use crate::batch::{Batch, Site};
use crate::bounds::{Bounds, Clocks, Left};
use crate::code::{Code, Kind};
use crate::level::Level;
use crate::robots::{NOTHING, Robots};
use crate::table::Rows;
use crate::watch::{Checkers, Watches};
use starl_core::RobotId;
use starl_properties::Violation;

/// The property that is violated where nothing can happen any more and not all robots have finished.
pub const STUCK: &str = "explore.stuck";

/// A batch has about this many steps.
const MOST_STEPS: usize = 1 << 13;

/// The states of robots and of checkers, and their successors.
#[derive(Clone)]
pub(crate) struct Expander {
    pub bounds: Bounds,
    pub robots: Robots,
    pub actors: Actors,
    pub watches: Watches,
    /// The states of the checkers, and the remaining bounds.
    pub heads: Rows,
    /// Whether a step that only adds datagrams is the only one of its state: see [`crate::grow`].
    pub grows_first: bool,
    /// The row at hand.
    row: Vec<u32>,
    /// The group of the row at hand.
    group: Vec<u32>,
}

/// A state that is expanded.
struct Origin<'a> {
    state: u32,
    /// The place of its first step in the batch.
    first: usize,
    row: &'a [u32],
    /// The state of the checkers.
    watch: u32,
    left: Left,
    is_held: bool,
    /// A step of it only adds datagrams.
    grows: bool,
    violation: Option<(Code, Violation)>,
    batch: &'a mut Batch,
}

impl Expander {
    pub fn new(bounds: Bounds, robots: Robots, checkers: Checkers) -> Expander {
        Expander {
            bounds,
            robots,
            actors: Actors::new(bounds),
            watches: Watches::new(checkers),
            heads: Rows::new(1 + Left::WORDS, 0),
            grows_first: false,
            row: Vec::new(),
            group: Vec::new(),
        }
    }

    /// Fills a batch with the steps of the next states of a level. It has none if the level has none, or if there are
    /// too many kinds of datagrams.
    pub fn fill(&mut self, level: &mut Level, batch: &mut Batch) {
        batch.clear();
        while batch.len() < MOST_STEPS
            && batch.contradiction.is_none()
            && !self.robots.is_full()
            && let Some((state, row)) = level.next()
        {
            let is_violated = self.expand(state, row, batch);
            let doubt = self.robots.doubt.as_ref();
            batch.contradiction = doubt.and_then(|doubt| doubt.contradiction.clone());
            if is_violated {
                break;
            }
        }
    }

    /// Adds the steps of a state. True if one of them violates something, and is the last one.
    fn expand(&mut self, state: u32, row: &[u32], batch: &mut Batch) -> bool {
        let (watch, left) = self.head(row[0]);
        let mut origin = Origin {
            state,
            first: batch.len(),
            row,
            watch,
            left,
            is_held: false,
            grows: false,
            violation: None,
            batch,
        };
        self.steps(&mut origin);
        let Origin {
            is_held, violation, ..
        } = origin;
        let is_violated = violation.is_some();
        batch.sites.push(Site {
            state,
            end: batch.len(),
            is_held,
            violation,
        });
        is_violated
    }

    /// The step from the state with one row to that with another.
    pub fn code(&mut self, from: &[u32], to: &[u32]) -> Option<Code> {
        let mut batch = Batch::new(from.len());
        self.expand(0, from, &mut batch);
        batch.code_to(to)
    }

    fn steps(&mut self, origin: &mut Origin<'_>) {
        let mut ticked = Vec::with_capacity(origin.row.len());
        for place in HEAD..origin.row.len() {
            let prospects = self.actors.prospects(origin.row[place], &mut self.robots);
            ticked.push(prospects.ticked);
            self.moves(origin, place, prospects);
            if origin.violation.is_some() || origin.grows {
                return;
            }
        }
        self.ticks(origin, &ticked);
    }

    /// One robot moves.
    fn moves(&mut self, origin: &mut Origin<'_>, place: usize, prospects: Prospects) {
        for index in 0..self.actors.moves(prospects).len() {
            let step = self.actors.moves(prospects)[index];
            let Some(left) = origin.left.after(step.code.kind(), &self.bounds) else {
                origin.is_held |= step.code.kind() == Kind::Timer;
                continue;
            };
            self.set_row(origin.row);
            self.row[place] = step.next;
            for &datagram in self.robots.sent(step.sent) {
                let to = HEAD + self.robots.datagram(datagram).to.index();
                self.row[to] = self.actors.post(self.row[to], datagram);
            }
            let is_still = step.next == origin.row[place] && left == origin.left;
            if self.grows_first && is_still && step.batch == NOTHING && self.row != origin.row {
                origin.grows = true;
                origin.batch.truncate(origin.first);
            }
            self.take(origin, step.code, left, step.batch);
            if origin.violation.is_some() || origin.grows {
                return;
            }
        }
    }

    /// Clocks advance where no timer is due.
    fn ticks(&mut self, origin: &mut Origin<'_>, ticked: &[Option<u32>]) {
        let Clocks::Ticking { ticks, skew, .. } = self.bounds.clocks else {
            return;
        };
        let actors = origin.row[HEAD..].iter();
        let clocks = actors.map(|&actor| self.robots.state(self.actors.local(actor)).clock);
        let clocks: Vec<u64> = clocks.collect();
        origin.is_held |= clocks.iter().any(|&clock| clock >= u64::from(ticks));
        if skew == 0 {
            if ticked.iter().all(Option::is_some) {
                self.row.truncate(0);
                self.row.push(origin.row[0]);
                self.row.extend(ticked.iter().flatten());
                let code = Code::robot(Kind::TickAll, RobotId(0), 0);
                self.take(origin, code, origin.left, NOTHING);
            }
            return;
        }
        let slowest = clocks.iter().min().copied().unwrap_or_default();
        for (robot, (ticked, clock)) in (0..).zip(ticked.iter().zip(clocks)) {
            if let Some(ticked) = ticked.filter(|_| clock - slowest < u64::from(skew)) {
                self.set_row(origin.row);
                self.row[HEAD + robot as usize] = ticked;
                let code = Code::robot(Kind::Tick, RobotId(robot), 0);
                self.take(origin, code, origin.left, NOTHING);
            }
        }
    }

    /// Ends a step: the row at hand has the actors after it.
    fn take(&mut self, origin: &mut Origin<'_>, code: Code, left: Left, batch: u32) {
        if origin.violation.is_some() {
            return;
        }
        match self.show(origin.watch, batch) {
            Ok(watch) => {
                if (watch, left) != (origin.watch, origin.left) {
                    self.row[0] = self.number_of_head(watch, left);
                }
                let Expander { row, group, .. } = self;
                self.actors.write_group(watch, row, group);
                origin.batch.push(origin.state, code, row, group);
            }
            Err(violation) => origin.violation = Some((code, violation)),
        }
    }

    fn set_row(&mut self, row: &[u32]) {
        self.row.clear();
        self.row.extend_from_slice(row);
    }

    /// Shows the checkers the events of the step that leads to the row at hand. Returns their state after it.
    ///
    /// # Errors
    /// The violation, if a property is violated.
    fn show(&mut self, watch: u32, batch: u32) -> Result<u32, Violation> {
        if batch == NOTHING {
            return Ok(watch);
        }
        let locals = self.row[HEAD..]
            .iter()
            .map(|&actor| self.actors.local(actor));
        let ticks = locals.map(|local| self.robots.state(local).clock).max();
        let ticks = ticks.unwrap_or_default();
        let at = self.robots.surroundings.time(ticks);
        let events = self.robots.events(batch);
        let shown = self.watches.show(watch, (batch, events), (ticks, at));
        let watch = shown.watch;
        let found = shown.violation.as_deref().cloned();
        match found.or_else(|| crate::failure(events, at)) {
            Some(violation) => Err(violation),
            None => Ok(watch),
        }
    }

    /// The state of the checkers, and the remaining bounds.
    fn head(&self, number: u32) -> (u32, Left) {
        let row = self.heads.row(number);
        (row[0], Left::read(&row[1..]))
    }

    pub fn number_of_head(&mut self, watch: u32, left: Left) -> u32 {
        let [first, second] = left.words();
        self.heads.insert(&[watch, first, second], &[]).0
    }

    /// The violation of a state without a next step, if there is one.
    pub fn stuck(&self, row: &[u32]) -> Option<Violation> {
        if !self.robots.surroundings.model.all_finish {
            return None;
        }
        let actors = row[HEAD..].iter();
        let states = actors.map(|&actor| self.robots.state(self.actors.local(actor)));
        let waiting = states.filter(|state| state.is_waiting());
        let waiting: Vec<RobotId> = waiting.map(|state| state.robot()).collect();
        let at = self.robots.surroundings.time(0);
        crate::stuck(waiting, at)
    }

    /// Memory in use, bytes, without that of robots and checkers themselves.
    pub fn bytes(&self) -> usize {
        self.heads.bytes() + self.actors.bytes() + self.robots.bytes() + self.watches.bytes()
    }
}
