//! The iRobot Create: a round robot on two wheels that turns on the spot (thesis, tables 4.1, 4.2).
//!
//! Invariant: neither wheel's rim moves faster than `wheel_speed`. Speeds follow the command at once,
//! as in the thesis. Commands: `Straight`, `Turn`, `Curve`, `Stop`, and `Wheels` (the robot's own
//! "drive direct"). Sources: iRobot Create Open Interface specification (2006): wheel speeds up to
//! 500 mm/s, wheels 258 mm apart; body of 330 mm diameter. The thesis leaves the limits out.

use super::{Parameterised, unicycle};
use crate::model::control;
use crate::parameters::{Field, ParameterError, ParameterSet, ordered, parameters};
use crate::tracking::unicycle::{Drive, Gains};
use crate::tracking::{Goal, Tracking};
use crate::{Disturbance, Limits, Model, State};
use alloc::vec::Vec;
use starl_core::math::{fabs, radians};
use starl_core::motion::{Body, Estimate, Workspace};
use starl_core::{Command, Duration, Pose};

/// The model's name.
pub(super) const NAME: &str = "create";

parameters! {
    /// The parameters of a [`Create`].
    pub struct CreateParameters {
        /// Radius of the body.
        radius: "m" = 0.165, 0.01 => 10.0;
        /// Height of the body.
        height: "m" = 0.078, 0.01 => 10.0;
        /// Distance between the wheels.
        wheel_distance: "m" = 0.258, 0.01 => 10.0;
        /// Greatest speed of a wheel's rim.
        wheel_speed: "m/s" = 0.5, 0.001 => 100.0;
        /// Speed of travel while tracking.
        cruise_speed: "m/s" = 0.25, 0.001 => 100.0;
        /// Speed of travel while tracking near the waypoint.
        slow_speed: "m/s" = 0.175, 0.001 => 100.0;
        /// Distance from the waypoint within which tracking drives slowly.
        slow_distance: "m" = 0.7, 0.0 => 100.0;
        /// Rate of turn while tracking.
        cruise_turn: "degrees/s" = 50.0, 1.0 => 10000.0;
        /// Rate of turn while tracking when it nearly points the right way.
        slow_turn: "degrees/s" = 25.0, 1.0 => 10000.0;
    }
}

/// The iRobot Create.
#[derive(Clone, Debug)]
pub struct Create {
    parameters: CreateParameters,
    gains: Gains,
}

impl Create {
    /// A Create with these parameters.
    ///
    /// # Errors
    /// If a parameter is out of its range or exceeds what the wheels can do.
    pub fn new(parameters: CreateParameters) -> Result<Create, ParameterError> {
        parameters.check_ranges()?;
        ordered(
            ("cruise_speed", parameters.cruise_speed),
            ("wheel_speed", parameters.wheel_speed),
        )?;
        ordered(
            ("slow_speed", parameters.slow_speed),
            ("cruise_speed", parameters.cruise_speed),
        )?;
        ordered(
            ("slow_turn", parameters.slow_turn),
            ("cruise_turn", parameters.cruise_turn),
        )?;
        let gains = Gains {
            cruise_speed: parameters.cruise_speed,
            slow_speed: parameters.slow_speed,
            slow_distance: parameters.slow_distance,
            cruise_turn: radians(parameters.cruise_turn),
            slow_turn: radians(parameters.slow_turn),
        };
        Ok(Create { parameters, gains })
    }

    /// Speed and rate of turn under a command, within the limits of the wheels.
    fn drive(&self, command: &Command) -> (f64, f64) {
        let limit = self.parameters.wheel_speed;
        let half_axle = 0.5 * self.parameters.wheel_distance;
        match *command {
            Command::Straight { speed } => (speed.clamp(-limit, limit), 0.0),
            Command::Turn { rate } => (0.0, rate.clamp(-limit / half_axle, limit / half_axle)),
            Command::Curve { speed, radius } => {
                // The outer wheel is the faster one; slowing both down keeps the radius.
                let outer = fabs(radius) + half_axle;
                if fabs(speed) * outer <= limit * fabs(radius) {
                    return (speed, speed / radius);
                }
                let rate = limit / outer * speed.signum() * radius.signum();
                (rate * radius, rate)
            }
            Command::Wheels { left, right } => unicycle::of_wheels(
                left.clamp(-limit, limit),
                right.clamp(-limit, limit),
                self.parameters.wheel_distance,
            ),
            _ => (0.0, 0.0),
        }
    }
}

impl Default for Create {
    fn default() -> Create {
        Create::new(CreateParameters::default()).expect("the defaults are in their ranges")
    }
}

impl Parameterised for Create {
    type Parameters = CreateParameters;

    fn build(parameters: CreateParameters) -> Result<Create, ParameterError> {
        Create::new(parameters)
    }
}

impl Model for Create {
    fn name(&self) -> &'static str {
        NAME
    }

    fn parameters(&self) -> Vec<(Field, f64)> {
        self.parameters.changed()
    }

    fn body(&self) -> Body {
        let CreateParameters { radius, height, .. } = self.parameters;
        Body {
            radius,
            height,
            workspace: Workspace::Ground,
        }
    }

    fn limits(&self) -> Limits {
        let CreateParameters {
            wheel_speed,
            wheel_distance,
            cruise_speed,
            ..
        } = self.parameters;
        Limits {
            speed: wheel_speed,
            cruise_speed,
            vertical_speed: 0.0,
            acceleration: f64::INFINITY,
            turn_rate: 2.0 * wheel_speed / wheel_distance,
            turn_radius: 0.0,
            stopping_distance: self.gains.stopping_distance(),
        }
    }

    fn accepts(&self, command: &Command) -> bool {
        match *command {
            Command::Stop => true,
            Command::Straight { speed } => speed.is_finite(),
            Command::Turn { rate } => rate.is_finite(),
            Command::Curve { speed, radius } => {
                speed.is_finite() && radius.is_finite() && radius != 0.0
            }
            Command::Wheels { left, right } => left.is_finite() && right.is_finite(),
            _ => false,
        }
    }

    fn controls(&self) -> &'static [&'static str] {
        &["left wheel", "right wheel"]
    }

    fn command_of(&self, controls: &[f64]) -> Command {
        let limit = self.parameters.wheel_speed;
        Command::Wheels {
            left: limit * control(controls, 0),
            right: limit * control(controls, 1),
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
        let (speed, rate) = match self.accepts(command) {
            true => self.drive(command),
            false => (0.0, 0.0),
        };
        let (speed, rate) = unicycle::disturbed(
            (speed, rate),
            disturbance,
            self.parameters.wheel_speed,
            self.parameters.wheel_distance,
        );
        unicycle::drive(state, speed, rate, elapsed.seconds())
    }

    fn track(&self, tracking: &mut Tracking, estimate: &Estimate, goal: &Goal) -> Command {
        match self.gains.track(tracking, estimate, goal) {
            Drive::Stop => Command::Stop,
            Drive::Straight { speed } => Command::Straight { speed },
            Drive::Turn { rate } => Command::Turn { rate },
            Drive::Arc { speed, rate } => Command::Curve {
                speed,
                radius: speed / rate,
            },
        }
    }
}
