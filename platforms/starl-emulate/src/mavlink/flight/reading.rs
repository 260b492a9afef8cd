//! Set-points in MAVLink's messages.

use crate::control::SetPoint;
use starl_core::math::sincos;
use starl_core::{Point, Pose};
use starl_mavlink::common::{
    MavFrame, PositionTargetTypemask as Mask, SET_POSITION_TARGET_LOCAL_NED_DATA,
};

/// Reads a message; `None` if its frame is unknown, a number is NaN, or it commands nothing.
pub(super) fn read(
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
        MavFrame::MAV_FRAME_LOCAL_OFFSET_NED => (false, position.map(|point| point + now.position)),
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
