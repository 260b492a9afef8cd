//! Breadth-first search through all states (Moore 1959), so that the first violation found has the fewest steps.
//!
//! A state is a row of words: the number of the checkers' state and the remaining bounds, and the number of each
//! robot's state with its datagrams in transit. The row contains everything that the next steps depend on. States are
//! compared whole, and those that a known one covers are left out ([`crate::cover`]).

use crate::Setup;
use crate::actors::Actors;
use crate::bounds::{Bounds, Left};
use crate::code::{Code, Flying, MOST_ROBOTS};
use crate::cover::{Candidate, Covers};
use crate::doubt::Doubt;
use crate::robots::{NOTHING, Robots};
use crate::scene::{Invariant, Scene};
use crate::step::Step;
use crate::table::{Rows, Table};
use crate::walk::Walk;
use crate::watch::Watches;
use starl_core::event::PrimitiveEvent;
use starl_core::{Event, RobotId};
use starl_properties::Violation;
use std::collections::BTreeSet;

/// A search under way.
#[derive(Clone)]
pub struct Search {
    pub(crate) bounds: Bounds,
    pub(crate) robots: Robots,
    watches: Watches,
    invariants: Vec<Box<dyn Invariant>>,
    /// Rows of robots' states that invariants have judged.
    judged: Table,
    /// The states of the checkers, and the remaining bounds.
    heads: Rows,
    pub(crate) actors: Actors,
    /// Rows of a head and the actors; with each the state before it, and the step from there.
    pub(crate) states: Rows,
    /// None where a fleet that waits for a lost datagram counts: a state that covers another one does not wait.
    covers: Option<Covers>,
    /// States that need not be expanded, since others cover them that are as near to the start.
    covered: BTreeSet<u32>,
    /// The first state that was not expanded.
    next: u32,
    /// The first state that is further from the start than those that are expanded now.
    level: u32,
    depth: u32,
    transitions: u64,
    terminal: u64,
    pub(crate) end: Option<End>,
    /// The row at hand.
    pub(crate) row: Vec<u32>,
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
    /// The steps, the fewest possible.
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

/// Where the robots begin in a row.
pub(crate) const HEAD: usize = 1;

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
        let mut search = Search {
            bounds: walk.bounds,
            robots: Robots::new(walk.surroundings.clone()),
            watches: Watches::new(walk.checkers.clone()),
            invariants: walk.invariants.clone(),
            judged: Table::default(),
            heads: Rows::new(1 + Left::WORDS, 0),
            actors: Actors::new(walk.bounds),
            states: Rows::new(0, 2),
            covers: None,
            covered: BTreeSet::new(),
            next: 0,
            level: 1,
            depth: 0,
            transitions: 0,
            terminal: 0,
            end: None,
            row: Vec::new(),
        };
        let mut mailboxes = vec![Vec::new(); walk.locals.len()];
        for (datagram, age) in walk.flying() {
            let number = search.robots.number_of(datagram.clone());
            mailboxes[datagram.to.index()].push(Flying::aged(number, age).0);
        }
        let head = search.number_of_head(0, walk.left);
        search.row.push(head);
        for (local, mut mailbox) in walk.locals.iter().zip(mailboxes) {
            mailbox.sort_unstable();
            let local = search.robots.number(local.clone());
            let actor = search.actors.number(local, &mailbox);
            search.row.push(actor);
        }
        search.set_covering(!walk.surroundings.model.all_finish);
        if let Some(violation) = search.judge() {
            search.blame(0, None, violation);
        }
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

    /// Whether states that others cover are left out; they are, by default, unless all robots must finish. The other
    /// search takes longer and finds the same. To be called before the first [`Search::advance`].
    pub fn set_covering(&mut self, covering: bool) {
        self.covers = covering.then(|| Covers::new(self.row.len() - HEAD));
        self.states = Rows::new(self.row.len(), 2);
        self.number_of_row(0, 0);
    }

    /// Expands up to this number of states; returns the end of the search once it has ended.
    pub fn advance(&mut self, states: u32) -> Option<&End> {
        for _ in 0..states {
            if self.end.is_some() {
                break;
            }
            let count = self.states.len();
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
            states: self.states.len(),
            expanded: self.next,
            transitions: self.transitions,
            depth: match self.level < self.states.len() {
                true => self.depth + 1,
                false => self.depth,
            },
            terminal: self.terminal,
            robot_states: self.robots.len(),
            checker_states: self.watches.len(),
            motions: self.robots.motions,
            compared: self.robots.doubt.as_ref().map_or(0, |doubt| doubt.compared),
            bytes: self.states.bytes()
                + self.covers.as_ref().map_or(0, Covers::bytes)
                + self.heads.bytes()
                + self.actors.bytes()
                + self.robots.bytes()
                + self.watches.bytes(),
        }
    }

