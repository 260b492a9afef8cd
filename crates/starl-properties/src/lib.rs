//! Properties that are checked on every run, of any host, apart from the programs they are about.
//!
//! A [`Checker`] sees the stream of records and nothing else, so it judges a live run and a trace from a file alike.
//! It knows the robots' bodies, the obstacles and the bounds that are promised: the [`Setting`]. A [`Monitor`] sees the
//! running programs themselves, through the host's [`Witness`]. A [`Watch`] has all of them look at a run.

mod barrier;
mod bodies;
mod broadcast;
mod broadcast_order;
mod disturbance;
mod election;
mod excuse;
mod failure_detector;
mod geocast;
mod health;
mod heed;
mod monitor;
mod mutex;
mod no_collision;
mod outstanding;
mod parts;
mod passing;
mod pending;
mod reach_avoid;
mod register;
mod registration;
mod report;
mod setting;
mod shared_memory;
mod taken;
mod track;
mod unicast;
mod watch;

pub use excuse::{Excuse, Excused};
pub use heed::Kinds;
pub use monitor::{Monitor, Witness};
pub use setting::{Properties, Setting};
pub use watch::{Verdict, Watch};

use starl_core::event::Name;
use starl_core::{Record, RobotId, Time};
use std::fmt;

/// A property that does not hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    /// Which property, e.g. `reach_avoid.safety`.
    pub property: Name,
    /// When it was seen.
    pub at: Time,
    /// The robots concerned.
    pub robots: Vec<RobotId>,
    /// The observation, in one sentence.
    pub text: String,
}

impl Violation {
    fn new(
        property: &'static str,
        at: Time,
        robots: impl Into<Vec<RobotId>>,
        text: String,
    ) -> Violation {
        Violation {
            property: property.into(),
            at,
            robots: robots.into(),
            text,
        }
    }
}

/// Checks the properties of one primitive, or one property of the world. Its `Debug` shows its whole
/// state, so that an explorer can compare two checkers.
pub trait Checker: dyn_clone::DynClone + fmt::Debug + Send + Sync {
    /// The properties it checks.
    fn properties(&self) -> &'static [&'static str];

    /// The kinds of events that affect the checker at present, until it observes one of them or time passes. Other
    /// events may be skipped.
    fn heeds(&self) -> Kinds {
        Kinds::ALL
    }

    /// Whether the property has applied so far, if its primitive is used: for example, not every broadcast has an
    /// order.
    fn has_subject(&self, property: &str) -> bool {
        let _ = property;
        true
    }

    /// The kinds of events without which the property cannot be judged, besides those of primitives and faults.
    fn needs(&self, property: &str) -> Kinds {
        let _ = property;
        Kinds::NONE
    }

    /// Whether it judges some robots correctly when records of others are missing.
    fn bears_missing_robots(&self) -> bool {
        false
    }

    /// Whether a deadline is pending, so that the property can be violated without further events.
    fn is_owed(&self, property: &str) -> bool {
        let _ = property;
        false
    }

    /// How often something was excused that speaks against a property, and why.
    fn excused(&self, property: &str) -> Vec<(Excuse, u64)> {
        let _ = property;
        Vec::new()
    }

    /// Observes the next record; records are in the order of their times.
    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>);

    /// Advances to `now`, when all records before it have been observed: deadlines that have passed are violated.
    fn advance(&mut self, now: Time, violations: &mut Vec<Violation>) {
        let _ = (now, violations);
    }
}

dyn_clone::clone_trait_object!(Checker);

/// The checkers that a setting asks for.
pub fn checkers(setting: &Setting) -> Vec<Box<dyn Checker>> {
    let wanted = &setting.properties;
    let mut checkers: Vec<Box<dyn Checker>> = Vec::new();
    if wanted.no_collision {
        checkers.push(Box::new(no_collision::NoCollision::new(setting)));
    }
    if wanted.reach_avoid {
        checkers.push(Box::new(reach_avoid::ReachAvoid::new(setting)));
    }
    if wanted.broadcast {
        checkers.push(Box::new(broadcast::Broadcast::new(setting)));
        checkers.push(Box::new(broadcast_order::BroadcastOrder::new(setting)));
    }
    if wanted.geocast {
        checkers.push(Box::new(geocast::Geocast::new(setting)));
    }
    if wanted.unicast {
        checkers.push(Box::new(unicast::Unicast::new(setting)));
    }
    if wanted.shared_memory {
        checkers.push(Box::new(shared_memory::SharedMemory::new(setting)));
        checkers.push(Box::new(shared_memory::Causality::new(setting)));
    }
    if wanted.election {
        checkers.push(Box::new(election::Election::new(setting)));
    }
    if wanted.register {
        checkers.push(Box::new(register::Register::new(setting)));
    }
    if wanted.mutex {
        checkers.push(Box::new(mutex::Mutex::new(setting)));
    }
    if wanted.registration {
        checkers.push(Box::new(registration::Registration::new(setting)));
    }
    if wanted.barrier {
        checkers.push(Box::new(barrier::Barrier::new(setting)));
    }
    if wanted.failure_detector {
        checkers.push(Box::new(failure_detector::FailureDetector::new(setting)));
    }
    checkers
}

/// Robots in words: `robot 3`, or `robots 3, 4 and 7`.
fn robot_list(robots: &[RobotId]) -> String {
    match robots {
        [] => "no robot".into(),
        [robot] => format!("robot {robot}"),
        [rest @ .., last] => {
            let rest: Vec<String> = rest.iter().map(RobotId::to_string).collect();
            format!("robots {} and {last}", rest.join(", "))
        }
    }
}
