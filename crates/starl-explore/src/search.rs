//! Breadth-first search through all states (Moore 1959), so that the first violation that it comes upon
//! has as few steps before it as any.
//!
//! A state is a row of words: the number of what the checkers remember, what is left of the bounds, the
//! number of each robot's state, and the datagrams that are on their way, in ascending order. All that can make a difference to what comes next is in the row, and rows are compared whole.

use crate::Setup;
use crate::bounds::{Bounds, Left};
use crate::code::{Code, Flying, MOST_ROBOTS};
use crate::doubt::Doubt;
use crate::robots::{Outcome, Robots};
use crate::scene::{Invariant, Scene};
use crate::step::Step;
use crate::table::Table;
use crate::walk::Walk;
use crate::watch::Watches;
use starl_core::event::PrimitiveEvent;
use starl_core::{Event, RobotId};
use starl_properties::Violation;

/// A search under way.
#[derive(Clone)]
pub struct Search {
    pub(crate) bounds: Bounds,
    pub(crate) robots: Robots,
    watches: Watches,
    invariants: Vec<Box<dyn Invariant>>,
    /// Rows of robots' states that invariants have judged.
    judged: Table,
    pub(crate) states: Table,
    /// The state before each, and the step from there.
    origins: Vec<(u32, Code)>,
    /// The first state that was not expanded.
    next: u32,
    /// The first state that is further from the start than those that are expanded now.
    level: u32,
    depth: u32,
    transitions: u64,
    terminal: u64,
    end: Option<End>,
    /// The row at hand.
    row: Vec<u32>,
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
    /// The steps, as few as possible.
    pub steps: Vec<Step>,
    /// What is violated after them.
    pub violation: Violation,
}

/// How far a search is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Report {
    /// States found so far, the first included.
    pub states: u32,
    /// Of these, how many were expanded.
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
    /// How often programs asked to move. Nobody does.
    pub motions: u64,
    /// Turns in which two robots that were taken for the same were compared.
    pub compared: u64,
    /// Memory of the states, bytes.
    pub bytes: usize,
}

/// A fleet is too large for this.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooManyRobots;

/// Where the robots begin in a row.
pub(crate) const HEAD: usize = 1 + Left::WORDS;

impl Search {
    /// A search from the state in which all robots have started.
    ///
    /// # Errors
    /// Where there are more than 256 robots.
    pub fn new(setup: Setup) -> Result<Search, TooManyRobots> {
        let (walk, moment) = Walk::start(setup);
        Search::from(&walk, moment.violations)
    }

    /// A search from the state that a walk has come to, in which this is violated.
    ///
    /// # Errors
    /// Where there are more than 256 robots.
    pub fn from(walk: &Walk, violations: Vec<Violation>) -> Result<Search, TooManyRobots> {
        if walk.locals.len() > MOST_ROBOTS {
            return Err(TooManyRobots);
        }
        let mut search = Search {
            bounds: walk.bounds,
            robots: Robots::new(walk.surroundings.clone()),
            watches: Watches::new(walk.checkers.clone()),
            invariants: walk.invariants.clone(),
            judged: Table::default(),
            states: Table::default(),
            origins: Vec::new(),
            next: 0,
            level: 1,
            depth: 0,
            transitions: 0,
            terminal: 0,
            end: None,
            row: Vec::new(),
        };
        let locals = walk.locals.iter();
        let locals: Vec<u32> = locals
            .map(|local| search.robots.number(local.clone()))
            .collect();
        let flight = walk.flying();
        let mut flight: Vec<u32> = flight
            .map(|(datagram, age)| {
                let number = search.robots.number_of(datagram.clone());
                Flying::aged(number, age).0
            })
            .collect();
        flight.sort_unstable();
        search.row.push(0);
        search.row.extend(walk.left.words());
        search.row.extend(locals);
        search.row.extend(flight);
        search.enter(0, None, &[]);
        if let Some(violation) = violations.into_iter().next() {
            search.blame(0, None, violation);
        }
        Ok(search)
    }

    /// Doubts that states which look alike are alike: costs twice the time where robots have many
    /// states. To be called before the first [`Search::advance`].
    pub fn set_doubting(&mut self, doubting: bool) {
        self.robots.doubt = doubting.then(Box::<Doubt>::default);
    }

    /// Expands up to so many states; gives how the search has ended, once it has.
    pub fn advance(&mut self, states: u32) -> Option<&End> {
        for _ in 0..states {
            if self.end.is_some() {
                break;
            }
            let count = self.states.len() as u32;
            if self.next == count {
                self.end = Some(End::Complete);
            } else if count >= self.bounds.most_states || self.robots.is_full() {
                self.end = Some(End::Full);
            } else {
                self.go_on();
            }
        }
        self.end.as_ref()
    }

    /// Searches to the end.
    pub fn run(&mut self) -> &End {
        while self.advance(u32::MAX).is_none() {}
        self.end.get_or_insert(End::Complete)
    }

    /// How far it is.
    pub fn report(&self) -> Report {
        Report {
            states: self.states.len() as u32,
            expanded: self.next,
            transitions: self.transitions,
            depth: match self.level < self.states.len() as u32 {
                true => self.depth + 1,
                false => self.depth,
            },
            terminal: self.terminal,
            robot_states: self.robots.len(),
            checker_states: self.watches.len(),
            motions: self.robots.motions,
            compared: self.robots.doubt.as_ref().map_or(0, |doubt| doubt.compared),
            bytes: self.states.bytes() + self.origins.capacity() * size_of::<(u32, Code)>(),
        }
    }

