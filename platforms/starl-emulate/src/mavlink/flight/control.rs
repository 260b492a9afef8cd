//! From set-points to attitudes: cascaded loops from position to velocity to acceleration to tilt, as in the real
//! software, with a gain for each.

use starl_core::math::{sincos, wrap_angle};
use starl_core::{Command, Point, Pose};
use starl_mavlink::common::{
    MavFrame, PositionTargetTypemask as Mask, SET_POSITION_TARGET_LOCAL_NED_DATA,
};
use starl_motion::State;

/// Velocity per error of position, 1/s, and acceleration per error of velocity, 1/s: PX4's `MPC_XY_P` and
/// `MPC_XY_VEL_P_ACC`.
const POSITION_GAIN: f64 = 0.95;
const VELOCITY_GAIN: f64 = 1.8;
/// Rate of turn per error of yaw, 1/s.
const YAW_GAIN: f64 = 2.0;
/// What drag takes from the velocity, 1/s: what the integral part of a real loop learns.
const DRAG: f64 = 0.3 / 0.42;
/// Greatest speed to a position, metres per second.
const SPEED: f64 = 1.5;
const GRAVITY: f64 = 9.80665;

/// What a computer has asked for, in the world's frame; what it left out is `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct SetPoint {
    position: Option<Point>,
    velocity: Option<Point>,
    /// The velocity turns with the vehicle.
    body: bool,
    yaw: Option<f64>,
    yaw_rate: Option<f64>,
}

impl SetPoint {
    /// Climbs by this height, in place.
    pub fn climb(height: f64) -> SetPoint {
        SetPoint {
            velocity: Some(Point::new(0.0, 0.0, height.clamp(-0.7, 0.7))),
            ..SetPoint::default()
        }
    }

    /// Reads a message; `None` if its frame is not known here, a number is none, or it asks for nothing.
    pub fn read(
        data: &SET_POSITION_TARGET_LOCAL_NED_DATA,
        now: &Pose,
        home: &Pose,
    ) -> Option<SetPoint> {
        let has = |bits: Mask| !data.type_mask.intersects(bits);
        let up = |values: [f32; 3]| {
            let [x, y, z] = values.map(f64::from);
            let point = Point::new(x, -y, -z);
            point.is_finite().then_some(point)
        };
        let in_world = |point: Point| {
            let (sin, cos) = sincos(now.yaw);
            Point::new(
                cos * point.x - sin * point.y,
                sin * point.x + cos * point.y,
                point.z,
            )
        };
        let position = Mask::POSITION_TARGET_TYPEMASK_X_IGNORE
            | Mask::POSITION_TARGET_TYPEMASK_Y_IGNORE
            | Mask::POSITION_TARGET_TYPEMASK_Z_IGNORE;
        let velocity = Mask::POSITION_TARGET_TYPEMASK_VX_IGNORE
            | Mask::POSITION_TARGET_TYPEMASK_VY_IGNORE
            | Mask::POSITION_TARGET_TYPEMASK_VZ_IGNORE;
        let position = match has(position) {
            true => Some(up([data.x, data.y, data.z])?),
            false => None,
        };
        let velocity = match has(velocity) {
            true => Some(up([data.vx, data.vy, data.vz])?),
            false => None,
        };
        // Older names of the frames are what computers send.
        #[allow(deprecated)]
        let (body, position) = match data.coordinate_frame {
            MavFrame::MAV_FRAME_LOCAL_NED => (false, position.map(|point| point + home.position)),
            MavFrame::MAV_FRAME_LOCAL_OFFSET_NED => {
                (false, position.map(|point| point + now.position))
            }
            MavFrame::MAV_FRAME_BODY_NED => (true, position.map(|point| point + home.position)),
            MavFrame::MAV_FRAME_BODY_OFFSET_NED | MavFrame::MAV_FRAME_BODY_FRD => {
                (true, position.map(|point| in_world(point) + now.position))
            }
            _ => return None,
        };
        let angle = |bit, value: f32| {
            let value = -f64::from(value);
            (has(bit) && value.is_finite()).then_some(value)
        };
        let set_point = SetPoint {
            position,
            velocity,
            body,
            yaw: angle(Mask::POSITION_TARGET_TYPEMASK_YAW_IGNORE, data.yaw),
            yaw_rate: angle(
                Mask::POSITION_TARGET_TYPEMASK_YAW_RATE_IGNORE,
                data.yaw_rate,
            ),
        };
        let asks = set_point.position.is_some() || set_point.velocity.is_some();
        asks.then_some(set_point)
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
