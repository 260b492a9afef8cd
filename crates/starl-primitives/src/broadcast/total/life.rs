//! The identity of the lives of robots.

use super::Total;
use serde::{Deserialize, Serialize};
use starl_core::random::hash_key;
use starl_core::{Robot, RobotId};

/// A robot from the moment at which it remembers nothing of the group to the next such moment: another
/// one after each start, and whenever it gives a group up. It is a member of at most one group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) struct Life {
    pub robot: RobotId,
    pub name: LifeName,
}

/// Distinguishes the lives of one robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) struct LifeName {
    /// Names the robot's start. Its lower half is the incarnation that records know it by; the upper half
    /// depends on the time too, as many starts draw the same incarnation sooner or later.
    start: u64,
    /// Counts the lives since then.
    count: u32,
}

impl Life {
    /// A life of a test, named by its start.
    #[cfg(test)]
    pub fn of_test(robot: RobotId, start: u64) -> Life {
        let name = LifeName { start, count: 0 };
        Life { robot, name }
    }

    /// The incarnation whose messages it sends.
    pub fn incarnation(&self) -> u32 {
        self.name.start as u32
    }
}

impl Total {
    /// This robot's life.
    pub(super) fn life(&mut self, robot: &mut Robot<'_>) -> Life {
        let incarnation = u64::from(self.incarnation.of(robot));
        let start = *self.start.get_or_insert_with(|| {
            let upper = hash_key(robot.now().0, &[incarnation]) << 32;
            upper | incarnation
        });
        let name = LifeName {
            start,
            count: self.lives,
        };
        Life {
            robot: robot.id(),
            name,
        }
    }
}
