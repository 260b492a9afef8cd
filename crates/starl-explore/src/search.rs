//! Breadth-first search through all states (Moore 1959), so that the first violation found has the fewest steps.
//!
//! A state is a row of words: the number of the checkers' state and the remaining bounds, and the number of each
//! robot's state with its datagrams in transit. The row contains everything that the next steps depend on. States are
//! compared whole, and those that a known one covers are left out ([`crate::cover`], [`crate::grow`]).
//!
//! The search continues in batches of steps. While the states that a batch leads to are entered ([`crate::known`]), the
//! next states are expanded ([`crate::expand`]). Then the new states are judged, in the order of the steps. So threads
//! do not change what is found.

use crate::Setup;
use crate::actors::HEAD;
use crate::batch::{Batch, Site};
use crate::bounds::Bounds;
use crate::code::{Code, Flying, Kind, MOST_ROBOTS};
use crate::doubt::Doubt;
use crate::expand::Expander;
use crate::grow::drop_needless;
use crate::known::{Arrival, Known};
use crate::level::Level;
use crate::robots::Robots;
use crate::scene::{Invariant, Scene};
use crate::step::Step;
use crate::table::Table;
use crate::threads::{both, pays};
use crate::walk::Walk;
use starl_core::event::PrimitiveEvent;
use starl_core::{Event, RobotId};
use starl_properties::Violation;

/// A search under way.
#[derive(Clone)]
pub struct Search {
    bounds: Bounds,
    expander: Expander,
    invariants: Vec<Box<dyn Invariant>>,
    /// Rows of robots' states that invariants have judged.
    judged: Table,
    known: Known,
    level: Level,
    /// How many levels were begun.
    levels: u32,
    /// The states that are one step further from the start than the level.
    beyond: Vec<u32>,
    /// The steps that are to be entered next.
    ready: Batch,
    /// Memory for the steps after these.
    spare: Batch,
    found: u32,
    expanded: u32,
    transitions: u64,
    terminal: u64,
    parallel: bool,
    end: Option<End>,
}

/// How a search has ended.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// All states within the bounds were explored, and none violates anything.
    Complete,
    /// Something is violated.
    Violated(Counterexample),
    /// All states up to the bound of depth were explored, and none violates anything; there are more.
    Depth,
    /// There are more states than the bound.
    Full,
    /// A program does not write all of its state, so that states were merged that differ.
    Contradiction(String),
}

/// The way to a violation.
#[derive(Clone, Debug, PartialEq)]
pub struct Counterexample {
    /// The steps: the fewest possible, or with any copies a few of which each is necessary.
    pub steps: Vec<Step>,
    /// The violation after them.
    pub violation: Violation,
}

/// How far a search is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Report {
    /// States found so far, the first included, without those that were covered when they were reached.
    pub states: u32,
    /// Of these, how many were expanded, or need not be.
    pub expanded: u32,
    /// Steps from expanded states.
    pub transitions: u64,
    /// The furthest that states are from the start, in steps.
    pub depth: u32,
    /// States from which nothing leads on.
    pub terminal: u64,
    /// States of single robots.
    pub robot_states: usize,
    /// States of the checkers.
    pub checker_states: usize,
    /// How often programs asked to move. Motion requests are ignored.
    pub motions: u64,
    /// Turns in which two merged robots were compared.
    pub compared: u64,
    /// Memory of the states, bytes.
    pub bytes: usize,
}

/// A fleet is too large for this.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooManyRobots;

/// Stands for the state before the first one.
const START: u32 = u32::MAX;

impl Search {
    /// A search from the state in which all robots have started.
    ///
    /// # Errors
    /// If there are more than 256 robots.
    pub fn new(setup: Setup) -> Result<Search, TooManyRobots> {
        let (walk, moment) = Walk::start(setup);
        Search::from(&walk, moment.violations)
    }

