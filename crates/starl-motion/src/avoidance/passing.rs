//! Passing a neighbour that is in the way.
//!
//! The velocity nearest to the desired one slides along the borders of the cell, but late, and barely if a neighbour is
//! straight ahead. So a robot on a collision course with a neighbour heads for the tangent to it, on the right, or on
//! the left if that is much shorter or the right is blocked. Two robots that meet head-on both keep to the right, so
//! they pass; it is a rule of the road, not needed for safety. A neighbour at the robot's destination cannot be passed:
//! the robot waits, and finally yields.

use super::cell::Cell;
use super::plane::{smaller, turned};
use crate::Neighbour;
use starl_core::motion::Body;
use starl_core::{Point, math};

/// A robot begins to pass this long before it would be next to the neighbour, seconds.
pub(super) const AHEAD: f64 = 2.0;
/// The left is taken if the neighbour's centre is to the right of the way by this part of the room
/// needed.
const LEFT: f64 = 0.4;
/// A neighbour that goes the same way is followed unless it is slower by this part of the speed.
const CLOSING: f64 = 0.3;
/// Passing on a side is worth while if it leaves this part of the speed.
const WORTH: f64 = 0.4;

/// A neighbour that is in the way.
pub(super) struct InTheWay {
    /// Its place relative to the robot, metres.
    offset: Point,
    /// Distance between the centres to pass it at, metres.
    room: f64,
}

/// The velocity for passing, in place of `velocity`, the one nearest to the desired velocity.
pub(super) fn velocity(cell: &Cell, neighbour: &InTheWay, wish: Point, velocity: Point) -> Point {
    let InTheWay { offset, room } = *neighbour;
    let (speed, distance) = (wish.planar_length(), offset.planar_length());
    let angle = math::asin(smaller(room / distance, 1.0));
    let towards = offset * (speed / distance);
    let to_the_right = wish.cross_planar(offset) < -LEFT * room * speed;
    let sides = if to_the_right {
        [angle, -angle]
    } else {
        [-angle, angle]
    };
    for side in sides {
        let way = turned(towards, side);
        let passing = cell.velocity(way);
        if passing.dot(way) >= WORTH * speed * speed {
            return passing;
        }
    }
    velocity
}

/// The first neighbour on the straight way to the destination, if bodies keep `gap` metres apart.
pub(super) fn in_the_way(
    body: &Body,
    gap: f64,
    way: Point,
    wish: Point,
    position: Point,
    neighbours: &[Neighbour],
) -> Option<InTheWay> {
    let speed = wish.planar_length();
    if speed <= 0.0 {
        return None;
    }
    let mut soonest = speed * AHEAD;
    let mut found = None;
    for neighbour in neighbours {
        let offset = (neighbour.position - position).at_height(0.0);
        let room = body.radius + neighbour.radius + gap;
        let until = offset.planar_length() - room;
        if until >= soonest {
            continue;
        }
        let along = wish.dot(offset) / speed;
        let beside = wish.cross_planar(offset).abs() / speed;
        let closing = speed - neighbour.velocity.dot(wish) / speed;
        let ahead = along > 0.0 && along < way.planar_length() && beside < room;
        let stands_there = offset.planar_distance(way) < room;
        if ahead && closing > CLOSING * speed && !stands_there {
            (soonest, found) = (until, Some(InTheWay { offset, room }));
        }
    }
    found
}
