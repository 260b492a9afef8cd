//! The defaults of a program's parameters. They depend on no robot.

use super::arguments::Called;
use crate::machine::{Host, HostCall, Limits, Machine, Program, RuntimeError, State, Workspace};

/// A state with the defaults of the parameters.
pub(super) fn defaults(program: &Program) -> Result<State, RuntimeError> {
    let mut state = program.new_state();
    let mut workspace = Workspace::new();
    let limits = Limits::default();
    Machine::new(program, &mut state, &mut workspace, &mut Nobody, limits).defaults()?;
    Ok(state)
}

/// The host of what needs no robot.
struct Nobody;

impl Host for Nobody {
    fn call(&mut self, _: u32, _: &mut HostCall<'_>) -> Called {
        Err("a default cannot depend on the robot".into())
    }
}
