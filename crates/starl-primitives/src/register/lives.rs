//! Crash vectors: the known life of each robot.
//!
//! Invariant: a robot answers others only in a life whose number is greater than those of all lives in which it
//! answered before. So once a robot has heard of a later life, it knows that messages of an earlier one are forgotten.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::RobotId;
use starl_core::random::hash_key;

/// Numbers go no further: a greater one comes from a corruption.
const GREATEST: u64 = 1 << 62;

/// The first life's number; it goes without saying.
pub(super) const FIRST: u64 = 1;

/// Latest lives, by robot: those after the first.
#[derive(Clone, Debug, Default)]
pub(super) struct Lives(BTreeMap<RobotId, u64>);

impl Lives {
    /// The latest life of a robot that is known.
    pub fn of(&self, robot: RobotId) -> u64 {
        self.0.get(&robot).copied().unwrap_or(FIRST)
    }

    /// Records a life.
    pub fn learn(&mut self, robot: RobotId, life: u64) {
        if life > self.of(robot) && life <= GREATEST {
            self.0.insert(robot, life);
        }
    }

    /// A hash of all lives, including the robot's own.
    pub fn fingerprint(&self, own: u64) -> u64 {
        let words = self
            .0
            .iter()
            .map(|(robot, life)| hash_key(*life, &[robot.0.into()]));
        hash_key(own, &words.collect::<Vec<u64>>())
    }

    /// All lives except first ones.
    pub fn list(&self) -> Vec<(RobotId, u64)> {
        self.0.iter().map(|(&robot, &life)| (robot, life)).collect()
    }

    /// Forgets what no life of ours can have been.
    pub fn refresh(&mut self, is_member: impl Fn(RobotId) -> bool) {
        self.0
            .retain(|&robot, &mut life| is_member(robot) && life > FIRST && life <= GREATEST);
    }

    /// To be overwritten.
    pub fn all_mut(&mut self) -> impl Iterator<Item = &mut u64> {
        self.0.values_mut()
    }
}
