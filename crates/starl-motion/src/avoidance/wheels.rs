//! Robots that cannot move sideways: how fast they may go where they are heading, and what point makes
//! them turn.
//!
//! A robot on wheels goes along its heading until it has turned, whatever direction is best, so its
//! speed must be safe along its heading too. Nothing in [`crate::Limits`] says whether a robot can
//! move sideways, so it is watched.

use super::cell::Cell;
use super::pace::Pace;
use super::plane::{larger, smaller};
use starl_core::motion::{Body, Estimate};
use starl_core::{Point, math};

/// Where a robot does not go straight to its goal it is given a point so many seconds ahead: far
/// enough that it need not slow down for it, near enough that a robot on wheels steers towards it.
const LOOK_AHEAD: f64 = 1.5;

/// That point is at least this far away, metres, so that trackers do not take it for reached.
const LEAST_STEP: f64 = 0.2;

/// A robot on wheels is given a point this near behind it, metres, so that it backs up instead of
/// turning round.
const STEP_BACK: f64 = 0.12;

/// A robot that may be on wheels and heads for a border crawls at this part of its cruise speed, to
/// find out whether it is.
const CRAWL: f64 = 0.02;

/// Below this part of its cruise speed a car may still choose between forwards and backwards.
const CREEP: f64 = 0.05;

/// A robot that has turned through this angle without moving sideways is on wheels, radians.
const TURNED: f64 = 0.3;

/// Slower motion says nothing of how a robot moves, metres per second.
const SIDLING_SPEED: f64 = 0.02;

/// What has been seen of how a robot moves.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Wheels {
    /// It has moved sideways, so its heading says nothing of where it goes.
    sidles: bool,
    /// Angle it has turned through in all, radians.
    turned: f64,
}

impl Wheels {
    /// Takes note of the motion during `elapsed` seconds.
    pub fn watch(&mut self, estimate: &Estimate, elapsed: f64) {
        let velocity = estimate.twist.linear.at_height(0.0);
        let speed = velocity.planar_length();
        let across = velocity.cross_planar(heading(estimate)).abs();
        self.turned += estimate.twist.yaw.abs() * elapsed;
        self.sidles |= speed > SIDLING_SPEED && across > 0.7 * speed;
    }

    /// The greatest speed, metres per second, with which the robot stays in its cell when it is to go
    /// `ahead`, a direction of length one.
    pub fn speed_limit(
        &self,
        body: &Body,
        pace: &Pace,
        estimate: &Estimate,
        cell: &Cell,
        ahead: Point,
    ) -> f64 {
        let speed = cell.speed(ahead);
        if body.flies() || self.sidles {
            return speed;
        }
        let heading = heading(estimate);
        if pace.turn_radius > 0.0 {
            return car_speed_limit(pace, estimate, cell, heading);
        }
        let backwards = heading.dot(ahead) < 0.0;
        let course = if backwards { -heading } else { heading };
        let between = (course + ahead).normalized().unwrap_or(course);
        let speed = smaller(speed, smaller(cell.speed(course), cell.speed(between)));
        if self.turned > TURNED {
            speed
        } else {
            larger(speed, CRAWL * pace.cruise_speed)
        }
    }

    /// How far ahead to put the point to track, metres.
    pub fn step(&self, body: &Body, estimate: &Estimate, ahead: Point, speed: f64) -> f64 {
        let behind = heading(estimate).dot(ahead) < -0.5;
        if behind && !body.flies() && !self.sidles {
            STEP_BACK
        } else {
            larger(speed * LOOK_AHEAD, LEAST_STEP)
        }
    }
}

/// A car goes on along its course whatever it is told, and starts forwards or backwards as its tracker
/// sees fit.
fn car_speed_limit(pace: &Pace, estimate: &Estimate, cell: &Cell, heading: Point) -> f64 {
    let velocity = estimate.twist.linear.at_height(0.0);
    match velocity.normalized() {
        Some(course) if velocity.planar_length() > CREEP * pace.cruise_speed => cell.speed(course),
        _ => smaller(cell.speed(heading), cell.speed(-heading)),
    }
}

fn heading(estimate: &Estimate) -> Point {
    let (sine, cosine) = math::sincos(estimate.pose.yaw);
    Point::planar(cosine, sine)
}
