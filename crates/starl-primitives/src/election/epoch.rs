//! The numbers of leaderships.
//!
//! Invariant: an epoch names its leader, and no robot uses one twice. It is the moment at which a robot
//! stood, in milliseconds of its own clock, or more where it knows of later epochs, and that robot's number.
//! So two leaders cannot share an epoch even if every vote is forgotten, as long as no robot's clock goes
//! back while it is down; and an epoch that a corruption made up is no other robot's either.

use super::options::random_bits;
use serde::{Deserialize, Serialize};
use starl_core::{Random, RobotId, Time};

/// The bits that hold the robot's number.
const ROBOT_BITS: u32 = 20;

/// Epochs this much further ahead than a robot's own clock, milliseconds, come from a corruption.
const FURTHEST: u64 = 1 << 42;

/// An epoch; later ones are greater. 0 is before all epochs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) struct Epoch(pub u64);

impl Epoch {
    /// The first epoch of a robot after `known`, at a moment of its clock.
    pub fn next(known: Epoch, now: Time, leader: RobotId) -> Epoch {
        let moment = (known.moment() + 1).max(milliseconds(now));
        Epoch(moment << ROBOT_BITS | u64::from(leader.0) & ((1 << ROBOT_BITS) - 1))
    }

    /// Whose it is.
    pub fn leader(self) -> RobotId {
        RobotId(self.0 as u32 & ((1 << ROBOT_BITS) - 1))
    }

    /// Whether a robot with this clock may believe it.
    pub fn is_plausible(self, now: Time) -> bool {
        self.moment() <= milliseconds(now) + FURTHEST
    }

    /// Whether a robot's number fits in.
    pub fn fits(robot: RobotId) -> bool {
        robot.0 >> ROBOT_BITS == 0
    }

    /// Any number at all.
    pub fn random(random: &mut Random) -> Epoch {
        Epoch(random_bits(random))
    }

    fn moment(self) -> u64 {
        self.0 >> ROBOT_BITS
    }
}

fn milliseconds(time: Time) -> u64 {
    time.0 / 1_000_000
}