    /// A search from the end state of a walk, in which this is violated.
    ///
    /// # Errors
    /// If there are more than 256 robots.
    pub fn from(walk: &Walk, violations: Vec<Violation>) -> Result<Search, TooManyRobots> {
        if walk.locals.len() > MOST_ROBOTS {
            return Err(TooManyRobots);
        }
        let robots = Robots::new(walk.surroundings.clone());
        let mut expander = Expander::new(walk.bounds, robots, walk.checkers.clone());
        let mut mailboxes = vec![Vec::new(); walk.locals.len()];
        for (datagram, age) in walk.flying() {
            let number = expander.robots.number_of(datagram.clone());
            mailboxes[datagram.to.index()].push(Flying::aged(number, age).0);
        }
        let mut row = vec![expander.number_of_head(0, walk.left)];
        for (local, mut mailbox) in walk.locals.iter().zip(mailboxes) {
            mailbox.sort_unstable();
            let local = expander.robots.number(local.clone());
            row.push(expander.actors.number(local, &mailbox));
        }
        let width = row.len();
        let mut search = Search {
            bounds: walk.bounds,
            expander,
            invariants: walk.invariants.clone(),
            judged: Table::default(),
            known: Known::new(width, true),
            level: Level::new(width),
            levels: 0,
            beyond: Vec::new(),
            ready: Batch::new(width),
            spare: Batch::new(width),
            found: 0,
            expanded: 0,
            transitions: 0,
            terminal: 0,
            parallel: false,
            end: None,
        };
        search.begin(&row, !walk.surroundings.model.all_finish);
        let violation = search.judge(&row).or(violations.into_iter().next());
        if let Some(violation) = violation {
            search.blame(search.beyond[0], None, violation);
        }
        Ok(search)
    }

    /// Doubts that states which look alike are alike: costs twice the time where robots have many
    /// states. To be called before the first [`Search::advance`].
    pub fn set_doubting(&mut self, doubting: bool) {
        self.expander.robots.doubt = doubting.then(Box::<Doubt>::default);
    }

    /// Whether to work on all threads of the pool in which [`Search::advance`] is called. The results are the same either
    /// way. Without the feature `parallel` this does nothing.
    pub fn set_parallel(&mut self, parallel: bool) {
        self.parallel = parallel;
    }

    /// Whether states that others cover are left out; they are, by default, unless all robots must finish. The other
    /// search takes longer and finds the same. To be called before the first [`Search::advance`].
    pub fn set_covering(&mut self, covering: bool) {
        let start = self.known.row(self.beyond[0]).to_vec();
        self.begin(&start, covering);
    }

    /// Begins with the state that has this row.
    fn begin(&mut self, row: &[u32], covering: bool) {
        self.expander.grows_first = covering && !self.bounds.is_shortest_first();
        self.known = Known::new(row.len(), covering);
        self.known
            .catch_up(&self.expander.actors, &self.expander.heads);
        let mut group = Vec::new();
        self.expander.actors.write_group(0, row, &mut group);
        let nothing = Code::robot(Kind::TickAll, RobotId(0), 0);
        self.ready.push(START, nothing, row, &group);
        self.beyond = self
            .known
            .enter(&self.ready, false)
            .iter()
            .map(|start| start.state)
            .collect();
        self.ready.clear();
        self.found = 1;
    }

    /// Continues with a batch of up to some thousand steps; returns the end of the search once it has ended.
    pub fn advance(&mut self) -> Option<&End> {
        if self.end.is_none() {
            self.go_on();
        }
        self.end.as_ref()
    }

    /// The end of the search, if it has ended.
    pub fn end(&self) -> Option<&End> {
        self.end.as_ref()
    }

    /// Searches to the end.
    pub fn run(&mut self) -> &End {
        while self.advance().is_none() {}
        self.end.get_or_insert(End::Complete)
    }

    /// How far it is.
    pub fn report(&self) -> Report {
        let robots = &self.expander.robots;
        Report {
            states: self.found,
            expanded: self.expanded,
            transitions: self.transitions,
            depth: (self.levels + u32::from(!self.beyond.is_empty())).saturating_sub(1),
            terminal: self.terminal,
            robot_states: robots.len(),
            checker_states: self.expander.watches.len(),
            motions: robots.motions,
            compared: robots.doubt.as_ref().map_or(0, |doubt| doubt.compared),
            bytes: self.known.bytes()
                + self.expander.bytes()
                + self.level.bytes()
                + self.beyond.capacity() * size_of::<u32>(),
        }
    }

    /// The events of primitives in some behaviour. The exploration says nothing about events that
    /// never happen.
    pub fn told(&self) -> impl Iterator<Item = &PrimitiveEvent> {
        self.expander
            .robots
            .all_events()
            .filter_map(|event| match event {
                Event::Primitive { event, .. } => Some(event),
                _ => None,
            })
    }

    fn go_on(&mut self) {
        if self.ready.sites.is_empty() {
            if self.level.is_done() {
                self.begin_level();
                return;
            }
            self.level.load(&self.known);
            self.expander.fill(&mut self.level, &mut self.ready);
            if self.ready.sites.is_empty() {
                self.end = Some(End::Full);
                return;
            }
        }
        let Search {
            expander,
            known,
            level,
            ready,
            spare,
            parallel,
            ..
        } = self;
        let parallel = *parallel && pays(ready.len());
        level.load(known);
        known.catch_up(&expander.actors, &expander.heads);
        let enter = || known.enter(ready, parallel);
        let (arrivals, ()) = both(parallel, enter, || expander.fill(level, spare));
        let batch = std::mem::replace(&mut self.ready, std::mem::take(&mut self.spare));
        self.settle(&batch, &arrivals);
        self.spare = batch;
    }

