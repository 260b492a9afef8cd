//! Where a robot is and how it moves.

use super::Point;
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
