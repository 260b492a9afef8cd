//! An ideal ground robot that moves in any direction at once, whatever its heading.
//!
//! Invariant: its speed never exceeds `speed`, its rate of turn never `turn_rate`. Commands:
//! `Velocity`, `Stop`. It is not in the thesis; it isolates an algorithm from the effects of dynamics.

use super::Parameterised;
use crate::model::control;
use crate::parameters::{Field, ParameterError, ParameterSet, ordered, parameters};
use crate::tracking::{Goal, Tracking, holonomic};
use crate::{Disturbance, Limits, Model, State};
use alloc::vec::Vec;
use starl_core::math::{radians, wrap_angle};
use starl_core::motion::{Body, Estimate, Workspace};
use starl_core::{Command, Duration, Point, Pose, Twist};

/// The model's name.
pub(super) const NAME: &str = "holonomic";

parameters! {
    /// The parameters of a [`Holonomic`].
    pub struct HolonomicParameters {
        /// Radius of the body.
        radius: "m" = 0.15, 0.01 => 10.0;
        /// Height of the body.
        height: "m" = 0.15, 0.01 => 10.0;
        /// Greatest speed.
        speed: "m/s" = 1.0, 0.001 => 100.0;
        /// Speed of travel while tracking.
        cruise_speed: "m/s" = 0.5, 0.001 => 100.0;
        /// Greatest rate of turn.
        turn_rate: "degrees/s" = 180.0, 0.0 => 10000.0;
    }
}

/// An ideal holonomic robot.
#[derive(Clone, Debug)]
pub struct Holonomic {
    parameters: HolonomicParameters,
}

impl Holonomic {
    /// A robot with these parameters.
    ///
    /// # Errors
    /// If a parameter is out of its range or the cruise speed exceeds the greatest speed.
    pub fn new(parameters: HolonomicParameters) -> Result<Holonomic, ParameterError> {
        parameters.check_ranges()?;
        ordered(
            ("cruise_speed", parameters.cruise_speed),
            ("speed", parameters.speed),
        )?;
        Ok(Holonomic { parameters })
    }
}

impl Default for Holonomic {
    fn default() -> Holonomic {
        Holonomic::new(HolonomicParameters::default()).expect("the defaults are in their ranges")
    }
}

impl Parameterised for Holonomic {
    type Parameters = HolonomicParameters;

    fn build(parameters: HolonomicParameters) -> Result<Holonomic, ParameterError> {
        Holonomic::new(parameters)
    }
}

impl Model for Holonomic {
    fn name(&self) -> &'static str {
        NAME
    }

    fn parameters(&self) -> Vec<(Field, f64)> {
        self.parameters.changed()
    }

    fn body(&self) -> Body {
        let HolonomicParameters { radius, height, .. } = self.parameters;
        Body {
            radius,
            height,
            workspace: Workspace::Ground,
        }
    }

    fn limits(&self) -> Limits {
        let HolonomicParameters {
            speed,
            cruise_speed,
            turn_rate,
            ..
        } = self.parameters;
        Limits {
            speed,
            cruise_speed,
            vertical_speed: 0.0,
            acceleration: f64::INFINITY,
            turn_rate: radians(turn_rate),
            turn_radius: 0.0,
            stopping_distance: holonomic::stopping_distance(cruise_speed),
        }
    }

    fn accepts(&self, command: &Command) -> bool {
        match *command {
            Command::Stop => true,
            Command::Velocity { velocity, yaw_rate } => {
                velocity.is_finite() && yaw_rate.is_finite()
            }
            _ => false,
        }
    }

    fn controls(&self) -> &'static [&'static str] {
        &["velocity x", "velocity y", "rate of yaw"]
    }

    fn command_of(&self, controls: &[f64]) -> Command {
        let velocity = Point::planar(control(controls, 0), control(controls, 1));
        Command::Velocity {
            velocity: velocity * self.parameters.speed,
            yaw_rate: radians(self.parameters.turn_rate) * control(controls, 2),
        }
    }

    fn at_rest(&self, pose: Pose) -> State {
        State {
            pose,
            ..State::default()
        }
    }

    fn predict(
        &self,
        state: &State,
        command: &Command,
        disturbance: &Disturbance,
        elapsed: Duration,
    ) -> State {
        let (linear, yaw_rate) = match *command {
            Command::Velocity { velocity, yaw_rate } if self.accepts(command) => {
                let limit = radians(self.parameters.turn_rate);
                let velocity = velocity * (1.0 + disturbance.speed_error);
                let yaw_rate = yaw_rate * (1.0 + disturbance.turn_error);
                (
                    at_most(velocity, self.parameters.speed),
                    yaw_rate.clamp(-limit, limit),
                )
            }
            _ => (Point::ZERO, 0.0),
        };
        let seconds = elapsed.seconds();
        let pose = Pose {
            position: state.pose.position + linear * seconds,
            yaw: wrap_angle(state.pose.yaw + yaw_rate * seconds),
            ..state.pose
        };
        State {
            pose,
            twist: Twist {
                linear,
                yaw: yaw_rate,
                ..Twist::default()
            },
            ..*state
        }
    }

    fn track(&self, tracking: &mut Tracking, estimate: &Estimate, goal: &Goal) -> Command {
        holonomic::track(tracking, estimate, goal, self.parameters.cruise_speed)
    }
}

/// The part of `velocity` in the floor plane, no longer than `limit`.
fn at_most(velocity: Point, limit: f64) -> Point {
    let planar = velocity.at_height(0.0);
    // Scaled first, so that squares of huge numbers do not overflow.
    let largest = planar.x.abs().max(planar.y.abs());
    if largest <= 0.0 {
        return Point::ZERO;
    }
    let direction = planar / largest;
    let relative = direction.planar_length();
    if largest * relative <= limit {
        planar
    } else {
        direction * (limit / relative)
    }
}
