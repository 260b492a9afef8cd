//! Shared variables in properties: what a robot reads of them, from its own copy.

use super::host::{NOT_KNOWN, PropertyHost};
use crate::machine::HostCall;
use crate::robot::arguments::{Arguments, Called};
use crate::robot::primitives::{candidates, give, give_all};
use alloc::borrow::Cow;
use starl_core::RobotId;
use starl_primitives::SharedMemory;

/// The value of a variable that all robots write.
pub fn read(host: &mut PropertyHost<'_>, call: &mut HostCall<'_>) -> Called {
    let (memory, variable, _) = asked(host, call)?;
    give(host.code.program(), call, &candidates(memory, variable))
}

/// The element of one robot.
pub fn element(host: &mut PropertyHost<'_>, call: &mut HostCall<'_>) -> Called {
    let (memory, variable, owner) = asked(host, call)?;
    let value = memory.read_of(variable, owner);
    give(host.code.program(), call, &[value])
}

/// All elements.
pub fn all(host: &mut PropertyHost<'_>, call: &mut HostCall<'_>) -> Called {
    let (memory, variable, _) = asked(host, call)?;
    give_all(host.code.program(), memory, variable, call)
}

/// The robot's memory, the variable's name, and the owner of the element that is asked for, if it is.
fn asked<'h>(
    host: &PropertyHost<'h>,
    call: &HostCall<'h>,
) -> Result<(&'h SharedMemory, &'h str, RobotId), Cow<'static, str>> {
    let mut arguments = Arguments::after_instance(call);
    let robot = arguments.robot();
    host.last.set(Some(robot));
    let memory = host.fleet.memory(robot).ok_or(NOT_KNOWN)?;
    let variable = call.import.labels.first().ok_or(NOT_KNOWN)?;
    Ok((memory, variable, arguments.robot()))
}
