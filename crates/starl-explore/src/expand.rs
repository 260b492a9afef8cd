//! The steps that are possible in a state of the fleet.

use crate::actors::Prospects;
use crate::bounds::{Clocks, Left};
use crate::code::{Code, Kind};
use crate::robots::NOTHING;
use crate::search::{HEAD, Search};
use starl_core::RobotId;
use starl_properties::Violation;

/// The property that is violated where nothing can happen any more and not all robots have finished.
pub const STUCK: &str = "explore.stuck";

/// A state that is expanded.
struct Site {
    number: u32,
    row: Vec<u32>,
    /// The state of the checkers.
    watch: u32,
    left: Left,
    /// Whether some step leads to another state.
    moves: bool,
    /// Whether a bound kept a timer from firing, or a clock from ticking.
    held: bool,
}

impl Search {
    /// Takes every step that is possible in a state.
    pub(crate) fn expand(&mut self, number: u32) {
        let row = self.states.row(number).to_vec();
        let (watch, left) = self.head(row[0]);
        let mut site = Site {
            number,
            row,
            watch,
            left,
            moves: false,
            held: false,
        };
        let mut ticked = Vec::with_capacity(site.row.len());
        for place in HEAD..site.row.len() {
            let prospects = self.actors.prospects(site.row[place], &mut self.robots);
            ticked.push(prospects.ticked);
            self.moves(&mut site, place, prospects);
            if self.end.is_some() {
                return;
            }
        }
        self.ticks(&mut site, &ticked);
        if !site.moves && self.end.is_none() {
            let stuck = (!site.held).then(|| self.stuck(&site)).flatten();
            self.is_terminal(number, stuck);
        }
    }

    /// One robot moves.
    fn moves(&mut self, site: &mut Site, place: usize, prospects: Prospects) {
        for index in 0..self.actors.moves(prospects).len() {
            let step = self.actors.moves(prospects)[index];
            let Some(left) = site.left.after(step.code.kind(), &self.bounds) else {
                site.held |= step.code.kind() == Kind::Timer;
                continue;
            };
            self.row.clone_from(&site.row);
            self.row[place] = step.next;
            for &datagram in self.robots.sent(step.sent) {
                let to = HEAD + self.robots.datagram(datagram).to.index();
                self.row[to] = self.actors.post(self.row[to], datagram);
            }
            self.take(site, step.code, left, step.batch);
            if self.end.is_some() {
                return;
            }
        }
    }

    /// Clocks advance where no timer is due.
    fn ticks(&mut self, site: &mut Site, ticked: &[Option<u32>]) {
        let Clocks::Ticking { ticks, skew, .. } = self.bounds.clocks else {
            return;
        };
        let actors = site.row[HEAD..].iter();
        let clocks = actors.map(|&actor| self.robots.state(self.actors.local(actor)).clock);
        let clocks: Vec<u64> = clocks.collect();
        site.held |= clocks.iter().any(|&clock| clock >= u64::from(ticks));
        if skew == 0 {
            if ticked.iter().all(Option::is_some) {
                self.row.truncate(0);
                self.row.push(site.row[0]);
                self.row.extend(ticked.iter().flatten());
                let code = Code::robot(Kind::TickAll, RobotId(0), 0);
                self.take(site, code, site.left, NOTHING);
            }
            return;
        }
        let slowest = clocks.iter().min().copied().unwrap_or_default();
        for (robot, (ticked, clock)) in (0..).zip(ticked.iter().zip(clocks)) {
            if let Some(ticked) = ticked.filter(|_| clock - slowest < u64::from(skew)) {
                self.row.clone_from(&site.row);
                self.row[HEAD + robot as usize] = ticked;
                let code = Code::robot(Kind::Tick, RobotId(robot), 0);
                self.take(site, code, site.left, NOTHING);
            }
        }
    }

    /// Ends a step: the row at hand has the actors after it.
    fn take(&mut self, site: &mut Site, code: Code, left: Left, batch: u32) {
        let Some(watch) = self.show(site.watch, batch, site.number, code) else {
            return;
        };
        if (watch, left) != (site.watch, site.left) {
            self.row[0] = self.number_of_head(watch, left);
        }
        let next = self.enter(site.number, code);
        site.moves |= next != Some(site.number);
    }

    /// The violation of a state without a next step, if there is one.
    fn stuck(&self, site: &Site) -> Option<Violation> {
        if !self.robots.surroundings.model.all_finish {
            return None;
        }
        let actors = site.row[HEAD..].iter();
        let states = actors.map(|&actor| self.robots.state(self.actors.local(actor)));
        let waiting = states.filter(|state| state.is_waiting());
        let waiting: Vec<RobotId> = waiting.map(|state| state.robot()).collect();
        let at = self.robots.surroundings.time(0);
        crate::stuck(waiting, at)
    }
}
