//! Robots that read and write a register.

use starl_core::{Payload, Primitives, Program, Robot};
use starl_primitives::Register;
use starl_primitives::register::Options;
use std::fmt::Write;

/// An operation on the register.
#[derive(Clone, Copy, Debug)]
pub enum Operation {
    Read,
    Write,
}

/// Begins its one operation at its first activation.
#[derive(Clone, Debug, Primitives)]
pub struct Keeper {
    register: Register,
    /// By robot.
    operations: Vec<Option<Operation>>,
    is_asked: bool,
}

impl Keeper {
    /// Each robot does the operation at its number, if there is one.
    pub fn new(operations: &[Option<Operation>], options: Options) -> Keeper {
        Keeper {
            register: Register::new("register", None, options),
            operations: operations.to_vec(),
            is_asked: false,
        }
    }
}

impl Program for Keeper {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if std::mem::replace(&mut self.is_asked, true) {
            return;
        }
        let value = Payload::from_slice(&[robot.id().0 as u8]);
        let begun = match self.operations[robot.id().index()] {
            Some(Operation::Read) => self.register.read(robot, "x"),
            Some(Operation::Write) => self.register.write(robot, "x", value),
            None => return,
        };
        begun.expect("nothing else is under way");
    }

    fn write_state(&self, text: &mut dyn Write) -> bool {
        write!(text, "{:?} {}", self.register, self.is_asked).is_ok()
    }
}
