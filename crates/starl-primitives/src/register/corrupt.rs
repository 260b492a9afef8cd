//! Overwriting registers at random, as a transient fault would, and what sets an operation right again.

use super::Register;
use super::entering::Standing;
use super::operation::Phase;
use super::tag::Tag;
use super::version::Version;
use crate::founders::Founders;
use starl_core::{Duration, Payload, Random, Robot, RobotId, Time};

/// Corrupted values are up to this long, bytes.
const LONGEST_VALUE: u32 = 40;

impl Register {
    /// Overwrites the state at random, within its types: for a program's [`starl_core::Program::corrupt`]. The names of
    /// registers do not change, because they are part of the program.
    pub fn corrupt(&mut self, random: &mut Random) {
        for copy in self.replica.all_mut() {
            if random.chance(0.5) {
                copy.version = Some(version(random));
            }
            if random.chance(0.2) {
                copy.promised = Some(tag(random));
            }
        }
        self.founders = Founders::default();
        for life in self.lives.all_mut() {
            *life = random.magnitude();
        }
        if random.chance(0.5) {
            self.standing = Standing::Up(random.magnitude());
        }
        for operation in self.operations.values_mut() {
            operation.answers.retain(|_, _| random.chance(0.5));
            if random.chance(0.5) {
                operation.latest = Some(version(random));
                operation.phase = Phase::Store;
            }
            operation.begun = Time(random.magnitude());
            operation.repetitions = random.bits();
        }
        self.last_number = random.bits();
        self.claimed.retain(|_, _| random.chance(0.5));
        self.gossip.interval = Duration(random.magnitude());
        self.gossip.equal = random.bits();
        self.gossip.compared = random.chance(0.5);
        self.suspects.retain(|_| random.chance(0.5));
    }

    /// Restarts an operation after a corruption.
    pub(super) fn begin_again(&mut self, robot: &mut Robot<'_>, number: u32) {
        if let Some(operation) = self.operations.get_mut(&number) {
            operation.latest = None;
            operation.enter(Phase::Query);
        }
        self.ask_again(robot, number);
    }
}

fn tag(random: &mut Random) -> Tag {
    Tag {
        count: random.magnitude(),
        writer: RobotId(random.bits()),
        incarnation: random.bits(),
    }
}

fn version(random: &mut Random) -> Version {
    Version::written(tag(random), value(random))
}

fn value(random: &mut Random) -> Payload {
    let length = random.below(LONGEST_VALUE);
    (0..length).map(|_| random.bits() as u8).collect()
}
