//! Tracking for a quadcopter: take off, then fly by tilting, in cascaded loops.
//!
//! Position to velocity is proportional and limited to the cruise speed; velocity to acceleration is
//! proportional; acceleration to tilt is geometry. A disturbance observer (Luenberger 1971, "An
//! introduction to observers") estimates other forces on the drone than its own tilt and drag in still
//! air, such as wind, and compensates them. Unlike the integral of a PID loop it does not wind up
//! while the drone accelerates and brakes, which would make it overshoot. The drone's own speed loop
//! controls the vertical motion. The thesis names such a controller (section 4.3) but gives none.

use super::{Goal, Tracking};
use starl_core::math::{self, atan, exp, sincos, tan};
use starl_core::motion::Estimate;
use starl_core::{Command, Point, Pose};

/// The drone's constants for its tracker.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gains {
    /// Lowest height of travel, metres.
    pub lowest: f64,
    /// Metres per second in the floor plane.
    pub cruise_speed: f64,
    /// Metres per second.
    pub climb_speed: f64,
    /// Drag per mass, 1/s.
    pub drag: f64,
    /// Greatest tilt, radians.
    pub tilt: f64,
    /// Seconds for which an acceleration continues after the opposite tilt is commanded.
    pub tilt_lag: f64,
    /// Metres per second squared.
    pub gravity: f64,
}

/// [`Tracking::phase`] when the drone has been high enough to travel.
const FLYING: u32 = 1;

/// Desired speed per distance left, 1/s.
const POSITION_GAIN: f64 = 1.2;
/// Acceleration per error of velocity, 1/s.
const VELOCITY_GAIN: f64 = 2.8;
/// Both poles of the observer, 1/s, where estimates are seldom. A quicker one strays less in gusts, but gaps between estimates
/// make it overshoot.
const SLOWEST_OBSERVER: f64 = 2.5;
/// The same where they are frequent; noise moves a drone by a tenth more then.
const QUICKEST_OBSERVER: f64 = 8.0;
/// The time between estimates up to which they are frequent, seconds; at twice that they are seldom.
const FREQUENT: f64 = 0.05;
/// The push is taken to be at most this many times what the drone can hold against.
const MOST_PUSH: f64 = 1.5;
/// Seconds for which the push has to exceed what the drone can hold against until it counts as overpowered:
/// longer than a contact with another body lasts.
const OVERPOWERED_AFTER: f64 = 2.0;
/// Climb per height left, 1/s.
const HEIGHT_GAIN: f64 = 1.2;

impl Gains {
    /// See [`crate::Limits::stopping_distance`]. At low speeds the loops are linear and the
    /// distance proportional to the speed; at high speeds the drone brakes with its greatest tilt
    /// and with drag, after the time that takes to build up.
    pub fn stopping_distance(&self) -> f64 {
        let speed = self.cruise_speed;
        let brake = self.tilt * self.gravity + 0.5 * self.drag * speed;
        (0.52 * speed).max(0.35 * speed + speed * speed / (2.0 * brake))
    }

    /// See [`crate::Model::braking_way`]. It includes the velocity that the present tilt still
    /// adds.
    pub fn braking_way(&self, estimate: &Estimate) -> Point {
        let velocity = estimate.twist.linear.at_height(0.0);
        let gain = self.own_acceleration(estimate) * self.tilt_lag;
        (velocity + gain) * (self.stopping_distance() / self.cruise_speed)
    }

    /// The acceleration at the greatest tilt, metres per second squared.
    fn strength(&self) -> f64 {
        tan(self.tilt) * self.gravity
    }

    /// Whether the drone has long been pushed harder than it can tilt against.
    pub fn is_overpowered(tracking: &Tracking) -> bool {
        tracking.overpowered >= OVERPOWERED_AFTER
    }

