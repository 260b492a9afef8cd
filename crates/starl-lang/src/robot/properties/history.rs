//! The history of a property, kept by its judge.
//!
//! Only exceptional tuples of robots are stored: those for which an eventual condition has become true, those that wait
//! for a consequence, and those that violate the property.

use super::excuse::Excuse;
use super::reads::Reads;
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;
use starl_core::{RobotId, Time};

/// Robots for which a property is judged together.
pub type Row = Vec<RobotId>;

/// In place of a version: unknown.
pub const UNKNOWN: u64 = 0;
/// In place of a version: the verdict is final.
pub const CLOSED: u64 = u64::MAX;

/// The history of one property.
#[derive(Clone, Debug, Default)]
pub struct History {
    /// The variables that it reads.
    pub reads: Reads,
    /// Whether it was ever judged.
    pub judged: bool,
    /// Rows for which it was violated.
    pub violated: BTreeSet<Row>,
    /// Rows for which the eventual condition has become true.
    pub settled: BTreeSet<Row>,
    /// Rows that wait for the consequence, with the time since when.
    pub waiting: BTreeMap<Row, Time>,
    /// Whether the eventual condition is still false for some row.
    pub lacks: bool,
    /// Rows for which the assumption was false, with the last time.
    pub unassumed: BTreeMap<Row, Time>,
    /// Rows for which it is false at present, which is excused.
    pub forgiven: BTreeSet<Row>,
    /// How often a row was excused, by reason.
    pub excused: BTreeMap<Excuse, u64>,
    /// For a property of single robots: the version of each robot's state, in the order of the roster, at which there
    /// was nothing exceptional and only this state was read. While the version is unchanged the robot need not be
    /// judged again.
    pub marks: Vec<u64>,
}

impl History {
    /// The roster, which is in ascending order, has changed: marks follow their robots.
    pub fn rearrange(&mut self, before: &[RobotId], now: &[RobotId]) {
        let mark_of = |robot: &RobotId| {
            let place = before.binary_search(robot).ok()?;
            self.marks.get(place).copied()
        };
        let marks = now.iter().map(|robot| mark_of(robot).unwrap_or(UNKNOWN));
        self.marks = marks.collect();
    }
}
