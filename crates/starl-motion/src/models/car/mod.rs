//! A car: the kinematic bicycle, with a smallest turning radius and bounded acceleration and steering.
//!
//! The pose is that of the point midway between the axles. With wheels that roll without slipping at
//! steering angle d, that point moves at the slip angle b = atan(tan(d) / 2) from the heading, and the
//! heading turns at v cos(b) tan(d) / wheelbase (Kong et al. 2015, "Kinematic and dynamic vehicle models
//! for autonomous driving control design"). While the steering angle rests the path is an arc and is
//! integrated exactly; while it moves, by the classical Runge-Kutta method between the moments at
//! which speed or steering reach what is commanded.
//!
//! Invariant: speed, steering angle and their rates keep to their limits. Commands: `Steer`, `Stop`.
//! `State::memory` holds the speed (m/s, backwards negative) and the steering angle (rad).
//!
//! Defaults are those of F1TENTH cars, tenth-scale research cars (O'Kelly et al. 2020, "F1TENTH: an
//! open-source evaluation environment for continuous control and reinforcement learning"), but for
//! speed and acceleration, which are for a laboratory: the real one reaches 20 m/s at 9.5 m/s2.

mod bicycle;

use super::{Parameterised, unicycle};
use crate::model::control;
use crate::parameters::{Field, ParameterError, ParameterSet, ordered, parameters};
use crate::tracking::car::Gains;
use crate::tracking::{Goal, Tracking};
use crate::{Disturbance, Limits, Model, State};
use alloc::vec::Vec;
use bicycle::{Course, Ramp, course};
use starl_core::math::{cos, fabs, radians, sin, sqrt};
use starl_core::motion::{Body, Estimate, Workspace};
use starl_core::{Command, Duration, Point, Pose, Twist};

/// The model's name.
pub(super) const NAME: &str = "car";

parameters! {
    /// The parameters of a [`Car`].
    pub struct CarParameters {
        /// Radius of the circle around the body, which is 0.58 m by 0.31 m.
        radius: "m" = 0.33, 0.01 => 10.0;
        /// Height of the body.
        height: "m" = 0.2, 0.01 => 10.0;
        /// Distance between the axles.
        wheelbase: "m" = 0.33, 0.01 => 10.0;
        /// Greatest angle of the front wheels.
        steering_angle: "degrees" = 24.0, 1.0 => 80.0;
        /// Greatest rate of the front wheels' angle.
        steering_rate: "degrees/s" = 183.0, 1.0 => 10000.0;
        /// Greatest speed, forwards and backwards.
        speed: "m/s" = 1.5, 0.01 => 100.0;
        /// Greatest rate of change of the speed.
        acceleration: "m/s2" = 2.5, 0.01 => 100.0;
        /// Speed of travel while tracking.
        cruise_speed: "m/s" = 1.0, 0.01 => 100.0;
    }
}

/// The longest step of integration while the steering angle moves, seconds.
const LONGEST_STEP: f64 = 0.02;

/// A car.
#[derive(Clone, Debug)]
pub struct Car {
    parameters: CarParameters,
    steering_angle: f64,
    steering_rate: f64,
    gains: Gains,
}

impl Car {
    /// A car with these parameters.
    ///
    /// # Errors
    /// If a parameter is out of its range or the cruise speed exceeds the greatest speed.
    pub fn new(parameters: CarParameters) -> Result<Car, ParameterError> {
        parameters.check_ranges()?;
        let CarParameters {
            wheelbase,
            speed,
            cruise_speed,
            acceleration,
            ..
        } = parameters;
        ordered(("cruise_speed", cruise_speed), ("speed", speed))?;
        let steering_angle = radians(parameters.steering_angle);
        let steering_rate = radians(parameters.steering_rate);
        let gains = Gains {
            wheelbase,
            steering_angle,
            cruise_speed,
            acceleration,
        };
        Ok(Car {
            parameters,
            steering_angle,
            steering_rate,
            gains,
        })
    }
}

/// Seconds until `value` reaches `wanted` at `rate`.
fn time_to(value: f64, wanted: f64, rate: f64) -> f64 {
    fabs(wanted - value) / rate
}

/// `value` after moving towards `wanted` for `seconds` at `rate`.
fn towards(value: f64, wanted: f64, rate: f64, seconds: f64) -> f64 {
    let most = rate * seconds;
    // A rest as small as a rounding error counts as zero.
    if fabs(wanted - value) <= most * (1.0 + 1e-12) {
        return wanted;
    }
    if wanted > value {
        value + most
    } else {
        value - most
    }
}

