//! Robots that meet at a barrier.

use starl_core::{Primitives, Program, Robot};
use starl_primitives::Barrier;
use starl_primitives::barrier::Options;
use std::fmt::Write;

/// Arrives at the barrier at its first activation, and again after each pass, `meetings` times.
#[derive(Clone, Debug, Primitives)]
pub struct Waiter {
    barrier: Barrier,
    left: u8,
}

impl Waiter {
    /// Robots that meet this number of times.
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
