//! The effect of a transient fault on ReachAvoid.
//!
//! It recovers from any state: while a command is under way one timer is always armed, which takes it out of
//! each of its phases, and the number of plans that it may ask for is bounded. A command that was lost is for
//! the program to give again, which sees that none is active; and one whose target is another one ends there.

use super::{Phase, ReachAvoid};
use starl_core::{Point, Random};

impl ReachAvoid {
    /// Overwrites the state at random, as a transient fault would.
    pub fn corrupt(&mut self, random: &mut Random) {
        self.done = random.chance(0.5);
        self.failed = random.chance(0.5);
        self.reason = None;
        self.ticket = random.bits();
        if self.lane.is_some() {
            self.corrupt_lane(random);
        }
        if random.chance(0.5) {
            self.command = None;
        }
        let Some(command) = &mut self.command else {
            return;
        };
        if random.chance(0.5) {
            let mut coordinate = || random.between(-100.0, 100.0);
            command.target = Point::new(coordinate(), coordinate(), command.target.z);
        }
        command.replans = random.bits();
        command.plan_failures = random.bits();
        match random.below(4) {
            0 => {
                command.phase = Phase::Braking {
                    around_robots: random.chance(0.5),
                }
            }
            1 => command.phase = Phase::Planning,
            2 => command.phase = Phase::Pausing,
            _ => {}
        }
    }
}
