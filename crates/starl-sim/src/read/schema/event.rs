//! The fields of `event`. Which of them an event takes depends on its kind.

use super::*;

/// The kinds of events: those of faults, and what else steers a run.
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
    "push",
    "network",
    "add_obstacle",
    "move_obstacle",
    "remove_obstacle",
    "set_way_point",
    "remove_way_point",
    "set_thing",
    "remove_thing",
    "tell",
    "join",
    "leave",
];

/// Something that happens.
pub(super) const EVENT: &[Field] = &join::<
    { FIRST.len() + network::CHANGES.len() + world::SHAPE.len() + LAST.len() },
>(&[FIRST, network::CHANGES, world::SHAPE, LAST]);

const FIRST: &[Field] = &[
    field(
        "at",
        TIME,
        Default::Depends("required, or else `rate`"),
        "The time at which it happens, once.",
    ),
    field(
        "rate",
        Kind::Quantity(Dimension::Rate, Range::Positive),
        Default::Word("never"),
        "Its rate: it happens repeatedly at random times, drawn from the seed as a Poisson process.",
    ),
    field(
        "within",
        Kind::Table(CORNERS),
        Default::Word("none"),
        "With a `rate`: the rectangle in which things or waypoints appear, each at a random place.",
    ),
    field(
        "kind",
        Kind::Choice(KINDS),
        Default::Required,
        "The kind of event; see the list below.",
    ),
    field(
        "robots",
        Kind::Robots,
        Default::Depends("required for faults and `leave`; all for `tell`"),
        "The robots concerned.",
    ),
    field(
        "groups",
        Kind::RobotGroups,
        Default::Depends("required for `partition` and `one_way`"),
        "The parts of the fleet; all other robots form one more part.",
    ),
    field(
        "robot",
        Kind::Text,
        Default::Depends("required for `push`"),
        "The name of the robot that is pushed.",
    ),
    field(
        "by",
        Kind::Point,
        Default::Depends("required for `push`"),
        "The distance and direction of the push.",
    ),
];

const LAST: &[Field] = &[
    world::HIDDEN,
    field(
        "index",
        Kind::Count(0, u32::MAX as u64),
        Default::Depends("required for `move_obstacle` and `remove_obstacle`"),
        "The number of the obstacle, from 0: those of the scenario come first, then the four walls of \
         `world.bounds` if there are bounds, then those that have appeared.",
    ),
    field(
        "name",
        Kind::Text,
        Default::Depends("required for waypoints, things and `join`"),
        "The name of the waypoint, thing or robot. With a `rate`, the number of the occasion is \
         appended: `task0`, `task1`, ...",
    ),
    field(
        "position",
        Kind::Point,
        Default::Depends("required with `name`, but not with `within` or to remove something"),
        "The place of the waypoint, thing or robot.",
    ),
    field(
        "heading",
        Kind::Quantity(Dimension::Angle, Range::Any),
        Default::Value("0deg"),
        "The heading of a robot that joins, from the x axis, left positive.",
    ),
    field(
        "group",
        Kind::Count(0, u32::MAX as u64),
        Default::Value("0"),
        "A number by which a program can group waypoints.",
    ),
    field(
        "order",
        Kind::Text,
        Default::Depends("required for `tell`"),
        "The name of the order.",
    ),
    field(
        "fields",
        Kind::Parameters,
        Default::Word("none"),
        "The fields of the order, under names that the program defines.",
    ),
    field(
        "like",
        Kind::Text,
        Default::Depends("required for `join`"),
        "The name of a robot: the one that joins has the same model, sensors, program and parameters.",
    ),
];
