//! Excuses: deviations that do not count as violations, with their reasons.
//!
//! Properties are guaranteed for robots and networks that work. If a property does not hold, or is not judged, because
//! of a recorded fault, checkers count this here. So "holds" without a remark means that there were no excuses.

use crate::Violation;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;

/// The reason of an excuse.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Excuse {
    /// A robot that is concerned was down, or had started again since.
    Down,
    /// A program that is concerned could not continue.
    Failed,
    /// Sensors were frozen.
    Sensors,
    /// Motors were stuck.
    Motors,
    /// The state of a robot was overwritten.
    Corruption,
    /// The network was partitioned.
    Partition,
    /// A fault came so shortly before that not all had got over it.
    Recovery,
    /// Too few robots were up to continue, or to remember.
    NoMajority,
    /// Clocks ran wrong by more than leases count on.
    Clocks,
    /// A robot that had crashed in the air fell.
    Fall,
    /// A robot was pushed.
    Push,
    /// An obstacle appeared or moved to where a robot was.
    Obstacle,
    /// The assumption of the property did not hold.
    Assumption,
}

impl Excuse {
    /// The reason in words.
    pub fn text(self) -> &'static str {
        match self {
            Excuse::Down => "a robot was down",
            Excuse::Failed => "a program had failed",
            Excuse::Sensors => "sensors were frozen",
            Excuse::Motors => "motors were stuck",
            Excuse::Corruption => "state was overwritten",
            Excuse::Partition => "the network was partitioned",
            Excuse::Recovery => "a fault came shortly before",
            Excuse::NoMajority => "too few robots were up",
            Excuse::Clocks => "clocks ran too wrong",
            Excuse::Fall => "a robot that had crashed fell",
            Excuse::Push => "a robot was pushed",
            Excuse::Obstacle => "an obstacle appeared on a robot",
            Excuse::Assumption => "its assumption was false",
        }
    }
}

/// How often a checker excused what, by property. No checker goes by it, so `Debug` shows nothing of it.
#[derive(Clone, Default)]
pub struct Excused(BTreeMap<(&'static str, Excuse), u64>);

impl Excused {
    /// Counts one more.
    pub fn note(&mut self, property: &'static str, excuse: Excuse) {
        *self.0.entry((property, excuse)).or_default() += 1;
    }

    /// Counts what would have been a violation.
    pub fn forgive(&mut self, violation: &Violation, excuse: Excuse) {
        if let Cow::Borrowed(property) = violation.property {
            self.note(property, excuse);
        }
    }

    /// How often a property was excused, by reason.
    pub fn of(&self, property: &str) -> Vec<(Excuse, u64)> {
        let counts = self.0.iter().filter(|((of, _), _)| *of == property);
        counts
            .map(|((_, excuse), count)| (*excuse, *count))
            .collect()
    }
}

impl fmt::Debug for Excused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Excused")
    }
}
