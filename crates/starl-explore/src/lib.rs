//! Explores every behaviour of a small fleet within bounds: all orders in which datagrams can arrive, losses,
//! duplicates, crashes and restarts, timers and activations at every possible time.
//!
//! It is a host of the same [`starl_core::Agent`] as the simulator, with the same checkers of properties. A simulation
//! shows one behaviour. An exploration visits all of them, for small fleets. Robots stand still.
//! `docs/explanation/exploration.md` explains the model of time, and the meaning of a search that found nothing.
//!
//! [`Search`] finds the states, and the shortest path to a violation; [`Walk`] follows that path step by step, without
//! any of the search's optimisations.

mod actors;
mod batch;
mod bounds;
mod code;
mod cover;
mod doubt;
mod expand;
mod facts;
mod grow;
mod known;
mod level;
mod model;
mod moves;
mod robot;
mod robots;
mod scene;
mod search;
mod step;
mod table;
mod texts;
mod threads;
mod twins;
mod walk;
mod warm_up;
mod watch;

pub use bounds::{Bounds, Clocks};
pub use expand::STUCK;
pub use model::{Member, Model};
pub use scene::{Invariant, Scene};
pub use search::{Counterexample, End, Report, Search, TooManyRobots};
pub use step::{Datagram, Step};
pub use walk::{Impossible, Moment, Walk};

use starl_core::{Event, RobotId, Time};
use starl_properties::{Checker, Violation};

/// The subject of an exploration, its bounds, and its properties.
#[derive(Clone)]
pub struct Setup {
    /// The fleet.
    pub model: Model,
    /// How much may go wrong.
    pub bounds: Bounds,
    /// The checkers of behaviours.
    pub checkers: Vec<Box<dyn Checker>>,
    /// The invariants of states.
    pub invariants: Vec<Box<dyn Invariant>>,
}

/// The property that is violated where a program says that it cannot continue, or a run-time error stops it.
pub const FAILED: &str = "explore.failed";

/// A program that cannot continue, among events.
fn failure(events: &[(RobotId, Event)], at: Time) -> Option<Violation> {
    events.iter().find_map(|(robot, event)| match event {
        Event::Failed(reason) => Some(Violation {
            property: FAILED.into(),
            at,
            robots: vec![*robot],
            text: format!("the program of robot {robot} failed: {reason}"),
        }),
        _ => None,
    })
}

/// Robots that wait for what will never happen.
fn stuck(waiting: Vec<RobotId>, at: Time) -> Option<Violation> {
    let names: Vec<String> = waiting.iter().map(RobotId::to_string).collect();
    (!waiting.is_empty()).then(|| Violation {
        property: STUCK.into(),
        at,
        text: format!(
            "nothing can happen any more, and these robots have not finished: {}",
            names.join(", ")
        ),
        robots: waiting,
    })
}
