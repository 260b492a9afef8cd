//! The number of a robot's life, by which messages from before a crash are distinguished from later ones.

use starl_core::Robot;
use starl_core::random::hash_key;

/// Drawn when it is first needed, and kept until the robot starts again.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Incarnation(Option<u32>);

impl Incarnation {
    /// This life's number.
    pub fn of(&mut self, robot: &mut Robot<'_>) -> u32 {
        // The clock is mixed in so that a robot whose random stream starts over draws another number.
        *self.0.get_or_insert_with(|| {
            let bits = u64::from(robot.random().bits());
            hash_key(robot.now().0, &[bits]) as u32
        })
    }

    /// From now on this life counts as another one.
    pub fn renew(&mut self) {
        self.0 = None;
    }

    /// This life's number, if it was needed before.
    pub fn known(self) -> Option<u32> {
        self.0
    }
}
