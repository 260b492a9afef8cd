//! The checkers of properties, as one more state machine: its inputs are events, and its state is a part of the
//! explored state.
//!
//! Two paths that lead robots and network to the same state merge only if the checkers have the same
//! state too, as shown by `Debug`. So a verdict that depends on the past, for example on another robot
//! that still holds a lock, is correct on every path.
//!
//! Checkers do not see datagrams. They need them only to excuse late events, and there are none here: an exploration
//! has no time bounds.

use crate::table::Rows;
use crate::texts::Texts;
use starl_core::{Duration, Event, Record, RobotId, Time};
use starl_properties::{Checker, Violation};

/// A state of all checkers.
pub(crate) type Checkers = Vec<Box<dyn Checker>>;

/// Some checkers delay findings until they have seen all of a step. They report them after this
/// time.
const A_WHILE: Duration = Duration::from_seconds(1);

/// The checkers after they are shown events at a time. All violations are returned.
pub(crate) fn observe(
    checkers: &Checkers,
    events: &[(RobotId, Event)],
    at: Time,
) -> (Checkers, Vec<Violation>) {
    let mut after = checkers.clone();
    let mut violations = Vec::new();
    for checker in &mut after {
        for (robot, event) in events {
            let record = Record {
                at,
                robot: Some(*robot),
                event: event.clone(),
            };
            checker.observe(&record, &mut violations);
        }
        let mut later = checker.clone();
        later.advance(at + A_WHILE, &mut violations);
    }
    (after, violations)
}

/// Whether checkers are shown it.
pub(crate) fn is_shown(event: &Event) -> bool {
    matches!(
        event,
        Event::Action(_)
            | Event::Program { .. }
            | Event::Primitive { .. }
            | Event::Fault(_)
            | Event::Finished
            | Event::Failed(_)
    )
}

/// All visited states of the checkers, by number, and their successors.
#[derive(Clone)]
pub(crate) struct Watches {
    states: Vec<Checkers>,
    texts: Texts,
    /// Rows of state, batch and time.
    known: Rows,
    outcomes: Vec<Outcome>,
}

/// The result of showing a batch of events.
#[derive(Clone)]
pub(crate) struct Outcome {
    /// The state after it.
    pub watch: u32,
    /// The first violation.
    pub violation: Option<Box<Violation>>,
}

impl Watches {
    /// Checkers that have seen nothing have the number 0.
    pub fn new(checkers: Checkers) -> Watches {
        let mut watches = Watches {
            states: Vec::new(),
            texts: Texts::default(),
            known: Rows::new(3, 0),
            outcomes: Vec::new(),
        };
        watches.number(checkers);
        watches
    }

    /// How many states were seen.
    pub fn len(&self) -> usize {
        self.states.len()
    }

    /// The memory of the successors in bytes, without that of the checkers themselves.
    pub fn bytes(&self) -> usize {
        self.known.bytes() + self.outcomes.capacity() * size_of::<Outcome>()
    }

    fn number(&mut self, checkers: Checkers) -> u32 {
        let (number, is_new) = self.texts.insert(&format!("{checkers:?}"));
        if is_new {
            self.states.push(checkers);
        }
        number
    }

    /// The state after it is shown the events with this number, at a time that is also given in ticks.
    pub fn show(
        &mut self,
        watch: u32,
        (batch, events): (u32, &[(RobotId, Event)]),
        (tick, at): (u64, Time),
    ) -> &Outcome {
        let (number, is_new) = self.known.insert(&[watch, batch, tick as u32], &[]);
        if is_new {
            let (after, violations) = observe(&self.states[watch as usize], events, at);
            let watch = self.number(after);
            self.outcomes.push(Outcome {
                watch,
                violation: violations.into_iter().next().map(Box::new),
            });
        }
        &self.outcomes[number as usize]
    }
}