    /// Takes the states that are one step further from the start.
    fn begin_level(&mut self) {
        self.end = match self.beyond.is_empty() {
            true => Some(End::Complete),
            false if self.is_full() => Some(End::Full),
            false if self.bounds.depth.is_some_and(|depth| self.levels >= depth) => {
                Some(End::Depth)
            }
            false => None,
        };
        if self.end.is_some() {
            return;
        }
        self.levels += 1;
        self.known.begin_level();
        self.expanded += self.level.begin(&mut self.beyond, &self.known) as u32;
    }

    /// Counts and judges where the steps of a batch lead, in order.
    fn settle(&mut self, batch: &Batch, arrivals: &[Arrival]) {
        let mut begin = 0;
        'sites: for site in &batch.sites {
            if self.is_full() {
                self.end = Some(End::Full);
                return;
            }
            self.expanded += 1;
            let mut moves = false;
            for (step, arrival) in (begin..).zip(&arrivals[begin..site.end]) {
                let &Arrival { state, is_new } = arrival;
                self.transitions += 1;
                moves |= state != site.state;
                if is_new {
                    self.found += 1;
                    self.beyond.push(state);
                    if let Some(violation) = self.judge(batch.row(step)) {
                        self.blame(state, None, violation);
                        break 'sites;
                    }
                }
            }
            begin = site.end;
            match &site.violation {
                Some((code, violation)) => self.blame(site.state, Some(*code), violation.clone()),
                None if !moves => self.is_terminal(site),
                None => {}
            }
            if self.end.is_some() {
                break;
            }
        }
        if let Some(text) = &batch.contradiction {
            self.end = Some(End::Contradiction(text.clone()));
        }
    }

    /// Whether there are as many states as may be.
    fn is_full(&self) -> bool {
        self.found >= self.bounds.most_states
    }

    /// Has the invariants judge a row.
    fn judge(&mut self, row: &[u32]) -> Option<Violation> {
        if self.invariants.is_empty() {
            return None;
        }
        let Expander { actors, robots, .. } = &self.expander;
        let locals: Vec<u32> = row[HEAD..]
            .iter()
            .map(|&actor| actors.local(actor))
            .collect();
        if !self.judged.insert(&locals).1 {
            return None;
        }
        let scene = Scene {
            locals: locals.iter().map(|&local| robots.state(local)).collect(),
            surroundings: &robots.surroundings,
        };
        let mut violations = Vec::new();
        for invariant in &self.invariants {
            invariant.judge(&scene, &mut violations);
        }
        violations.into_iter().next()
    }

    /// Nothing leads on from a state.
    fn is_terminal(&mut self, site: &Site) {
        self.terminal += 1;
        let stuck = || self.expander.stuck(self.known.row(site.state));
        if !site.is_held
            && let Some(violation) = stuck()
        {
            self.blame(site.state, None, violation);
        }
    }

    /// Ends the search: something is violated after a step from a state, or in the state itself.
    fn blame(&mut self, state: u32, code: Option<Code>, violation: Violation) {
        let mut way = vec![state];
        while let before = self.known.before(way[way.len() - 1])
            && before != START
        {
            way.push(before);
        }
        way.reverse();
        let mut codes = Vec::new();
        for (&from, to) in way.iter().zip(&way[1..]) {
            let row = self.known.row(from);
            let found = self.expander.code(row, self.known.row(*to));
            codes.extend(found.map(|code| (from, code)));
        }
        codes.extend(code.map(|code| (state, code)));
        if self.expander.grows_first {
            let rows: Vec<&[u32]> = way.iter().map(|&state| self.known.row(state)).collect();
            drop_needless(&mut codes, &rows, &self.expander.actors);
        }
        let Expander { actors, robots, .. } = &self.expander;
        let steps = codes.into_iter().map(|(before, code)| {
            let robot = code.of_robot().unwrap_or(RobotId(0));
            let actor = self.known.row(before).get(HEAD + robot.index());
            let local = actor.map_or(0, |&actor| actors.local(actor));
            code.step(local, robots)
        });
        self.end = Some(End::Violated(Counterexample {
            steps: steps.collect(),
            violation,
        }));
    }
}
