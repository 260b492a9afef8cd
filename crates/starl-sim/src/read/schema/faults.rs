//! The fields of `fault` and `fault_rates`.

use super::*;

/// The kinds of faults.
const KINDS: &[&str] = &[
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
pub(super) const FAULT: &[Field] = &[
    field(
        "at",
        TIME,
        Default::Required,
        "The time at which it begins.",
    ),
    field(
        "kind",
        Kind::Choice(KINDS),
        Default::Required,
        "The kind of fault; see the list below.",
    ),
    field(
        "robots",
        Kind::Robots,
        Default::Depends("required, but not for `partition`, `one_way` and `heal`"),
        "The robots concerned.",
    ),
    field(
        "groups",
        Kind::RobotGroups,
        Default::Depends("required for `partition` and `one_way`, not for others"),
        "The parts of the fleet; all other robots form one more part.",
    ),
];
