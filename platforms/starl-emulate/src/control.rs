//! From set-points to attitudes: cascaded loops from position to velocity to acceleration to tilt, as in the software of
//! autopilots, with a gain for each.

use crate::BodyHandle;
use starl_core::math::{sincos, wrap_angle};
use starl_core::{Command, Point};
use starl_motion::State;
use starl_motion::models::drone_mode;

/// Velocity per error of position, 1/s, and acceleration per error of velocity, 1/s: PX4's `MPC_XY_P` and
/// `MPC_XY_VEL_P_ACC`.
const POSITION_GAIN: f64 = 0.95;
const VELOCITY_GAIN: f64 = 1.8;
/// Rate of turn per error of yaw, 1/s.
const YAW_GAIN: f64 = 2.0;
/// Drag per mass, 1/s. A real loop learns it by its integral part.
const DRAG: f64 = 0.3 / 0.42;
/// Greatest speed to a position, metres per second.
const SPEED: f64 = 1.5;
const GRAVITY: f64 = 9.80665;

/// The motion that a computer has asked for, in the world's frame. A part that it left out is `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct SetPoint {
    pub position: Option<Point>,
    pub velocity: Option<Point>,
    /// Whether the velocity turns with the vehicle.
    pub body: bool,
    pub yaw: Option<f64>,
    pub yaw_rate: Option<f64>,
}

impl SetPoint {
    /// Climbs by this height, in place.
    pub fn climb(height: f64) -> SetPoint {
        SetPoint {
            velocity: Some(Point::new(0.0, 0.0, height.clamp(-0.7, 0.7))),
            ..SetPoint::default()
        }
    }

    /// The command that follows the set-point from a state.
    pub fn command(&self, state: &State) -> Command {
        let (sin, cos) = sincos(state.pose.yaw);
        let mut wanted = self.velocity.unwrap_or(Point::ZERO);
        if self.body {
            wanted = Point::new(
                cos * wanted.x - sin * wanted.y,
                sin * wanted.x + cos * wanted.y,
                wanted.z,
            );
        }
        if let Some(target) = self.position {
            let to = (target - state.pose.position) * POSITION_GAIN;
            let length = to.length();
            wanted += to * (SPEED / length.max(SPEED));
        }
        let error = wanted - state.twist.linear;
        let push = error * (VELOCITY_GAIN / GRAVITY) + wanted * (DRAG / GRAVITY);
        let yaw_rate = match (self.yaw, self.yaw_rate) {
            (Some(yaw), _) => YAW_GAIN * wrap_angle(yaw - state.pose.yaw),
            (None, rate) => rate.unwrap_or(0.0),
        };
        Command::Attitude {
            yaw_rate,
            pitch: cos * push.x + sin * push.y,
            roll: sin * push.x - cos * push.y,
            gaz: wanted.z,
        }
    }
}

/// Makes a body follow the attitude; a body on the ground takes off if it is commanded to rise.
pub(crate) fn fly(body: &BodyHandle, command: Command) {
    let rising = matches!(command, Command::Attitude { gaz, .. } if gaz > 0.05);
    if body.state().mode != drone_mode::LANDED {
        body.command(command);
    } else if rising {
        body.command(Command::TakeOff);
    }
}
