//! The fields of `event`. Which of them an event takes depends on its kind.

use super::*;

/// The kinds of events: those of faults, and what else steers a run.
const KINDS: &[&str] =
    &join::<&str, { faults::KINDS.len() + STEERING.len() }>(&[faults::KINDS, STEERING]);

const STEERING: &[&str] = &[
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
pub(super) const EVENT: &[Field] =
    &join::<Field, { FIRST.len() + network::CHANGES.len() + world::SHAPE.len() + 1 + LAST.len() }>(
        &[FIRST, network::CHANGES, world::SHAPE, world::HIDDEN, LAST],
    );

const FIRST: &[Field] = fields! {
    /// The time at which it happens, once.
    at = TIME, Depends("required, or else `rate`");
    /// Its rate: it happens repeatedly at random times, drawn from the seed as a Poisson process.
    rate = Kind::Quantity(Dimension::Rate, Range::Positive), Word("never");
    /// With a `rate`: the rectangle in which things or waypoints appear, each at a random place.
    within = Kind::Table(CORNERS), Word("none");
    /// The kind of event; see the list below.
    kind = Kind::Choice(KINDS), Required;
    /// The robots concerned.
    robots = Kind::Robots, Depends("required for faults and `leave`; all for `tell`");
    /// The parts of the fleet; all other robots form one more part.
    groups = Kind::RobotGroups, Depends("required for `partition` and `one_way`");
    /// The name of the robot that is pushed.
    robot = Kind::Text, Depends("required for `push`");
    /// The distance and direction of the push.
    by = Kind::Point, Depends("required for `push`");
};

const LAST: &[Field] = fields! {
    /// The number of the obstacle, from 0: those of the scenario come first, then the four walls of `world.bounds` if
    /// there are bounds, then those that have appeared.
    index = Kind::Count(0, u32::MAX as u64), Depends("required for `move_obstacle` and `remove_obstacle`");
    /// The name of the waypoint, thing or robot. With a `rate`, the number of the occasion is appended: `task0`,
    /// `task1`, ...
    name = Kind::Text, Depends("required for waypoints, things and `join`");
    /// The place of the waypoint, thing or robot.
    position = Kind::Point, Depends("required with `name`, but not with `within` or to remove something");
    /// The heading of a robot that joins, from the x axis, left positive.
    heading = Kind::Quantity(Dimension::Angle, Range::Any), Value("0deg");
    /// A number by which a program can group waypoints.
    group = Kind::Count(0, u32::MAX as u64), Value("0");
    /// The name of the order.
    order = Kind::Text, Depends("required for `tell`");
    /// The fields of the order, under names that the program defines.
    fields = Kind::Parameters, Word("none");
    /// The name of a robot: the one that joins has the same model, sensors, program and parameters.
    like = Kind::Text, Depends("required for `join`");
};
