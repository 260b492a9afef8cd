//! Epochs: the numbers of leaders' terms.
//!
//! Invariant: an epoch names its leader, and no robot uses one twice. It is the time of the candidacy, in milliseconds
//! of the robot's own clock, and the robot's number. If the robot knows later epochs, because another's clock is ahead,
//! it is the first later time that differs from its clock by a whole number of [`CYCLE`]s. So two leaders cannot share
//! an epoch even if every vote is forgotten, as long as no robot's clock goes back while it is down; and an epoch
//! invented by a corruption is not that of another robot. Only a robot that forgets an epoch of its own which was ahead
//! of its clock, and hears again of the one before it, could use it twice, and only if it stands whole cycles later.
//! Epochs are ahead of clocks by at most a cycle for each leader, so they continue to grow with the clocks after all
//! state is lost.

use serde::{Deserialize, Serialize};
use starl_core::{Random, RobotId, Time};

/// The bits that hold the robot's number.
const ROBOT_BITS: u32 = 20;

/// Epochs this much further ahead than a robot's own clock, milliseconds, come from a corruption.
const FURTHEST: u64 = 1 << 42;

/// Milliseconds, about a second.
const CYCLE: u64 = 1 << 10;

/// An epoch; later ones are greater. 0 is before all epochs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) struct Epoch(pub u64);

impl Epoch {
    /// The first epoch of a robot after `known`, at a moment of its clock.
    pub fn next(known: Epoch, now: Time, leader: RobotId) -> Epoch {
        let (now, least) = (milliseconds(now), known.moment() + 1);
        let moment = now + least.saturating_sub(now).next_multiple_of(CYCLE);
        Epoch(moment << ROBOT_BITS | u64::from(leader.0) & ((1 << ROBOT_BITS) - 1))
    }

    /// The leader of the epoch.
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
        Epoch(random.magnitude())
    }

    fn moment(self) -> u64 {
        self.0 >> ROBOT_BITS
    }
}

fn milliseconds(time: Time) -> u64 {
    time.0 / 1_000_000
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_robot_that_hears_again_of_epochs_that_it_forgot_uses_none_twice() {
        let at = |seconds: u64| Time(seconds * 1_000_000_000);
        let ahead = Epoch::next(Epoch(0), at(100), RobotId(1));
        let before = Epoch::next(ahead, at(3), RobotId(0));
        // It loses its state, leads again, and then gets a late copy of an earlier message.
        let anew = Epoch::next(Epoch(0), at(8), RobotId(0));
        let after = Epoch::next(ahead.max(anew), at(9), RobotId(0));
        assert!(ahead < before && ahead < after && before != after);
        assert!(Epoch::next(after, at(9), RobotId(0)) > after);
    }
}