    /// What primitives have told of in some behaviour. About what never happens nothing is found out.
    pub fn told(&self) -> impl Iterator<Item = &PrimitiveEvent> {
        self.robots.all_events().filter_map(|event| match event {
            Event::Primitive { event, .. } => Some(event),
            _ => None,
        })
    }

    fn go_on(&mut self) {
        if self.next == self.level {
            self.level = self.states.len() as u32;
            self.depth += 1;
        }
        if self.bounds.depth.is_some_and(|depth| self.depth >= depth) {
            self.end = Some(End::Depth);
            return;
        }
        let state = self.next;
        self.next += 1;
        self.expand(state);
        let doubt = self.robots.doubt.as_ref();
        if let Some(text) = doubt.and_then(|doubt| doubt.contradiction.clone()) {
            self.end = Some(End::Contradiction(text));
        }
    }

    /// Begins to build the row of the state that follows `from`.
    pub(crate) fn begin(&mut self, from: &[u32], left: Left) {
        self.row.clear();
        self.row.push(from[0]);
        self.row.extend(left.words());
        self.row.extend_from_slice(&from[HEAD..]);
    }

    /// Leaves only these datagrams in the row that was begun.
    pub(crate) fn keep(&mut self, datagrams: &[u32]) {
        self.row
            .truncate(HEAD + self.robots.surroundings.fleet.len());
        self.row.extend_from_slice(datagrams);
    }

    /// Ends the row that was begun: these robots have had a turn. The datagram that was taken from the
    /// network is given as it is in the row. Gives the state's number; none where something is violated.
    pub(crate) fn finish(
        &mut self,
        (from, code): (u32, Code),
        taken: Option<Flying>,
        outcomes: &[(RobotId, Outcome)],
    ) -> Option<u32> {
        self.transitions += 1;
        let first = HEAD + self.robots.surroundings.fleet.len();
        if let Some(Flying(word)) = taken
            && let Ok(place) = self.row[first..].binary_search(&word)
        {
            self.row.remove(first + place);
        }
        self.enter(from, Some(code), outcomes)
    }

    fn enter(
        &mut self,
        from: u32,
        code: Option<Code>,
        outcomes: &[(RobotId, Outcome)],
    ) -> Option<u32> {
        let first = HEAD + self.robots.surroundings.fleet.len();
        for (robot, outcome) in outcomes {
            self.row[HEAD + robot.index()] = outcome.local;
            for &number in self.robots.sent(outcome) {
                let Flying(word) = Flying::new(number);
                let place = self.row[first..].partition_point(|&other| other < word);
                self.row.insert(first + place, word);
            }
        }
        let violation = self.show(outcomes);
        if self.end.is_some() {
            return None;
        }
        if let Some(violation) = violation {
            self.blame(from, code, violation);
            return None;
        }
        let (number, is_new) = self.states.insert(&self.row);
        if is_new {
            self.origins.push((from, code.unwrap_or(Code(0))));
            if let Some(violation) = self.judge() {
                self.end = None;
                self.blame(number, None, violation);
                return None;
            }
        }
        Some(number)
    }

    /// Shows the checkers what happened in a step.
    fn show(&mut self, outcomes: &[(RobotId, Outcome)]) -> Option<Violation> {
        let mut found = None;
        for (_, outcome) in outcomes {
            if outcome.batch == crate::robots::NOTHING {
                continue;
            }
            let fleet = self.robots.surroundings.fleet.len();
            let locals = self.row[HEAD..HEAD + fleet].iter();
            let ticks = locals.map(|&local| self.robots.state(local).clock).max();
            let ticks = ticks.unwrap_or_default();
            let at = self.robots.surroundings.time(ticks);
            let events = self.robots.events(outcome.batch);
            let shown = self
                .watches
                .show(self.row[0], (outcome.batch, events), (ticks, at));
            self.row[0] = shown.watch;
            found = found
                .or_else(|| shown.violation.as_deref().cloned())
                .or_else(|| crate::failure(events, at));
        }
        found
    }

    /// Has the invariants judge the row at hand.
    fn judge(&mut self) -> Option<Violation> {
        if self.invariants.is_empty() {
            return None;
        }
        let fleet = self.robots.surroundings.fleet.len();
        let locals = &self.row[HEAD..HEAD + fleet];
        if !self.judged.insert(locals).1 {
            return None;
        }
        let scene = Scene {
            locals: locals
                .iter()
                .map(|&local| self.robots.state(local))
                .collect(),
            surroundings: &self.robots.surroundings,
        };
        let mut violations = Vec::new();
        for invariant in &self.invariants {
            invariant.judge(&scene, &mut violations);
        }
        violations.into_iter().next()
    }

    /// Nothing leads on from a state.
    pub(crate) fn is_terminal(&mut self, state: u32, stuck: Option<Violation>) {
        self.terminal += 1;
        if let Some(violation) = stuck {
            self.blame(state, None, violation);
        }
    }

    /// Ends the search: something is violated after a step from a state, or in the state itself.
    fn blame(&mut self, state: u32, code: Option<Code>, violation: Violation) {
        let mut codes: Vec<(u32, Code)> = code.map(|code| (state, code)).into_iter().collect();
        let mut at = state;
        while at != 0
            && let Some(&(before, code)) = self.origins.get(at as usize)
        {
            codes.push((before, code));
            at = before;
        }
        let steps = codes.into_iter().rev().map(|(before, code)| {
            let robot = code.of_robot().unwrap_or(RobotId(0));
            let row = self.states.row(before);
            let local = row.get(HEAD + robot.index()).copied().unwrap_or_default();
            code.step(local, &self.robots)
        });
        self.end = Some(End::Violated(Counterexample {
            steps: steps.collect(),
            violation,
        }));
    }
}
