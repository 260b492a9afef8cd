//! Tracking for a car: pursue the waypoint along arcs, forwards or backwards, and shunt where it lies
//! inside the turning circle.
//!
//! Pure pursuit (Coulter 1992) seen from the rear axle, which moves along the heading: the circle that
//! touches the heading there and passes through a point at distance d, y to the left, has curvature
//! 2 y / d^2. The point pursued is the waypoint or, when that is far, the point a look-ahead on the
//! straight line to it. The body's centre is half a wheelbase ahead of the rear axle, so d stays away
//! from zero when the centre arrives.
//!
//! A point that no arc reaches lies inside one of the two smallest turning circles. The car then
//! shunts: it drives away from the point, steering to the other side, which turns it towards the point
//! and moves the circle off it (the simplest of the manoeuvres of Reeds and Shepp 1990; ours are not
//! shortest).

use super::arrival::{Tolerance, at_rest};
use super::{Goal, Tracking};
use starl_core::math::{atan, fabs, hypot, sincos, sqrt, tan};
use starl_core::motion::Estimate;
use starl_core::{Command, Point};

/// The car's constants for its tracker.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gains {
    /// Metres.
    pub wheelbase: f64,
    /// Greatest angle of the front wheels, radians.
    pub steering_angle: f64,
    /// Metres per second.
    pub cruise_speed: f64,
    /// Metres per second squared.
    pub acceleration: f64,
}

/// [`Tracking::phase`]: not decided yet.
const UNDECIDED: u32 = 0;
/// Towards the point, forwards.
const FORWARDS: u32 = 1;
/// Towards the point, backwards.
const BACKWARDS: u32 = 2;
/// Backwards, away from the point, to reach it forwards afterwards.
const SHUNT_BACK: u32 = 3;
/// Forwards, away from the point, to reach it backwards afterwards.
const SHUNT_AHEAD: u32 = 4;

const TOLERANCE: Tolerance = Tolerance {
    stop: 0.035,
    start: 0.06,
};

/// Points behind the car are approached backwards when they are nearer than so many turning radii.
const BACKWARDS_WITHIN: f64 = 3.0;
/// An approach continues while the point is not deeper inside the turning circle than this, metres.
const GIVE_UP_DEPTH: f64 = 0.05;
/// A shunt ends when the point is this part of the turning radius outside of the circle.
const SHUNT_MARGIN: f64 = 0.12;
/// The look-ahead in turning radii.
const LOOK_AHEAD: f64 = 1.2;
/// Part of the braking power that an approach reckons with.
const BRAKING: f64 = 0.5;
/// Part of the distance left that is driven before the next estimate, at most.
const PART_PER_ESTIMATE: f64 = 0.4;
/// Part of the distance left that is driven per second, at most.
const PART_PER_SECOND: f64 = 2.0;

/// Where the waypoint is.
struct Sight {
    /// From the rear axle, metres ahead and to the left.
    ahead: f64,
    left: f64,
    /// From the centre, metres ahead.
    centre_ahead: f64,
    /// From the centre, metres.
    distance: f64,
}

impl Gains {
    /// See [`crate::Limits::stopping_distance`]: the way until the estimate that says stop, and the
    /// braking distance.
    pub fn stopping_distance(&self) -> f64 {
        let speed = self.cruise_speed;
        0.1 * speed + speed * speed / (2.0 * self.acceleration) + TOLERANCE.start
    }

    /// One step of tracking.
    pub fn track(&self, tracking: &mut Tracking, estimate: &Estimate, goal: &Goal) -> Command {
        let period = tracking.period(estimate);
        let position = estimate.pose.position;
        let sight = self.sight(estimate, goal.target);
        // Once past the point the car will not come nearer to it without shunting.
        let passed = match tracking.phase {
            FORWARDS => sight.centre_ahead < 0.0,
            BACKWARDS => sight.centre_ahead > 0.0,
            _ => false,
        };
        let stop = if passed {
            TOLERANCE.start
        } else {
            TOLERANCE.stop
        };
        if goal.next.is_some() {
            tracking.rest = None;
        } else if at_rest(tracking, goal, position, Tolerance { stop, ..TOLERANCE }) {
            tracking.phase = UNDECIDED;
            return Command::Stop;
        }
        tracking.phase = self.phase(tracking.phase, &sight);
        let through = goal.through_speed(position, self.cruise_speed);
        let limit = self.cruise_speed.min(goal.speed_limit);
        let approach = self
            .approach_speed(sight.distance, period)
            .max(through)
            .min(limit);
        // A shunt is short; half the speed keeps it from overshooting.
        let shunt = (0.5 * self.cruise_speed).min(limit);
        let away = if sight.left > 0.0 {
            -self.steering_angle
        } else {
            self.steering_angle
        };
        match tracking.phase {
            FORWARDS => Command::Steer {
                speed: approach,
                angle: self.pursuit(&sight, false),
            },
            BACKWARDS => Command::Steer {
                speed: -approach,
                angle: self.pursuit(&sight, true),
            },
            SHUNT_AHEAD => Command::Steer {
                speed: shunt,
                angle: away,
            },
            _ => Command::Steer {
                speed: -shunt,
                angle: away,
            },
        }
    }

