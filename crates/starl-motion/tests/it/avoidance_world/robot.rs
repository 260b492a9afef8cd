//! One robot of the avoidance tests' world: its true state, its pilot, and its last command.

use super::Placed;
use starl_core::motion::Estimate;
use starl_core::{Command, MotionRequest, Point, Pose, Random};
use starl_motion::avoidance::Options;
use starl_motion::{Model, Neighbour, Pilot, State, models};
use std::sync::Arc;

/// One robot of a world.
pub struct Robot {
    pub model: Arc<dyn Model>,
    pub state: State,
    pub goal: Point,
    pub arrived: bool,
    pub command: Command,
    pub(super) pilot: Pilot,
    pub(super) random: Random,
    pub(super) phase: u64,
    pub(super) seen: Estimate,
}

impl Robot {
    /// A robot at rest, on its way to its goal.
    pub(super) fn new(
        placed: &Placed,
        yaw: f64,
        phase: u64,
        random: Random,
        options: Option<Options>,
    ) -> Robot {
        let model = models::by_name(placed.model).expect("a model of this name");
        let state = model.at_rest(Pose::level(placed.start, yaw));
        let mut robot = Robot {
            pilot: Pilot::new(&*model, options),
            seen: Estimate {
                pose: state.pose,
                ..Estimate::default()
            },
            random,
            phase,
            command: Command::Stop,
            arrived: false,
            goal: placed.goal,
            model,
            state,
        };
        robot.send(placed.goal);
        robot
    }

    /// Sends the robot to a point.
    pub fn send(&mut self, goal: Point) {
        self.goal = goal;
        self.arrived = false;
        let target = self.model.body().reachable(goal);
        self.pilot
            .request(&MotionRequest::Track { target, next: None });
    }

    /// Stops the robot, which counts as an arrival.
    pub fn halt(&mut self) {
        self.pilot.request(&MotionRequest::Halt);
        self.arrived = true;
    }

    /// Where it truly is.
    pub fn position(&self) -> Point {
        self.state.pose.position
    }

    /// Free space between its body and another one, metres; infinite if one is above the other.
    pub fn gap(&self, other: &Robot) -> f64 {
        let (a, b) = (self.model.body(), other.model.body());
        let (low, high) = (self.position().z, other.position().z);
        if low >= high + b.height || high >= low + a.height {
            return f64::INFINITY;
        }
        self.position().planar_distance(other.position()) - a.radius - b.radius
    }

    pub(super) fn neighbour(&self) -> Neighbour {
        let body = self.model.body();
        Neighbour {
            position: self.seen.pose.position,
            velocity: self.seen.twist.linear,
            radius: body.radius,
            height: body.height,
        }
    }
}
