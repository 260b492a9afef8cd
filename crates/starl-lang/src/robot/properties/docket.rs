//! What a judge remembers of a property.
//!
//! Only what is out of the ordinary: rows of robots for which something came true that was to come once,
//! or that wait for what is to follow, or for which the property was violated.

use super::Excuse;
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;
use starl_core::{RobotId, Time};

/// Robots that a property is judged of together.
pub type Row = Vec<RobotId>;

/// In the place of a version: nothing is known.
pub const UNKNOWN: u64 = 0;
/// In the place of a version: there is nothing more to judge.
pub const CLOSED: u64 = u64::MAX;

/// What is remembered of one property.
#[derive(Clone, Debug, Default)]
pub struct Docket {
    /// The variables that it reads, by their places in the program.
    pub reads: Vec<usize>,
    /// Whether it was ever judged.
    pub judged: bool,
    /// Rows for which it was violated.
    pub violated: BTreeSet<Row>,
    /// Rows for which what was to come once has come.
    pub settled: BTreeSet<Row>,
    /// Rows that wait for what is to follow, and since when.
    pub waiting: BTreeMap<Row, Time>,
    /// Whether some row has not seen what is to come.
    pub lacks: bool,
    /// Rows for which what is assumed was not so, and when last.
    pub unassumed: BTreeMap<Row, Time>,
    /// Rows for which it is false at present, which is excused.
    pub forgiven: BTreeSet<Row>,
    /// How often a row came to be forgiven, by reason.
    pub excused: BTreeMap<Excuse, u64>,
    /// For a property of single robots the version of each one's state, in the order of the roster,
    /// at which nothing was out of the ordinary and nothing else was looked at: while it is the same
    /// the robot need not be judged again.
    pub marks: Vec<u64>,
}

impl Docket {
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
