//! Robots that cannot move sideways: their greatest speed along their heading, and the point that makes them turn.
//!
//! A robot on wheels moves along its heading until it has turned, so its speed must be safe along its heading too. A
//! car also swings to a side while it brakes, and its tracker chooses between forwards and backwards. Avoidance asks it:
//! a car that has to be safe both ways cannot leave a place where it has room in one direction only.

use super::cell::Cell;
use super::pace::Pace;
use super::plane::{larger, smaller, turned};
use crate::Model;
use crate::tracking::{Goal, Tracking};
use smallvec::SmallVec;
use starl_core::motion::Estimate;
use starl_core::{Command, Point, math};

/// Where a robot does not go straight to its goal it is given a point so many seconds ahead: far
/// enough that it need not slow down for it, near enough that a robot on wheels steers towards it.
const LOOK_AHEAD: f64 = 1.5;

/// That point is at least this far away, metres, so that trackers do not take it for reached.
const LEAST_STEP: f64 = 0.2;

/// A robot on wheels is given a point this near behind it, metres, so that it backs up instead of
/// turning round.
const STEP_BACK: f64 = 0.12;

/// A car is given a point at a distance of so many turning radii. It would have to shunt to a nearer one, and would turn
/// round to go to a farther one that is behind it.
const CAR_STEP: f64 = 2.0;

/// Below this part of its cruise speed a car may still choose between forwards and backwards.
const CREEP: f64 = 0.05;

/// A heading that meets a border at an angle of no more than this sine goes along it: robots on wheels
/// are not steered more exactly. As soon as one has gone a millimetre or two too far, its cell turns it
/// away by as much.
const GRAZING: f64 = 0.045;

/// A robot as its tracker drives it.
#[derive(Clone, Copy)]
pub(crate) struct Driven<'a> {
    pub model: &'a dyn Model,
    /// The state of its tracker before this estimate.
    pub tracking: &'a Tracking,
}

impl Driven<'_> {
    /// Whether the tracker will drive a car forwards or backwards to this goal; none if it stops, or is no car's.
    fn gear(&self, estimate: &Estimate, goal: &Goal) -> Option<Gear> {
        // With any limit of speed the tracker chooses the same.
        let goal = Goal {
            speed_limit: f64::INFINITY,
            ..*goal
        };
        match self
            .model
            .track(&mut self.tracking.clone(), estimate, &goal)
        {
            Command::Steer { speed, .. } if speed > 0.0 => Some(Gear::Forwards),
            Command::Steer { speed, .. } if speed < 0.0 => Some(Gear::Backwards),
            _ => None,
        }
    }
}

/// The way that a car drives.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Gear {
    Forwards,
    Backwards,
}

/// How a robot gets about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Drive {
    /// Any way at once.
    AnyWay,
    /// Along its heading, and turning on the spot.
    OnTheSpot,
    /// Along its heading, and turning while driving.
    Car,
}

impl Drive {
    /// How robots of this model get about: any way if they fly or take a velocity as a command.
    pub fn of(model: &dyn Model) -> Drive {
        let velocity = Command::Velocity {
            velocity: Point::ZERO,
            yaw_rate: 0.0,
        };
        if model.body().flies() || model.accepts(&velocity) {
            Drive::AnyWay
        } else if model.limits().turn_radius > 0.0 {
            Drive::Car
        } else {
            Drive::OnTheSpot
        }
    }

    /// The greatest speed, metres per second, with which the robot stays in its cell if its desired velocity is
    /// `velocity` and its tracker is given `goal`.
    pub fn speed_limit(
        self,
        driven: &Driven,
        pace: &Pace,
        estimate: &Estimate,
        cell: &Cell,
        velocity: Point,
        goal: &Goal,
    ) -> f64 {
        let ahead = velocity.normalized().unwrap_or(Point::ZERO);
        match self {
            // Where the robot is too near on two sides, the velocity is the best that can be had.
            Drive::AnyWay => larger(cell.speed(ahead, 0.0), velocity.planar_length()),
            Drive::OnTheSpot => {
                let heading = heading(estimate);
                let course = if heading.dot(ahead) < 0.0 {
                    -heading
                } else {
                    heading
                };
                let between = (course + ahead).normalized().unwrap_or(course);
                slowest(cell, &[ahead, course, between], GRAZING)
            }
            Drive::Car => {
                let directions = car_directions(driven, pace, estimate, goal);
                slowest(cell, &directions, 0.0)
            }
        }
    }

    /// How far ahead to put the point to track, metres.
    pub fn step(self, pace: &Pace, estimate: &Estimate, ahead: Point, speed: f64) -> f64 {
        let step = larger(speed * LOOK_AHEAD, LEAST_STEP);
        match self {
            Drive::AnyWay => step,
            Drive::OnTheSpot if heading(estimate).dot(ahead) < -0.5 => STEP_BACK,
            Drive::OnTheSpot => step,
            Drive::Car => CAR_STEP * pace.turn_radius,
        }
    }
}

fn slowest(cell: &Cell, directions: &[Point], grazing: f64) -> f64 {
    let speeds = directions
        .iter()
        .map(|&direction| cell.speed(direction, grazing));
    speeds.fold(f64::INFINITY, smaller)
}

/// Where a car may go before the next estimate. It continues along its course whatever its command is, or swings off it
/// to either side while it brakes. From a standstill it goes forwards or backwards as its tracker chooses, and its centre,
/// which is ahead of the axle that does not steer, slips to the side that it steers to.
fn car_directions(
    driven: &Driven,
    pace: &Pace,
    estimate: &Estimate,
    goal: &Goal,
) -> SmallVec<[Point; 4]> {
    let velocity = estimate.twist.linear.at_height(0.0);
    let speed = velocity.planar_length();
    let both_sides = |course: Point, angle: f64| [turned(course, angle), turned(course, -angle)];
    match velocity.normalized() {
        Some(course) if speed > CREEP * pace.cruise_speed => {
            // The chord of its braking way on the smallest circle.
            let swing = 0.5 * speed * pace.braking_time / pace.turn_radius;
            return SmallVec::from_slice(&both_sides(course, swing));
        }
        _ => {}
    }
    let heading = heading(estimate);
    // That axle is inside the body.
    let slip = math::asin(smaller(driven.model.body().radius / pace.turn_radius, 1.0));
    let gear = driven.gear(estimate, goal);
    let mut directions = SmallVec::new();
    if gear != Some(Gear::Backwards) {
        directions.extend(both_sides(heading, slip));
    }
    if gear != Some(Gear::Forwards) {
        directions.extend(both_sides(-heading, slip));
    }
    directions
}

/// Where the robot faces.
pub(super) fn heading(estimate: &Estimate) -> Point {
    let (sine, cosine) = math::sincos(estimate.pose.yaw);
    Point::planar(cosine, sine)
}
