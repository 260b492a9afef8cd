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

/// Faults at random.
pub(super) const RATES: &[Field] = &[
    field(
        "crash",
        RATE,
        Default::Value("0/s"),
        "Crashes of each robot.",
    ),
    field(
        "restart_after",
        SPAN,
        Default::Word("never"),
        "A crashed robot restarts after this time.",
    ),
    field(
        "partition",
        RATE,
        Default::Value("0/s"),
        "Partitions of the fleet into two random halves.",
    ),
    field(
        "heal_after",
        SPAN,
        Default::Value("5s"),
        "A partition heals after this time.",
    ),
    field(
        "stuck_motor",
        RATE,
        Default::Value("0/s"),
        "Stuck motors of each robot.",
    ),
    field(
        "frozen_sensor",
        RATE,
        Default::Value("0/s"),
        "Frozen sensors of each robot.",
    ),
    field(
        "repair_after",
        SPAN,
        Default::Value("5s"),
        "Motors and sensors are repaired after this time.",
    ),
    field(
        "corrupt_state",
        RATE,
        Default::Value("0/s"),
        "Corruptions of each robot's state.",
    ),
];
