//! Tracking for a quadcopter: take off, then fly by tilting, in cascaded loops.
//!
//! Position to velocity is proportional and limited to the cruise speed; velocity to acceleration is
//! proportional; acceleration to tilt is geometry. A disturbance observer (Luenberger 1971, "An
//! introduction to observers") estimates other forces on the drone than its own tilt and drag in still
//! air, such as wind, and compensates them. Unlike the integral of a PID loop it does not wind up
//! while the drone accelerates and brakes, which would make it overshoot. Tilting takes time, so what
//! acts is extrapolated: the velocity by the present acceleration, and the other forces by their rate
//! of change. The drone's own speed loop controls the vertical motion. The thesis names such a
//! controller (section 4.3) but gives none.

use super::{Goal, Moment, Tracking};
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
/// The velocity is extrapolated by this time, seconds, because the present tilt continues to act until the drone has
/// the next one.
const TILTING_TIME: f64 = 0.1;
/// Both poles of the observer, 1/s, where estimates are seldom. A quicker one strays less in gusts, but gaps between estimates
/// make it overshoot.
const SLOWEST_OBSERVER: f64 = 2.5;
/// The same where they are frequent. A quicker one strays less still, until noise of the velocity moves the drone.
const QUICKEST_OBSERVER: f64 = 12.0;
/// The time between estimates up to which they are frequent, seconds; at 1.7 times that they are seldom.
const FREQUENT: f64 = 0.05;
/// Where estimates are frequent, the push is extrapolated by this time, seconds, at the rate at which it changes: so long
/// the drone takes to notice it and to tilt.
const LEAD: f64 = 0.3;
/// The push is taken to be at most this many times what the drone can hold against.
const MOST_PUSH: f64 = 1.5;
/// Seconds for which the push has to exceed what the drone can hold against until it counts as overpowered:
/// longer than a contact with another body lasts.
const OVERPOWERED_AFTER: f64 = 2.0;
/// Climb per height left, 1/s.
const HEIGHT_GAIN: f64 = 1.2;
/// Up to this speed, metres per second, a drone that should be at rest is left to hover by itself.
const HOVERING_SPEED: f64 = 0.2;
/// Seconds after which a drone is left to hover even if it is faster, as an autopilot may be that moves in another way
/// than its model.
const LONGEST_BRAKING: f64 = 3.0;

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

    /// By tilt and by drag in still air, at a steady height.
    fn own_acceleration(&self, estimate: &Estimate) -> Point {
        self.tilting(estimate) - estimate.twist.linear.at_height(0.0) * self.drag
    }

    /// The part of the acceleration that the tilt causes, at a steady height.
    fn tilting(&self, estimate: &Estimate) -> Point {
        let Pose {
            yaw, pitch, roll, ..
        } = estimate.pose;
        let (sin, cos) = sincos(yaw);
        let (ahead, aside) = (
            tan(pitch) * self.gravity,
            tan(roll) / math::cos(pitch) * self.gravity,
        );
        Point::planar(cos * ahead + sin * aside, sin * ahead - cos * aside)
    }

    /// One step of tracking.
    pub fn track(&self, tracking: &mut Tracking, estimate: &Estimate, goal: &Goal) -> Command {
        tracking.brakes_from = None;
        self.drive(tracking, estimate, goal)
    }

    fn drive(&self, tracking: &mut Tracking, estimate: &Estimate, goal: &Goal) -> Command {
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

        let push = self.observe(tracking, estimate, period);
        let (desired, change) = self.desired_velocity(estimate, goal);
        let gained = (self.own_acceleration(estimate) + tracking.push) * TILTING_TIME;
        let error = (desired - estimate.twist.linear - gained).at_height(0.0);
        let acceleration = error * VELOCITY_GAIN + change + desired * self.drag - push;
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

    /// A slow drone hovers by itself. A fast one is braked first: by itself it would glide farther than its braking way,
    /// in which avoidance expects it to stop. The push of the wind is observed even while it hovers, because wind that
    /// drives the drone off its path makes it stop and replan repeatedly.
    pub fn rest(&self, tracking: &mut Tracking, estimate: &Estimate) -> Command {
        let position = estimate.pose.position;
        let is_high = position.z >= 0.5 * self.lowest;
        if is_high && estimate.twist.linear.planar_length() > HOVERING_SPEED {
            let (start, since) = *tracking.brakes_from.get_or_insert((position, estimate.at));
            if estimate.at.since(since).seconds() <= LONGEST_BRAKING {
                let goal = Goal::stop_at(start.at_height(position.z));
                return self.drive(tracking, estimate, &goal);
            }
        } else {
            tracking.brakes_from = None;
        }
        let period = tracking.period(estimate);
        match is_high {
            true => drop(self.observe(tracking, estimate, period)),
            false => tracking.interrupt(),
        }
        Command::Stop
    }

    /// Corrects the push, and the velocity expected of the drone, by the velocity that it has come to. Returns the push
    /// to compensate: the one that is expected when the drone has tilted.
    fn observe(&self, tracking: &mut Tracking, estimate: &Estimate, period: f64) -> Point {
        let velocity = estimate.twist.linear;
        let tilting = self.tilting(estimate);
        let expected = match tracking.last {
            Some(last) => {
                // A drone that climbs faster and faster has more thrust.
                let climb = (velocity.z - last.velocity.z) / period;
                let thrust = 1.0 + climb / self.gravity;
                let own = (last.tilting + tilting) * (0.5 * thrust)
                    - (last.velocity + velocity) * (0.5 * self.drag);
                (last.velocity + (own + tracking.push) * period).at_height(velocity.z)
            }
            None => velocity,
        };
        let often = (FREQUENT / period).min(1.0);
        let rate = (QUICKEST_OBSERVER * often * often * often).max(SLOWEST_OBSERVER);
        let keep = exp(-rate * period);
        let surprise = velocity - expected;
        let change = surprise * ((1.0 - keep) * (1.0 - keep) / period);
        tracking.push = shortened(tracking.push + change, MOST_PUSH * self.strength());
        let holds = tracking.push.planar_length() <= self.strength();
        tracking.overpowered = match holds {
            true => 0.0,
            false => tracking.overpowered + period,
        };
        tracking.last = Some(Moment {
            velocity: expected + surprise * (1.0 - keep * keep),
            tilting,
        });
        tracking.push + change * (LEAD * often / period)
    }

    /// In the floor plane, and the rate at which it changes while the drone brakes for the target.
    fn desired_velocity(&self, estimate: &Estimate, goal: &Goal) -> (Point, Point) {
        let position = estimate.pose.position;
        let way = (goal.target - position).at_height(0.0);
        let distance = way.planar_length();
        if distance <= 0.0 {
            return (Point::ZERO, Point::ZERO);
        }
        let braking = POSITION_GAIN * distance;
        let speed = braking
            .max(goal.through_speed(position, self.cruise_speed))
            .min(self.cruise_speed)
            .min(goal.speed_limit);
        let change = if speed == braking {
            estimate.twist.linear.at_height(0.0) * -POSITION_GAIN
        } else {
            Point::ZERO
        };
        (way * (speed / distance), change)
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