    /// The events of primitives in some behaviour. The exploration says nothing about events that
    /// never happen.
    pub fn told(&self) -> impl Iterator<Item = &PrimitiveEvent> {
        self.robots.all_events().filter_map(|event| match event {
            Event::Primitive { event, .. } => Some(event),
            _ => None,
        })
    }

    fn go_on(&mut self) {
        if self.next == self.level {
            self.level = self.states.len();
            self.depth += 1;
        }
        if self.bounds.depth.is_some_and(|depth| self.depth >= depth) {
            self.end = Some(End::Depth);
            return;
        }
        let state = self.next;
        self.next += 1;
        if self.covered.remove(&state) {
            return;
        }
        self.expand(state);
        let doubt = self.robots.doubt.as_ref();
        if let Some(text) = doubt.and_then(|doubt| doubt.contradiction.clone()) {
            self.end = Some(End::Contradiction(text));
        }
    }

    /// Enters the state that the row at hand leads to; gives its number, or none where something is violated.
    pub(crate) fn enter(&mut self, from: u32, code: Code) -> Option<u32> {
        self.transitions += 1;
        let (number, is_new) = self.number_of_row(from, code.0);
        if is_new && let Some(violation) = self.judge() {
            self.blame(number, None, violation);
            return None;
        }
        Some(number)
    }

    /// The number of the state with the row at hand, or of one that covers it; and whether it is new.
    fn number_of_row(&mut self, from: u32, code: u32) -> (u32, bool) {
        let Some(covers) = &mut self.covers else {
            return self.states.insert(&self.row, &[from, code]);
        };
        let (states, heads) = (&self.states, &self.heads);
        let watch = heads.row(self.row[0])[0];
        let group = covers.group(watch, &self.row, &self.actors);
        let new = Candidate::of(&self.row, heads);
        let known = |number: u32| Candidate::of(states.row(number), heads);
        if let Some(known) = covers.find(group, new, &self.actors, known) {
            return (known, false);
        }
        let number = states.len();
        let covered = covers.add(group, number, new, &self.actors, known);
        // Those of the present level are not further from the start than this one.
        let level = self.level;
        self.covered
            .extend(covered.into_iter().filter(|&other| other >= level));
        (self.states.push(&self.row, &[from, code]), true)
    }

    /// The states of the checkers, and the remaining bounds.
    pub(crate) fn head(&self, number: u32) -> (u32, Left) {
        let row = self.heads.row(number);
        (row[0], Left::read(&row[1..]))
    }

    pub(crate) fn number_of_head(&mut self, watch: u32, left: Left) -> u32 {
        let [first, second] = left.words();
        self.heads.insert(&[watch, first, second], &[]).0
    }

    /// Shows the checkers the events of the step that leads to the current row. Returns their state after it; none if a
    /// property is violated.
    pub(crate) fn show(&mut self, watch: u32, batch: u32, from: u32, code: Code) -> Option<u32> {
        if batch == NOTHING {
            return Some(watch);
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
        if let Some(violation) = found.or_else(|| crate::failure(events, at)) {
            self.blame(from, Some(code), violation);
            return None;
        }
        Some(watch)
    }

    /// Has the invariants judge the row at hand.
    fn judge(&mut self) -> Option<Violation> {
        if self.invariants.is_empty() {
            return None;
        }
        let actors = self.row[HEAD..].iter();
        let locals: Vec<u32> = actors.map(|&actor| self.actors.local(actor)).collect();
        if !self.judged.insert(&locals).1 {
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
        while at != 0 {
            let kept = self.states.kept(at);
            codes.push((kept[0], Code(kept[1])));
            at = kept[0];
        }
        let steps = codes.into_iter().rev().map(|(before, code)| {
            let robot = code.of_robot().unwrap_or(RobotId(0));
            let actor = self.states.row(before).get(HEAD + robot.index());
            let local = actor.map_or(0, |&actor| self.actors.local(actor));
            code.step(local, &self.robots)
        });
        self.end = Some(End::Violated(Counterexample {
            steps: steps.collect(),
            violation,
        }));
    }
}