    /// By tilt and by drag in still air.
    fn own_acceleration(&self, estimate: &Estimate) -> Point {
        let Pose {
            yaw, pitch, roll, ..
        } = estimate.pose;
        let (sin, cos) = sincos(yaw);
        let (ahead, aside) = (
            tan(pitch) * self.gravity,
            tan(roll) / math::cos(pitch) * self.gravity,
        );
        let tilting = Point::planar(cos * ahead + sin * aside, sin * ahead - cos * aside);
        tilting - estimate.twist.linear.at_height(0.0) * self.drag
    }

    /// One step of tracking.
    pub fn track(&self, tracking: &mut Tracking, estimate: &Estimate, goal: &Goal) -> Command {
        let period = tracking.period(estimate);
        let Pose { position, yaw, .. } = estimate.pose;
        let part = if tracking.phase == FLYING { 0.5 } else { 0.9 };
        if position.z < part * self.lowest {
            *tracking = Tracking {
                previous: tracking.previous,
                ..Tracking::default()
            };
            // A waypoint that low tells it to stay down.
            let stay = goal.target.z < self.lowest;
            return if stay {
                Command::Stop
            } else {
                Command::TakeOff
            };
        }
        tracking.phase = FLYING;

        self.observe(tracking, estimate, period);
        let desired = self.desired_velocity(position, goal);
        let error = (desired - estimate.twist.linear).at_height(0.0);
        let acceleration = error * VELOCITY_GAIN + desired * self.drag - tracking.push;
        let (sin, cos) = sincos(yaw);
        let tilt = shortened(acceleration, self.strength()) / self.gravity;
        let (ahead, aside) = (cos * tilt.x + sin * tilt.y, sin * tilt.x - cos * tilt.y);
        let pitch = atan(ahead);
        let level = math::cos(pitch);
        let height = goal.target.z.max(self.lowest) - position.z;
        Command::Attitude {
            yaw_rate: 0.0,
            pitch,
            roll: atan(aside * level),
            gaz: (HEIGHT_GAIN * height).clamp(-self.climb_speed, self.climb_speed),
        }
    }

    /// The drone hovers by itself. The push of the wind is observed nevertheless, because wind that drives the drone
    /// off its path makes it stop and replan repeatedly.
    pub fn rest(&self, tracking: &mut Tracking, estimate: &Estimate) {
        let period = tracking.period(estimate);
        match estimate.pose.position.z < 0.5 * self.lowest {
            true => tracking.interrupt(),
            false => self.observe(tracking, estimate, period),
        }
    }

    /// Corrects the push, and the velocity expected of the drone, by the velocity that it has come to.
    fn observe(&self, tracking: &mut Tracking, estimate: &Estimate, period: f64) {
        let velocity = estimate.twist.linear.at_height(0.0);
        let expected = tracking.expected_velocity.unwrap_or(velocity);
        let often = FREQUENT / period;
        let rate = (QUICKEST_OBSERVER * often * often).clamp(SLOWEST_OBSERVER, QUICKEST_OBSERVER);
        let keep = exp(-rate * period);
        let surprise = velocity - expected;
        let push = tracking.push + surprise * ((1.0 - keep) * (1.0 - keep) / period);
        tracking.push = shortened(push, MOST_PUSH * self.strength());
        let holds = tracking.push.planar_length() <= self.strength();
        tracking.overpowered = match holds {
            true => 0.0,
            false => tracking.overpowered + period,
        };
        let acceleration = self.own_acceleration(estimate) + tracking.push;
        let corrected = expected + surprise * (1.0 - keep * keep);
        tracking.expected_velocity = Some(corrected + acceleration * period);
    }

    fn desired_velocity(&self, position: Point, goal: &Goal) -> Point {
        let way = (goal.target - position).at_height(0.0);
        let distance = way.planar_length();
        if distance <= 0.0 {
            return Point::ZERO;
        }
        let speed = (POSITION_GAIN * distance)
            .max(goal.through_speed(position, self.cruise_speed))
            .min(self.cruise_speed)
            .min(goal.speed_limit);
        way * (speed / distance)
    }
}

/// A planar vector, scaled down to `limit` if it is longer.
fn shortened(vector: Point, limit: f64) -> Point {
    let length = vector.planar_length();
    if length <= limit {
        vector
    } else {
        vector * (limit / length)
    }
}
