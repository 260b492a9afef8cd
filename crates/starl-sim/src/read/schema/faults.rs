//! The fields of `fault`.

use super::*;

/// The kinds of faults.
pub(super) const KINDS: &[&str] = &[
    "crash",
    "restart",
    "partition",
    "one_way",
    "heal",
    "stuck_motor",
    "frozen_sensor",
    "repair",
    "corrupt_state",
];

/// A fault on the schedule.
pub(super) const FAULT: &[Field] = fields! {
    /// The time at which it begins.
    at = TIME, Required;
    /// The kind of fault; see the list below.
    kind = Kind::Choice(KINDS), Required;
    /// The robots concerned.
    robots = Kind::Robots, Depends("required, but not for `partition`, `one_way` and `heal`");
    /// The parts of the fleet; all other robots form one more part.
    groups = Kind::RobotGroups, Depends("required for `partition` and `one_way`, not for others");
};
