//! Tracking for robots on two wheels: turn towards the waypoint on the spot, then drive to it.
//!
//! The rules of the original's MotionAutomation (fast far away, slowly near; turn fast, then slowly),
//! with two differences. It drives arcs through the waypoint instead of straight lines that it has to
//! correct on the spot (pure pursuit, Coulter 1992, with the waypoint as the point pursued). And
//! speeds fall with the distance left, and rates of turn with the angle left, so that no estimate
//! comes too late, however far apart they are.

use super::arrival::{Tolerance, at_rest};
use super::{Goal, Tracking};
use starl_core::Pose;
use starl_core::math::{PI, cos, fabs, radians, sin, wrap_angle};
use starl_core::motion::Estimate;

/// Speeds and rates that a robot on two wheels tracks with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gains {
    /// Metres per second.
    pub cruise_speed: f64,
    /// Metres per second, near the waypoint.
    pub slow_speed: f64,
    /// The distance at which it slows down, metres.
    pub slow_distance: f64,
    /// Radians per second.
    pub cruise_turn: f64,
    /// Radians per second, when the angle left is small.
    pub slow_turn: f64,
}

/// The command until the next estimate; speeds in m/s, rates in rad/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Drive {
    Stop,
    Straight { speed: f64 },
    Turn { rate: f64 },
    Arc { speed: f64, rate: f64 },
}

const TOLERANCE: Tolerance = Tolerance {
    stop: 0.03,
    start: 0.05,
};

/// [`Tracking::phase`] while turning on the spot.
const TURNING: u32 = 1;

/// Part of a distance or angle left that is covered before the next estimate, at most.
const PART_PER_ESTIMATE: f64 = 0.5;
/// Part of the distance left that is driven per second, at most.
const PART_PER_SECOND: f64 = 2.5;
/// Below this part of the slow speed the robot crawls: it may hardly move.
const CRAWL: f64 = 0.25;
/// How far ahead on the straight way the point pursued lies, at most, metres: an arc leaves the straight
/// way by up to a quarter of this times the bearing, and paths have little room beside obstacles.
const LOOK_AHEAD: f64 = 0.3;
/// Within this distance the robot backs up to a point behind it instead of turning round, metres.
const BACK_UP: f64 = 0.15;

impl Gains {
    /// See [`crate::Limits::stopping_distance`]: the way until the estimate that says stop.
    pub fn stopping_distance(&self) -> f64 {
        0.1 * self.cruise_speed + TOLERANCE.stop
    }

    /// One step of tracking.
    pub fn track(&self, tracking: &mut Tracking, estimate: &Estimate, goal: &Goal) -> Drive {
        let period = tracking.period(estimate);
        let Pose { position, yaw, .. } = estimate.pose;
        if goal.next.is_some() {
            tracking.rest = None;
        } else if at_rest(tracking, goal, position, TOLERANCE) {
            tracking.phase = 0;
            return Drive::Stop;
        }
        let way = goal.target - position;
        let distance = way.planar_length();
        let ahead = wrap_angle(way.heading() - yaw);
        let backwards = distance < BACK_UP && fabs(ahead) > radians(120.0);
        let bearing = if backwards {
            wrap_angle(ahead + PI)
        } else {
            ahead
        };

        let crawls = goal.speed_limit < CRAWL * self.slow_speed;
        let last = goal.next.is_none();
        if self.turns(tracking, bearing, distance, last, crawls) {
            return Drive::Turn {
                rate: self.turn_rate(bearing, period),
            };
        }
        let through = goal.through_speed(position, self.cruise_speed);
        let near = distance < self.slow_distance && through < self.slow_speed;
        let cruise = if near {
            self.slow_speed
        } else {
            self.cruise_speed
        };
        let gain = PART_PER_SECOND.min(PART_PER_ESTIMATE / period);
        let speed = (gain * distance * cos(bearing))
            .max(through)
            .min(cruise)
            .min(goal.speed_limit);
        if speed <= 0.0 {
            return Drive::Stop;
        }
        let signed = if backwards { -speed } else { speed };
        if fabs(bearing) < radians(1.0) {
            return Drive::Straight { speed: signed };
        }
        // The circle that touches the heading and passes through the waypoint, or through the point on
        // the straight way to it that is pursued.
        let pursuit = 2.0 * sin(bearing) / distance.min(LOOK_AHEAD) * speed;
        let most = fabs(self.turn_rate(bearing, period));
        Drive::Arc {
            speed: signed,
            rate: pursuit.clamp(-most, most),
        }
    }

    /// Whether to turn on the spot, with hysteresis.
    fn turns(
        &self,
        tracking: &mut Tracking,
        bearing: f64,
        distance: f64,
        last: bool,
        crawls: bool,
    ) -> bool {
        let limit = if crawls {
            // No arc that slow would ever get it round.
            radians(2.0)
        } else if tracking.phase == TURNING {
            radians(8.0)
        } else if last && distance < BACK_UP {
            // So near, an arc ends within tolerance although the angle is large.
            radians(55.0)
        } else {
            radians(30.0)
        };
        let turns = fabs(bearing) > limit;
        tracking.phase = if turns { TURNING } else { 0 };
        turns
    }

    fn turn_rate(&self, bearing: f64, period: f64) -> f64 {
        let cruise = if fabs(bearing) > radians(20.0) {
            self.cruise_turn
        } else {
            self.slow_turn
        };
        // The angle left may be covered to most of it: turning has no inertia.
        let most = cruise.min(1.5 * PART_PER_ESTIMATE / period * fabs(bearing));
        if bearing < 0.0 { -most } else { most }
    }
}
