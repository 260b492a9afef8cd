//! The geometry of a car that rolls without slipping, and its path while it steers.
//!
//! The point midway between the axles moves at the slip angle b = atan(tan(d) / 2) from the heading
//! when the front wheels stand at angle d, and the heading turns at v cos(b) tan(d) / wheelbase.

use super::unicycle;
use starl_core::math::{atan, sincos, sqrt, tan, wrap_angle};
use starl_core::{Point, Pose};

/// The car's motion for an angle of the wheels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    /// Angle from the heading to the velocity of the centre, radians.
    pub slip: f64,
    /// Rate of turn per speed of the centre, 1/m.
    pub curvature: f64,
}

/// The course at a steering angle (radians) of a car with this wheelbase (metres).
pub(super) fn course(wheelbase: f64, angle: f64) -> Course {
    if angle == 0.0 {
        return Course {
            slip: 0.0,
            curvature: 0.0,
        };
    }
    let slope = tan(angle);
    // cos(atan(s)) is 1 / sqrt(1 + s^2).
    let half = 0.5 * slope;
    Course {
        slip: atan(half),
        curvature: slope / (wheelbase * sqrt(1.0 + half * half)),
    }
}

/// A quantity that changes evenly during a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ramp {
    pub from: f64,
    pub to: f64,
}

impl Ramp {
    fn at(self, part: f64) -> f64 {
        self.from + part * (self.to - self.from)
    }
}

/// The pose after `seconds` in which speed and steering angle change so.
pub(super) fn roll(wheelbase: f64, pose: &Pose, speed: Ramp, angle: Ramp, seconds: f64) -> Pose {
    if angle.from == angle.to {
        // The path is an arc whatever the speed does: only its length matters.
        let Course { slip, curvature } = course(wheelbase, angle.to);
        let mean = speed.at(0.5);
        return unicycle::advance(pose, slip, mean, mean * curvature, seconds).0;
    }
    let slope = |part: f64, yaw: f64| {
        let speed = speed.at(part);
        let Course { slip, curvature } = course(wheelbase, angle.at(part));
        let (sin, cos) = sincos(yaw + slip);
        [speed * cos, speed * sin, speed * curvature]
    };
    let first = slope(0.0, pose.yaw);
    let second = slope(0.5, pose.yaw + 0.5 * seconds * first[2]);
    let third = slope(0.5, pose.yaw + 0.5 * seconds * second[2]);
    let fourth = slope(1.0, pose.yaw + seconds * third[2]);
    let [x, y, yaw] = [0, 1, 2]
        .map(|i| seconds / 6.0 * (first[i] + 2.0 * second[i] + 2.0 * third[i] + fourth[i]));
    let position = pose.position + Point::planar(x, y);
    Pose {
        position,
        yaw: wrap_angle(pose.yaw + yaw),
        ..*pose
    }
}
