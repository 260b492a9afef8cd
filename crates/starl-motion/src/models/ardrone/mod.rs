//! The Parrot AR.Drone 2: a quadcopter with its maker's own flight controller (thesis, tables 4.1 and
//! 4.2).
//!
//! The equations are derived, and compared with the thesis's, in `docs/reference/models.md`. Thrust
//! acts along the body's axis and is set so that the vertical speed follows its reference; tilting
//! turns part of it into horizontal acceleration; drag is linear in the speed through the air. Pitch
//! and roll follow their references with critical damping, rates of yaw and climb with a first-order
//! lag; all are integrated by the classical Runge-Kutta method in steps of 20 ms or less.
//!
//! Invariants: the references for pitch and roll stay in the disc of radius `tilt`, so that, as
//! critical damping does not overshoot, the attitude does too; the drone is never below the floor; it
//! moves only in the air. Commands: `TakeOff`, `Land`, `Hover`, `Attitude`, and `Stop`, which hovers.

mod controller;
mod dynamics;
pub mod mode;

use super::Parameterised;
use crate::model::control;
use crate::parameters::{Field, ParameterError, ParameterSet, ordered, parameters};
use crate::tracking::drone::Gains;
use crate::tracking::{Goal, Tracking};
use crate::{Disturbance, Limits, Model, State};
use alloc::vec::Vec;
use starl_core::math::{radians, tan};
use starl_core::motion::{Body, Estimate, Workspace};
use starl_core::{Command, Duration, Point, Pose};

/// The model's name.
pub(super) const NAME: &str = "drone";

parameters! {
    /// The parameters of an [`Ardrone`].
    pub struct ArdroneParameters {
        /// Radius of the upright cylinder it takes.
        radius: "m" = 0.34, 0.01 => 10.0;
        /// Height of the body.
        height: "m" = 0.13, 0.01 => 10.0;
        /// Mass, with the hull for flying indoors.
        mass: "kg" = 0.42, 0.01 => 100.0;
        /// Drag per speed through the air.
        drag: "kg/s" = 0.3, 0.001 => 100.0;
        /// Greatest tilt: pitch and roll together.
        tilt: "degrees" = 20.0, 1.0 => 45.0;
        /// Greatest rate of yaw.
        yaw_rate: "degrees/s" = 200.0, 0.0 => 1000.0;
        /// Greatest rate of climb and descent.
        vertical_speed: "m/s" = 1.0, 0.01 => 10.0;
        /// Height to which it takes off, and lowest height of travel.
        safe_height: "m" = 0.5, 0.05 => 100.0;
        /// Rate of descent when landing.
        landing_speed: "m/s" = 0.5, 0.01 => 10.0;
        /// Natural frequency of the loops for pitch and roll.
        attitude_frequency: "rad/s" = 10.0, 1.0 => 50.0;
        /// Time constant of the loop for the rate of yaw.
        yaw_time: "s" = 0.2, 0.02 => 10.0;
        /// Time constant of the loop for the rate of climb.
        climb_time: "s" = 0.3, 0.02 => 10.0;
        /// Speed of travel in the floor plane while tracking.
        cruise_speed: "m/s" = 1.5, 0.01 => 20.0;
    }
}

/// Standard gravity, metres per second squared.
pub(crate) const GRAVITY: f64 = 9.80665;

/// The AR.Drone 2.
#[derive(Clone, Debug)]
pub struct Ardrone {
    parameters: ArdroneParameters,
    dynamics: dynamics::Dynamics,
    gains: Gains,
}

impl Ardrone {
    /// A drone with these parameters.
    ///
    /// # Errors
    /// If a parameter is out of its range or exceeds what the drone can do.
    pub fn new(parameters: ArdroneParameters) -> Result<Ardrone, ParameterError> {
        parameters.check_ranges()?;
        let p = &parameters;
        let tilt = radians(p.tilt);
        let drag = p.drag / p.mass;
        ordered(
            ("landing_speed", p.landing_speed),
            ("vertical_speed", p.vertical_speed),
        )?;
        ordered(
            ("cruise_speed", p.cruise_speed),
            (
                "the speed at which drag balances the tilt",
                tan(tilt) * GRAVITY / drag,
            ),
        )?;
        let dynamics = dynamics::Dynamics {
            drag,
            tilt,
            yaw_rate: radians(p.yaw_rate),
            climb: p.vertical_speed,
            attitude_frequency: p.attitude_frequency,
            yaw_time: p.yaw_time,
            climb_time: p.climb_time,
            safe_height: p.safe_height,
            landing_speed: p.landing_speed,
        };
        let gains = Gains {
            lowest: p.safe_height,
            cruise_speed: p.cruise_speed,
            climb_speed: p.vertical_speed,
            drag,
            tilt,
            // Attitude follows with critical damping.
            tilt_lag: 2.0 / p.attitude_frequency,
            gravity: GRAVITY,
        };
        Ok(Ardrone {
            parameters,
            dynamics,
            gains,
        })
    }
}

