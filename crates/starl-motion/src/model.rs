//! The contract of a robot model: its body, its commands and its dynamics (thesis, section 4.3).

use crate::parameters::Field;
use crate::tracking::{Goal, Tracking};
use alloc::vec::Vec;
use core::fmt::Debug;
use serde::{Deserialize, Serialize};
use starl_core::motion::{Body, Estimate};
use starl_core::{Command, Duration, Point, Pose, Twist};

/// The physical state of a robot, the same shape for every model so that hosts can keep states in one array; a model
/// ignores unused fields.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// True pose.
    pub pose: Pose,
    /// True velocity.
    pub twist: Twist,
    /// The phase of the model, in its own numbering, for example landed, taking off, flying.
    pub mode: u32,
    /// Quantities of the model's own, e.g. a steering angle; the model documents them.
    pub memory: [f64; 2],
}

/// The deviations of a robot from its commanded motion, during one step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Disturbance {
    /// Velocity of the air, world frame, metres per second; ground robots do not feel it.
    pub wind: Point,
    /// Relative error of commands except turning: with 0.1 the speed is 10 % higher, or a drone's tilt and climb. The
    /// limits of the model still apply.
    pub speed_error: f64,
    /// The same of turning: rate of turn, or a car's steering angle.
    pub turn_error: f64,
}

/// The cause of a stop of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// The position where the body stops at the contact.
    pub place: Point,
    /// Unit vector from the robot's centre towards the contact, in the floor plane.
    pub direction: Point,
}

/// The bounds of a model's motion without contacts, in calm air, including errors of its drive. The conformance suite
/// checks them for every model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Greatest speed in the floor plane, metres per second.
    pub speed: f64,
    /// Speed in the floor plane at which tracking travels, metres per second.
    pub cruise_speed: f64,
    /// Greatest rate of climb and descent, metres per second; 0 on the ground.
    pub vertical_speed: f64,
    /// Greatest change of velocity, metres per second squared; infinite where the model changes its
    /// speed at once.
    pub acceleration: f64,
    /// Greatest rate of turn, radians per second.
    pub turn_rate: f64,
    /// Smallest radius of a turn while driving, metres; 0 where the robot turns on the spot.
    pub turn_radius: f64,
    /// An upper bound of the distance, metres, in which tracking brings the robot to a halt from
    /// its cruise speed, overshoot included, with estimates every 100 ms or faster and calm air.
    pub stopping_distance: f64,
}

impl Limits {
    /// Seconds for which the speed carries on when the robot brakes: stopping distance over cruise
    /// speed. As the distance grows at least as fast as the speed, this does for lower speeds too.
    /// Nothing for a robot that changes its speed at once.
    pub fn braking_time(&self) -> f64 {
        if self.acceleration == f64::INFINITY || self.cruise_speed <= 0.0 {
            0.0
        } else {
            self.stopping_distance / self.cruise_speed
        }
    }
}

/// A kind of robot with its parameters: immutable, shared by all robots of the kind.
///
/// A host advances a robot in two halves: [`Model::predict`] computes its state after a step; the host checks for
/// contacts; [`Model::stop_at`] stops the body at its contact.
pub trait Model: Debug + Send + Sync {
    /// The name used in scenarios, e.g. `create`.
    fn name(&self) -> &'static str;

    /// The parameters that are not at their defaults, with their values in the unit of their field, so
    /// that the model can be built again: [`crate::models::with_parameters`].
    fn parameters(&self) -> Vec<(Field, f64)>;

    /// The space it takes.
    fn body(&self) -> Body;

    /// The bounds of its motion.
    fn limits(&self) -> Limits;

    /// Whether this is one of the model's commands, with finite arguments.
    fn accepts(&self, command: &Command) -> bool;

    /// The names of the numbers that [`Model::command_of`] takes.
    fn controls(&self) -> &'static [&'static str];

    /// The command that these numbers give, each a part of its limit: -1 the limit backwards or to the right, 1 forwards
    /// or to the left. Numbers beyond are driven at the limit, and those left out are 0. With a number that is not
    /// finite, the command is one that the model refuses.
    fn command_of(&self, controls: &[f64]) -> Command;

    /// The state of a robot at rest at `pose`.
    fn at_rest(&self, pose: Pose) -> State;

    /// The state after `elapsed` under `command`, if nothing is in the way. Commands beyond the
    /// limits are driven at the limits; commands the model does not take act as
    /// [`Command::Stop`].
    fn predict(
        &self,
        state: &State,
        command: &Command,
        disturbance: &Disturbance,
        elapsed: Duration,
    ) -> State;

    /// The command that tracks the waypoint `goal` from the estimated pose, closed loop, to be
    /// driven until the next estimate (the thesis's RobotMotion). `tracking` is what the tracker
    /// remembers from one estimate to the next.
    fn track(&self, tracking: &mut Tracking, estimate: &Estimate, goal: &Goal) -> Command;

    /// The command that brings the robot to rest within its braking way and keeps it there, to be driven until the next
    /// estimate. By default it is [`Command::Stop`].
    fn rest(&self, tracking: &mut Tracking, _: &Estimate) -> Command {
        tracking.interrupt();
        Command::Stop
    }

    /// Whether the robot has long been pushed, as by wind, harder than it can hold against, by what its tracker
    /// remembers. Ground robots never are.
    fn is_overpowered(&self, _: &Tracking) -> bool {
        false
    }

    /// The way that the robot still makes if tracking halts it from now on: displacement in the floor
    /// plane, metres. By default its velocity carries on for [`Limits::braking_time`].
    fn braking_way(&self, estimate: &Estimate) -> Point {
        estimate.twist.linear.at_height(0.0) * self.limits().braking_time()
    }

    /// Changes the predicted state of a body to that of one which a contact has stopped at this place.
    fn stop_at(&self, predicted: &mut State, place: Point) {
        predicted.pose.position = place;
        predicted.twist.linear = Point::ZERO;
    }
}

/// Control number `which`, at most 1 either way; 0 if it is left out.
pub(crate) fn control(controls: &[f64], which: usize) -> f64 {
    controls
        .get(which)
        .map_or(0.0, |number| number.clamp(-1.0, 1.0))
}
