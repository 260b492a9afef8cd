//! Poses in Foxglove's schemas.

use super::{RobotView, WORLD};
use crate::json::Json;
use starl_core::{Pose, Time, math};

/// Writes a `foxglove.PoseInFrame`.
pub fn in_frame(json: &mut Json, at: Time, pose: &Pose) {
    json.clear();
    json.raw("{\"timestamp\":").time(at);
    json.key("frame_id").string(WORLD);
    json.raw(",\"pose\":{\"position\":")
        .rounded_point(pose.position);
    json.raw(",\"orientation\":");
    orientation(json, pose);
    json.raw("}}");
}

/// Writes a `foxglove.FrameTransforms` with the frames of all robots seen so far.
pub fn frames(json: &mut Json, at: Time, robots: &[RobotView]) {
    json.clear();
    json.raw("{\"transforms\":[");
    for robot in robots {
        let Some(pose) = robot.pose.pose else {
            continue;
        };
        json.item().raw("{\"timestamp\":").time(at);
        json.key("parent_frame_id").string(WORLD);
        json.key("child_frame_id").string(&robot.name);
        json.raw(",\"translation\":").rounded_point(pose.position);
        json.raw(",\"rotation\":");
        orientation(json, &pose);
        json.mark(b'}');
    }
    json.raw("]}");
}

/// Writes a pose's attitude as a quaternion: yaw about z, then pitch about the new y, then roll about
/// the new x.
fn orientation(json: &mut Json, pose: &Pose) {
    let half = |angle: f64| {
        if angle == 0.0 {
            (0.0, 1.0)
        } else {
            math::sincos(angle / 2.0)
        }
    };
    let (yaw_sin, yaw_cos) = half(pose.yaw);
    let (pitch_sin, pitch_cos) = half(pose.pitch);
    let (roll_sin, roll_cos) = half(pose.roll);
    json.raw("{\"x\":")
        .rounded(roll_sin * pitch_cos * yaw_cos - roll_cos * pitch_sin * yaw_sin);
    json.raw(",\"y\":")
        .rounded(roll_cos * pitch_sin * yaw_cos + roll_sin * pitch_cos * yaw_sin);
    json.raw(",\"z\":")
        .rounded(roll_cos * pitch_cos * yaw_sin - roll_sin * pitch_sin * yaw_cos);
    json.raw(",\"w\":")
        .rounded(roll_cos * pitch_cos * yaw_cos + roll_sin * pitch_sin * yaw_sin);
    json.mark(b'}');
}
