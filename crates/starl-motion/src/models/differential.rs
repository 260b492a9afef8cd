//! A small robot on two wheels, such as the foot-bot of swarm experiments.
//!
//! Invariant: neither wheel's rim moves faster than `wheel_speed`. Speeds follow the command at once.
//! Commands: `Wheels`, `Stop`. Sources: foot-bot (Bonani et al. 2010, "The marXbot, a miniature mobile
//! robot opening new perspectives for the collective-robotic research"): radius 85 mm, wheels 140 mm
//! apart, 30 cm/s.

use super::{Parameterised, unicycle};
use crate::model::control;
use crate::parameters::{Field, ParameterError, ParameterSet, ordered, parameters};
use crate::tracking::unicycle::{Drive, Gains};
use crate::tracking::{Goal, Tracking};
use crate::{Disturbance, Limits, Model, State};
use alloc::vec::Vec;
use starl_core::motion::{Body, Estimate, Workspace};
use starl_core::{Command, Duration, Pose};

/// The model's name.
pub(super) const NAME: &str = "differential";

parameters! {
    /// The parameters of a [`Differential`].
    pub struct DifferentialParameters {
        /// Radius of the body.
        radius: "m" = 0.085, 0.01 => 10.0;
        /// Height of the body.
        height: "m" = 0.17, 0.01 => 10.0;
        /// Distance between the wheels.
        wheel_distance: "m" = 0.14, 0.01 => 10.0;
        /// Greatest speed of a wheel's rim.
        wheel_speed: "m/s" = 0.3, 0.001 => 100.0;
        /// Speed of travel while tracking.
        cruise_speed: "m/s" = 0.2, 0.001 => 100.0;
    }
}

/// A small robot on two wheels.
#[derive(Clone, Debug)]
pub struct Differential {
    parameters: DifferentialParameters,
    gains: Gains,
}

impl Differential {
    /// A robot with these parameters.
    ///
    /// # Errors
    /// If a parameter is out of its range or exceeds what the wheels can do.
    pub fn new(parameters: DifferentialParameters) -> Result<Differential, ParameterError> {
        parameters.check_ranges()?;
        let DifferentialParameters {
            wheel_distance,
            wheel_speed,
            cruise_speed,
            ..
        } = parameters;
        ordered(("cruise_speed", cruise_speed), ("wheel_speed", wheel_speed))?;
        let turn = 2.0 * cruise_speed / wheel_distance;
        let gains = Gains {
            cruise_speed,
            slow_speed: cruise_speed,
            slow_distance: 0.0,
            cruise_turn: turn,
            slow_turn: turn,
        };
        Ok(Differential { parameters, gains })
    }

    fn wheels(&self, speed: f64, rate: f64) -> Command {
        let difference = 0.5 * rate * self.parameters.wheel_distance;
        // Slowing both wheels alike keeps the radius of the path.
        let fastest = starl_core::math::fabs(speed) + starl_core::math::fabs(difference);
        let scale = (self.parameters.wheel_speed / fastest).min(1.0);
        Command::Wheels {
            left: (speed - difference) * scale,
            right: (speed + difference) * scale,
        }
    }
}

impl Default for Differential {
    fn default() -> Differential {
        Differential::new(DifferentialParameters::default())
            .expect("the defaults are in their ranges")
    }
}

impl Parameterised for Differential {
    type Parameters = DifferentialParameters;

    fn build(parameters: DifferentialParameters) -> Result<Differential, ParameterError> {
        Differential::new(parameters)
    }
}

impl Model for Differential {
    fn name(&self) -> &'static str {
        NAME
    }

    fn parameters(&self) -> Vec<(Field, f64)> {
        self.parameters.changed()
    }

    fn body(&self) -> Body {
        let DifferentialParameters { radius, height, .. } = self.parameters;
        Body {
            radius,
            height,
            workspace: Workspace::Ground,
        }
    }

    fn limits(&self) -> Limits {
        let DifferentialParameters {
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
        let (speed, rate) = match *command {
            Command::Wheels { left, right } if left.is_finite() && right.is_finite() => {
                let limit = self.parameters.wheel_speed;
                let (left, right) = (left.clamp(-limit, limit), right.clamp(-limit, limit));
                unicycle::of_wheels(left, right, self.parameters.wheel_distance)
            }
            _ => (0.0, 0.0),
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
            Drive::Straight { speed } => self.wheels(speed, 0.0),
            Drive::Turn { rate } => self.wheels(0.0, rate),
            Drive::Arc { speed, rate } => self.wheels(speed, rate),
        }
    }
}