impl Default for Car {
    fn default() -> Car {
        Car::new(CarParameters::default()).expect("the defaults are in their ranges")
    }
}

impl Parameterised for Car {
    type Parameters = CarParameters;

    fn build(parameters: CarParameters) -> Result<Car, ParameterError> {
        Car::new(parameters)
    }
}

impl Model for Car {
    fn name(&self) -> &'static str {
        NAME
    }

    fn parameters(&self) -> Vec<(Field, f64)> {
        self.parameters.changed()
    }

    fn body(&self) -> Body {
        let CarParameters { radius, height, .. } = self.parameters;
        Body {
            radius,
            height,
            workspace: Workspace::Ground,
        }
    }

    fn limits(&self) -> Limits {
        let CarParameters {
            speed,
            cruise_speed,
            acceleration,
            wheelbase,
            ..
        } = self.parameters;
        let Course { slip, curvature } = course(wheelbase, self.steering_angle);
        // The velocity turns with the heading and, while steering, with the slip angle, which
        // changes at most half as fast as tan(steering angle).
        let steepness = cos(self.steering_angle);
        let turning = speed * curvature + 0.5 * self.steering_rate / (steepness * steepness);
        let sideways = speed * turning;
        Limits {
            speed,
            cruise_speed,
            vertical_speed: 0.0,
            acceleration: sqrt(acceleration * acceleration + sideways * sideways),
            turn_rate: speed * curvature,
            turn_radius: 0.5 * wheelbase / sin(slip),
            stopping_distance: self.gains.stopping_distance(),
        }
    }

    fn accepts(&self, command: &Command) -> bool {
        match *command {
            Command::Stop => true,
            Command::Steer { speed, angle } => speed.is_finite() && angle.is_finite(),
            _ => false,
        }
    }

    fn controls(&self) -> &'static [&'static str] {
        &["speed", "steering angle"]
    }

    fn command_of(&self, controls: &[f64]) -> Command {
        Command::Steer {
            speed: self.parameters.speed * control(controls, 0),
            angle: self.steering_angle * control(controls, 1),
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
        let limits = &self.parameters;
        let [mut speed, mut angle] = state.memory;
        let (wanted_speed, wanted_angle) = match *command {
            Command::Steer { speed, angle } if self.accepts(command) => {
                let speed = speed * (1.0 + disturbance.speed_error);
                let angle = angle * (1.0 + disturbance.turn_error);
                (
                    speed.clamp(-limits.speed, limits.speed),
                    angle.clamp(-self.steering_angle, self.steering_angle),
                )
            }
            _ => (0.0, angle),
        };
        let mut pose = state.pose;
        let mut left = elapsed.seconds();
        while left > 0.0 {
            let mut step = left;
            let speeding = time_to(speed, wanted_speed, limits.acceleration);
            let steering = time_to(angle, wanted_angle, self.steering_rate);
            if speeding > 0.0 {
                step = step.min(speeding);
            }
            if steering > 0.0 {
                step = step.min(steering).min(LONGEST_STEP);
            }
            let next_speed = towards(speed, wanted_speed, limits.acceleration, step);
            let next_angle = towards(angle, wanted_angle, self.steering_rate, step);
            let (speeds, angles) = (
                Ramp {
                    from: speed,
                    to: next_speed,
                },
                Ramp {
                    from: angle,
                    to: next_angle,
                },
            );
            pose = bicycle::roll(limits.wheelbase, &pose, speeds, angles, step);
            (speed, angle) = (next_speed, next_angle);
            left -= step;
        }
        let Course { slip, curvature } = course(limits.wheelbase, angle);
        let twist = Twist {
            linear: Point::polar(speed, pose.yaw + slip),
            yaw: speed * curvature,
            ..Twist::default()
        };
        State {
            pose,
            twist,
            memory: [speed, angle],
            ..*state
        }
    }

    fn track(&self, tracking: &mut Tracking, estimate: &Estimate, goal: &Goal) -> Command {
        self.gains.track(tracking, estimate, goal)
    }

    /// A car that hits something stands, its wheels as they are.
    fn stop_at(&self, predicted: &mut State, place: Point) {
        predicted.pose.position = place;
        predicted.twist = Twist::default();
        predicted.memory[0] = 0.0;
    }
}