impl Default for Ardrone {
    fn default() -> Ardrone {
        Ardrone::new(ArdroneParameters::default()).expect("the defaults are in their ranges")
    }
}

impl Parameterised for Ardrone {
    type Parameters = ArdroneParameters;

    fn build(parameters: ArdroneParameters) -> Result<Ardrone, ParameterError> {
        Ardrone::new(parameters)
    }
}

impl Model for Ardrone {
    fn name(&self) -> &'static str {
        NAME
    }

    fn parameters(&self) -> Vec<(Field, f64)> {
        self.parameters.changed()
    }

    fn body(&self) -> Body {
        let ArdroneParameters {
            radius,
            height,
            safe_height,
            ..
        } = self.parameters;
        Body {
            radius,
            height,
            workspace: Workspace::Air {
                lowest: safe_height,
            },
        }
    }

    fn limits(&self) -> Limits {
        let dynamics = &self.dynamics;
        let slope = tan(dynamics.tilt);
        let climb = dynamics.climb;
        // Drag filters the horizontal acceleration slope * (g + z'') over time; integrating by parts
        // bounds what the climbing term adds by two climb speeds.
        let speed = slope * (GRAVITY / dynamics.drag + 2.0 * climb);
        let climbing = 2.0 * climb / dynamics.climb_time;
        let braking = slope * (GRAVITY + climbing) + dynamics.drag * speed;
        Limits {
            speed,
            cruise_speed: self.parameters.cruise_speed,
            vertical_speed: climb,
            acceleration: starl_core::math::sqrt(braking * braking + climbing * climbing),
            turn_rate: dynamics.yaw_rate,
            turn_radius: 0.0,
            stopping_distance: self.gains.stopping_distance(),
        }
    }

    fn braking_way(&self, estimate: &Estimate) -> Point {
        self.gains.braking_way(estimate)
    }

    fn accepts(&self, command: &Command) -> bool {
        match *command {
            Command::Stop | Command::Hover | Command::TakeOff | Command::Land => true,
            Command::Attitude {
                yaw_rate,
                pitch,
                roll,
                gaz,
            } => [yaw_rate, pitch, roll, gaz]
                .iter()
                .all(|number| number.is_finite()),
            _ => false,
        }
    }

    fn controls(&self) -> &'static [&'static str] {
        &["rate of yaw", "pitch", "roll", "climb"]
    }

    fn command_of(&self, controls: &[f64]) -> Command {
        Command::Attitude {
            yaw_rate: self.dynamics.yaw_rate * control(controls, 0),
            pitch: self.dynamics.tilt * control(controls, 1),
            roll: self.dynamics.tilt * control(controls, 2),
            gaz: self.dynamics.climb * control(controls, 3),
        }
    }

    /// On the floor it is landed, above it hovers.
    fn at_rest(&self, pose: Pose) -> State {
        let Point { x, y, z } = pose.position;
        let mode = if z > 0.0 {
            mode::HOVERING
        } else {
            mode::LANDED
        };
        State {
            pose: Pose::level(pose.position, pose.yaw),
            mode,
            memory: [x, y],
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
        let command = if self.accepts(command) {
            *command
        } else {
            Command::Stop
        };
        self.dynamics
            .advance(state, &command, disturbance, elapsed.seconds())
    }

    fn track(&self, tracking: &mut Tracking, estimate: &Estimate, goal: &Goal) -> Command {
        self.gains.track(tracking, estimate, goal)
    }

    fn rest(&self, tracking: &mut Tracking, estimate: &Estimate) -> Command {
        self.gains.rest(tracking, estimate)
    }

    fn is_overpowered(&self, tracking: &Tracking) -> bool {
        Gains::is_overpowered(tracking)
    }

    /// A drone that hits something holds that place rather than push.
    fn stop_at(&self, predicted: &mut State, place: Point) {
        predicted.pose.position = place;
        predicted.twist.linear = Point::ZERO;
        predicted.memory = [place.x, place.y];
    }
}
