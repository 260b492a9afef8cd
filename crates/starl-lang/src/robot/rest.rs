//! Resting programs: no action is enabled, and none will be until there is an input. Their guards need not be evaluated
//! meanwhile, so a fleet that waits costs little.
//!
//! Invariant: while a program rests, the values that its guards depend on are those for which no guard held. Guards
//! depend on the program's variables, which only the program itself and faults change, and on its primitives. A
//! primitive's values change only after an input or when an activation acts on it. The waypoints change only with an
//! order, which ends the rest.

use super::joint::Joint;
use crate::machine::{Action, Bytecode, Instruction};
use alloc::vec::Vec;
use starl_core::{Input, Port, Primitive, Robot};

/// Whether all guards follow from variables and primitives alone: not from the time, or where the robot is.
pub fn is_steady(bytecode: &Bytecode, joints: &[Joint]) -> bool {
    if bytecode.actions.iter().any(Action::is_timed) {
        return false;
    }
    let guards: Vec<u32> = bytecode.actions.iter().map(|action| action.guard).collect();
    let is_steady = |instruction: &&Instruction| match instruction {
        Instruction::CallHost { import, .. } => {
            // Imports are joined in their order.
            let joint = joints.get(import.0 as usize);
            joint.is_some_and(|joint| joint.is_steady)
        }
        Instruction::LoadOther { .. } | Instruction::LoadOtherObject { .. } => false,
        _ => true,
    };
    bytecode.reachable(&guards).iter().all(is_steady)
}

/// A primitive whose inputs end the program's rest.
pub struct Disturbing<'a> {
    pub primitive: &'a mut dyn Primitive,
    /// Whether the program rests.
    pub rests: &'a mut bool,
}

impl Primitive for Disturbing<'_> {
    fn port(&self) -> Port {
        self.primitive.port()
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        let before = robot.asked();
        self.primitive.handle(robot, input);
        *self.rests &= matches!(input, Input::Activate) && robot.asked() == before;
    }

    fn save(&mut self, robot: &mut Robot<'_>) {
        self.primitive.save(robot);
    }
}
