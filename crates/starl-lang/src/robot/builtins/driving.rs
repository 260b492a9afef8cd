//! Commands of robot models, with which a program steers by itself.
//!
//! Invariant: a command ends all trips first, so that no primitive replaces it at the next estimate. A command that the
//! robot's model refuses stops the robot, and its host logs a warning.

use crate::machine::HostCall;
use crate::robot::arguments::{Arguments, Called};
use crate::robot::host::RobotHost;
use starl_core::Command;

/// Gives a command.
pub fn drive(host: &mut RobotHost<'_, '_>, command: Command) -> Called {
    for slot in host.bound.iter_mut().flatten() {
        if slot.bound.target().is_some() {
            slot.is_stirred = true;
            slot.bound.halt(host.context.robot);
        }
    }
    host.context.robot.drive(command);
    Ok(1)
}

pub fn straight(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    let speed = Arguments::of(call).float();
    drive(host, Command::Straight { speed })
}

pub fn turn(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    let rate = Arguments::of(call).float();
    drive(host, Command::Turn { rate })
}

pub fn curve(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    let mut arguments = Arguments::of(call);
    let (speed, radius) = (arguments.float(), arguments.float());
    drive(host, Command::Curve { speed, radius })
}

pub fn wheels(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    let mut arguments = Arguments::of(call);
    let (left, right) = (arguments.float(), arguments.float());
    drive(host, Command::Wheels { left, right })
}

pub fn car(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    let mut arguments = Arguments::of(call);
    let (speed, angle) = (arguments.float(), arguments.float());
    drive(host, Command::Steer { speed, angle })
}

pub fn velocity(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    let mut arguments = Arguments::of(call);
    let velocity = arguments.point();
    let yaw_rate = arguments.optional(Arguments::float).unwrap_or(0.0);
    drive(host, Command::Velocity { velocity, yaw_rate })
}

pub fn attitude(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    let mut arguments = Arguments::of(call);
    let command = Command::Attitude {
        yaw_rate: arguments.float(),
        pitch: arguments.float(),
        roll: arguments.float(),
        gaz: arguments.float(),
    };
    drive(host, command)
}
