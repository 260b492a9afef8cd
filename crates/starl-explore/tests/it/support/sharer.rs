//! Robots that write a shared variable.

use starl_core::{Payload, Primitives, Program, Robot};
use starl_primitives::SharedMemory;
use starl_primitives::shared_memory::Options;
use std::fmt::Write;

/// Writes once, at its first activation.
#[derive(Clone, Debug, Primitives)]
pub struct Sharer {
    memory: SharedMemory,
    /// By robot.
    writes: Vec<bool>,
    is_done: bool,
}

impl Sharer {
    /// The robots whose entry is true write.
    pub fn new(writes: &[bool], options: Options) -> Sharer {
        Sharer {
            memory: SharedMemory::new("memory", options),
            writes: writes.to_vec(),
            is_done: false,
        }
    }
}

impl Program for Sharer {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if self.writes[robot.id().index()] && !self.is_done {
            self.is_done = true;
            let value = Payload::from_slice(&[robot.id().0 as u8]);
            let written = self.memory.write(robot, "x", value);
            written.expect("there is room");
        }
    }

    fn write_state(&self, text: &mut dyn Write) -> bool {
        write!(text, "{self:?}").is_ok()
    }
}
