//! Robots that broadcast.

use starl_core::{Primitives, Program, Robot};
use starl_primitives::Broadcast;
use starl_primitives::broadcast::Order;
use starl_primitives::reliable::Options;
use std::fmt::Write;

/// Broadcasts once at each of its first activations.
#[derive(Clone, Debug, Primitives)]
pub struct Speaker {
    broadcast: Broadcast,
    /// By robot: how many messages it has left.
    left: Vec<u8>,
}

impl Speaker {
    /// Each robot broadcasts the number of messages at its index.
    pub fn new(messages: &[u8], order: Order, options: Options) -> Speaker {
        Speaker {
            broadcast: Broadcast::in_order("speech", order, options),
            left: messages.to_vec(),
        }
    }
}

impl Program for Speaker {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        let left = &mut self.left[robot.id().index()];
        if *left > 0 {
            *left -= 1;
            self.broadcast.broadcast(robot, left);
        }
    }

    fn write_state(&self, text: &mut dyn Write) -> bool {
        write!(text, "{self:?}").is_ok()
    }
}