    fn sight(&self, estimate: &Estimate, target: Point) -> Sight {
        let (sin, cos) = sincos(estimate.pose.yaw);
        let way = target - estimate.pose.position;
        let centre_ahead = cos * way.x + sin * way.y;
        let left = cos * way.y - sin * way.x;
        let ahead = centre_ahead + 0.5 * self.wheelbase;
        Sight {
            ahead,
            left,
            centre_ahead,
            distance: way.planar_length(),
        }
    }

    /// Turning radius of the rear axle, metres.
    fn radius(&self) -> f64 {
        self.wheelbase / tan(self.steering_angle)
    }

    /// How far the point is outside of the nearer smallest turning circle, metres.
    fn clearance(&self, sight: &Sight) -> f64 {
        hypot(sight.ahead, fabs(sight.left) - self.radius()) - self.radius()
    }

    fn phase(&self, phase: u32, sight: &Sight) -> u32 {
        let clearance = self.clearance(sight);
        let room = SHUNT_MARGIN * self.radius();
        match phase {
            // Past the point, or unable to reach it: think again.
            FORWARDS if sight.centre_ahead < -TOLERANCE.start && self.near(sight) => {
                self.decide(sight)
            }
            BACKWARDS if sight.centre_ahead > TOLERANCE.start => self.decide(sight),
            FORWARDS | BACKWARDS if clearance < -GIVE_UP_DEPTH => self.decide(sight),
            SHUNT_BACK if clearance > room && sight.centre_ahead > 0.0 => FORWARDS,
            SHUNT_AHEAD if clearance > room && sight.centre_ahead < 0.0 => BACKWARDS,
            UNDECIDED => self.decide(sight),
            other => other,
        }
    }

    fn near(&self, sight: &Sight) -> bool {
        sight.distance < BACKWARDS_WITHIN * self.radius()
    }

    fn decide(&self, sight: &Sight) -> u32 {
        let reachable = self.clearance(sight) >= 0.0;
        match (sight.centre_ahead >= 0.0, reachable) {
            (true, true) => FORWARDS,
            (true, false) => SHUNT_BACK,
            (false, true) if self.near(sight) => BACKWARDS,
            (false, true) => FORWARDS,
            (false, false) => SHUNT_AHEAD,
        }
    }

    /// The speed from which the car can still stop at the point, however late the next estimate.
    fn approach_speed(&self, distance: f64, period: f64) -> f64 {
        let braking = sqrt(2.0 * BRAKING * self.acceleration * distance);
        let gain = PART_PER_SECOND.min(PART_PER_ESTIMATE / period);
        braking.min(gain * distance)
    }

    /// Steering angle that turns the car, as it approaches, towards the point.
    fn pursuit(&self, sight: &Sight, backwards: bool) -> f64 {
        let Sight { ahead, left, .. } = *sight;
        let before = if backwards { -ahead } else { ahead };
        if before <= 0.0 {
            return if left < 0.0 {
                -self.steering_angle
            } else {
                self.steering_angle
            };
        }
        let distance = hypot(ahead, left);
        // Near the rear axle the circle would be tiny; there the centre has already arrived.
        let reach = distance
            .min(LOOK_AHEAD * self.radius())
            .max(0.5 * self.wheelbase);
        let curvature = 2.0 * left / (distance.max(0.5 * self.wheelbase) * reach);
        atan(self.wheelbase * curvature).clamp(-self.steering_angle, self.steering_angle)
    }
}
