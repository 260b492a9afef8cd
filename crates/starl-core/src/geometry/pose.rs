//! Where a robot is and how it moves.

use super::Point;
use crate::math;
use serde::{Deserialize, Serialize};

/// Position and attitude in the world frame. Angles are intrinsic yaw (about z), pitch (about y),
/// roll (about x), radians; a ground robot uses yaw alone, its heading.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Centre of the body's base, metres.
    pub position: Point,
    /// Heading, radians from the x axis, left positive.
    pub yaw: f64,
    /// Nose-down angle, radians.
    pub pitch: f64,
    /// Right-side-down angle, radians.
    pub roll: f64,
}

impl Pose {
    /// A level pose.
    pub const fn level(position: Point, yaw: f64) -> Pose {
        Pose {
            position,
            yaw,
            pitch: 0.0,
            roll: 0.0,
        }
    }

    /// The pose with the attitude of a quaternion x, y, z, w of any length; `None` where a number is not finite or the
    /// quaternion is too short to mean a direction.
    pub fn of_quaternion(position: Point, quaternion: [f64; 4]) -> Option<Pose> {
        let squared: f64 = quaternion.iter().map(|part| part * part).sum();
        let length = math::sqrt(squared);
        if !position.is_finite() || !length.is_finite() || length < 0.5 {
            return None;
        }
        let [i, j, k, w] = quaternion.map(|part| part / length);
        // Yaw, pitch and roll of R = Rz(yaw) Ry(pitch) Rx(roll).
        let pitch = math::asin((2.0 * (w * j - k * i)).clamp(-1.0, 1.0));
        let (ahead, left) = (1.0 - 2.0 * (j * j + k * k), 2.0 * (w * k + i * j));
        // Straight up or down, yaw and roll turn about the same axis, and all of it counts as yaw.
        let (yaw, roll) = match ahead.abs().max(left.abs()) < 1e-6 {
            true => (math::wrap_angle(2.0 * math::atan2(k, w)), 0.0),
            false => {
                let roll = math::atan2(2.0 * (w * i + j * k), 1.0 - 2.0 * (i * i + j * j));
                (math::atan2(left, ahead), roll)
            }
        };
        Some(Pose {
            position,
            yaw,
            pitch,
            roll,
        })
    }

    /// The attitude as a unit quaternion x, y, z, w.
    pub fn quaternion(&self) -> [f64; 4] {
        let half = |angle: f64| math::sincos(0.5 * angle);
        let ((sy, cy), (sp, cp), (sr, cr)) = (half(self.yaw), half(self.pitch), half(self.roll));
        [
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
            cr * cp * cy + sr * sp * sy,
        ]
    }
}

/// Rates of change of a [`Pose`] in the world frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Twist {
    /// Velocity, metres per second.
    pub linear: Point,
    /// Rate of yaw, radians per second.
    pub yaw: f64,
    /// Rate of pitch, radians per second.
    pub pitch: f64,
    /// Rate of roll, radians per second.
    pub roll: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quaternions_and_angles_are_the_same_attitude() {
        let pose = Pose {
            position: Point::new(1.0, -2.0, 0.5),
            yaw: 2.5,
            pitch: -0.7,
            roll: 0.3,
        };
        let twice = pose.quaternion().map(|part| 2.0 * part);
        let back = Pose::of_quaternion(pose.position, twice).unwrap();
        for (is, was) in [
            (back.yaw, pose.yaw),
            (back.pitch, pose.pitch),
            (back.roll, pose.roll),
        ] {
            assert!((is - was).abs() < 1e-12, "{back:?}");
        }
        assert_eq!(Pose::of_quaternion(Point::ZERO, [0.0; 4]), None);
        let nan = [0.0, 0.0, f64::NAN, 1.0];
        assert_eq!(Pose::of_quaternion(Point::ZERO, nan), None);
    }

    #[test]
    fn attitudes_that_point_straight_up_or_down_come_back_by_other_angles() {
        for pitch in [-core::f64::consts::FRAC_PI_2, core::f64::consts::FRAC_PI_2] {
            for (yaw, roll) in [
                (0.0, 0.0),
                (1.0, 0.5),
                (-1.570_797_297, -1.570_797_297),
                (3.0, -3.0),
            ] {
                let pose = Pose {
                    position: Point::ZERO,
                    yaw,
                    pitch,
                    roll,
                };
                let back = Pose::of_quaternion(Point::ZERO, pose.quaternion()).unwrap();
                let pairs = pose.quaternion().into_iter().zip(back.quaternion());
                let alike = pairs.map(|(one, two)| one * two).sum::<f64>().abs();
                assert!(
                    (alike - 1.0).abs() < 1e-12,
                    "{pose:?} came back as {back:?}"
                );
            }
        }
    }
}
