//! Shared variables in properties: what a robot reads of them, from its own copy.

use super::observables::{NOT_KNOWN, Observable, PropertyHost, observable};
use crate::machine::HostCall;
use crate::robot::arguments::Arguments;
use crate::robot::primitives::{candidates, give, give_all};
use crate::robot::shape::Shape;
use alloc::borrow::Cow;
use starl_core::RobotId;
use starl_primitives::SharedMemory;

/// The variable, then the robot whose copy is read.
const OF_A_ROBOT: &[Shape] = &[Shape::Shared, Shape::Robot];

/// All questions about shared variables.
pub static SHARED: &[Observable] = &[
    observable(
        "shared.read",
        OF_A_ROBOT,
        Shape::Optional(&Shape::Any),
        |host, call| {
            let (memory, variable, _) = asked(host, call)?;
            give(host.code.program(), call, &candidates(memory, variable))
        },
    ),
    observable(
        "shared.element",
        &[Shape::Shared, Shape::Robot, Shape::Robot],
        Shape::Optional(&Shape::Any),
        |host, call| {
            let (memory, variable, owner) = asked(host, call)?;
            give(
                host.code.program(),
                call,
                &[memory.read_of(variable, owner)],
            )
        },
    ),
    observable(
        "shared.all",
        OF_A_ROBOT,
        Shape::Map(&Shape::Robot, &Shape::Any),
        |host, call| {
            let (memory, variable, _) = asked(host, call)?;
            give_all(host.code.program(), memory, variable, call)
        },
    ),
];

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
