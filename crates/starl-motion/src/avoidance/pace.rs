//! How a robot stops, and how far ahead it has to think.

use super::plane::smaller;
use crate::Limits;
use starl_core::Point;
use starl_core::motion::Estimate;

/// Estimates that a robot waits for until it may have used up its room: it closes in on a border by
/// this fraction of the room a period, or less. Anything above Euler's number keeps two robots that
/// see each other a period late from overshooting (a delay of T is not oscillatory below 1 / (e T)).
const PERIODS_AHEAD: f64 = 3.0;

/// The same for the time that a robot with inertia takes to follow a change of its wished velocity, as
/// a part of its braking time. Measured with the AR.Drone: below 0.3 it overshoots.
const PART_OF_BRAKING: f64 = 0.45;

/// The times and distances that follow from a robot's limits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    /// Metres; 0 for a robot that turns on the spot.
    pub turn_radius: f64,
    /// Metres per second.
    pub cruise_speed: f64,
    /// See [`Limits::braking_time`], seconds.
    pub braking_time: f64,
    /// Seconds in which it may use up the room left beyond its stopping point, or more.
    pub horizon: f64,
    /// Metres that it needs to stop from its cruise speed, until it has noticed included.
    pub room_needed: f64,
}

impl Pace {
    /// Of a robot with these limits that is located every `period` seconds.
    pub fn new(limits: &Limits, period: f64) -> Pace {
        let cruise_speed = limits.cruise_speed;
        let braking_time = limits.braking_time();
        let horizon = PERIODS_AHEAD * period + PART_OF_BRAKING * braking_time;
        Pace {
            turn_radius: limits.turn_radius,
            cruise_speed,
            braking_time,
            horizon,
            room_needed: cruise_speed * (braking_time + horizon),
        }
    }

    /// The velocity that the robot would like to have `way` before its destination.
    pub fn wish(&self, way: Point, speed_limit: f64) -> Point {
        let distance = way.planar_length();
        if distance <= 0.0 {
            return Point::ZERO;
        }
        let slowing = distance / (self.braking_time + self.horizon);
        way * (smaller(smaller(self.cruise_speed, speed_limit), slowing) / distance)
    }

    /// Whether the robot drives or turns, rather than standing still.
    pub fn moves(&self, estimate: &Estimate) -> bool {
        let twist = &estimate.twist;
        twist.linear.planar_length() > 0.2 * self.cruise_speed || twist.yaw.abs() > 0.2
    }
}
