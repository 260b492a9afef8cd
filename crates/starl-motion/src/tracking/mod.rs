//! Waypoint tracking: closed loop from estimates to commands of the robot's own model (the thesis's
//! RobotMotion and MotionAutomation), one file per family of models.
//!
//! A tracker is a pure function of the estimate, the goal and a small [`Tracking`] memory that has the
//! same shape for every model. It is called at every new estimate, and copes with estimates that are
//! noisy and up to some 200 ms apart.

mod arrival;
pub(crate) mod car;
pub(crate) mod drone;
pub(crate) mod holonomic;
pub(crate) mod unicycle;

use arrival::Rest;
use starl_core::motion::Estimate;
use starl_core::{Point, Time};

/// Where to go now, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// The waypoint, metres. Ground robots leave the height out; a quadcopter on the floor stays
    /// there while the height is less than its lowest height of travel.
    pub target: Point,
    /// The waypoint after that, metres: the robot may flow through `target` towards it. None if the robot must stop at
    /// `target`.
    pub next: Option<Point>,
    /// Greatest speed in the floor plane, metres per second; infinite if there is no limit.
    pub speed_limit: f64,
}

impl Goal {
    /// Go to `target` and stop there, as fast as the tracker likes.
    pub const fn stop_at(target: Point) -> Goal {
        Goal {
            target,
            next: None,
            speed_limit: f64::INFINITY,
        }
    }

    /// The speed to go through the target with: a part of `cruise_speed` that shrinks with the turn
    /// ahead, and nothing for turns of a right angle and more; 0 where the robot is to stop.
    fn through_speed(&self, position: Point, cruise_speed: f64) -> f64 {
        let Some(next) = self.next else { return 0.0 };
        let (into, out) = (self.target - position, next - self.target);
        let lengths = into.planar_length() * out.planar_length();
        if lengths <= 0.0 {
            return 0.0;
        }
        let cosine = (into.x * out.x + into.y * out.y) / lengths;
        cruise_speed * cosine.clamp(0.0, 1.0)
    }
}

/// The state of a tracker between two estimates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tracking {
    /// When the estimate before this one was taken.
    previous: Option<Time>,
    /// The phase of the robot, in its tracker's own numbering; 0 at first.
    phase: u32,
    /// Set while the robot stands at its goal.
    rest: Option<Rest>,
    /// The steady push, such as wind, that the robot is taken to be under, metres per second squared.
    push: Point,
    /// For how long the push has exceeded what the robot can hold against, seconds.
    overpowered: f64,
    /// How the robot moved at the estimate before this one, if its tracker has driven it since.
    last: Option<Moment>,
    /// Where and when the robot began to brake for a halt, while it brakes.
    brakes_from: Option<(Point, Time)>,
}

/// How a robot moved at an estimate.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Moment {
    /// The velocity that it is taken to have had, metres per second.
    velocity: Point,
    /// The acceleration that its tilt caused, metres per second squared.
    tilting: Point,
}

/// The time between estimates that a tracker reckons with before it has seen two, seconds.
const FIRST_PERIOD: f64 = 0.1;

impl Tracking {
    /// For a while the robot was not driven by its tracker.
    pub(crate) fn interrupt(&mut self) {
        self.last = None;
        self.overpowered = 0.0;
    }

    /// Seconds since the estimate before this one, within reason; to be called once per estimate.
    fn period(&mut self, estimate: &Estimate) -> f64 {
        let previous = self.previous.replace(estimate.at);
        let elapsed = previous.map_or(FIRST_PERIOD, |before| estimate.at.since(before).seconds());
        if elapsed > 0.0 {
            elapsed.clamp(0.005, 0.5)
        } else {
            FIRST_PERIOD
        }
    }
}
