//! Robots that meet at a barrier.

use starl_core::{Primitives, Program, Robot};
use starl_primitives::Barrier;
use starl_primitives::barrier::Options;
use std::fmt::Write;

/// Comes to the barrier at its first activation, and again when it has passed, as often as it was told.
#[derive(Clone, Debug, Primitives)]
pub struct Waiter {
    barrier: Barrier,
    left: u8,
}

impl Waiter {
    /// Robots that meet so many times.
    pub fn new(meetings: u8) -> Waiter {
        Waiter {
            barrier: Barrier::new("barrier", None, Options::default()),
            left: meetings,
        }
    }
}

impl Program for Waiter {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if self.left > 0 && !self.barrier.is_waiting() {
            self.left -= 1;
            self.barrier.arrive(robot);
        }
    }

    fn write_state(&self, text: &mut dyn Write) -> bool {
        write!(text, "{self:?}").is_ok()
    }
}
