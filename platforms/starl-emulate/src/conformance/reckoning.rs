//! Dead reckoning from a device's readings alone.

use starl_core::math::{sincos, wrap_angle};
use starl_core::{Point, Pose};
use starl_node::Reading;
use std::time::Instant;

/// Where the readings say that the robot is, if it began at a known pose.
pub(super) struct Reckoning {
    pose: Pose,
    /// The device's zero of heading, measured from the world's.
    zero: Option<f64>,
    /// The velocity of the last reading, world frame, and when it came.
    velocity: Option<(Point, Instant)>,
}

impl Reckoning {
    pub fn new(pose: Pose) -> Reckoning {
        Reckoning {
            pose,
            zero: None,
            velocity: None,
        }
    }

    pub fn take(&mut self, reading: &Reading) {
        if let Some(moved) = reading.moved {
            self.pose.position += self.in_world(moved);
        }
        if let Some(turned) = reading.turned {
            self.pose.yaw = wrap_angle(self.pose.yaw + turned);
        }
        if let Some(heading) = reading.heading {
            let zero = *self.zero.get_or_insert(self.pose.yaw - heading);
            self.pose.yaw = wrap_angle(zero + heading);
        }
        if let (Some(velocity), None) = (reading.velocity, reading.moved) {
            let now = Instant::now();
            let velocity = self.in_world(velocity);
            if let Some((before, at)) = self.velocity.replace((velocity, now)) {
                let seconds = (now - at).as_secs_f64();
                self.pose.position += (before + velocity) * (0.5 * seconds);
            }
        }
    }

    pub fn pose(&self) -> Pose {
        self.pose
    }

    fn in_world(&self, vector: Point) -> Point {
        let (sin, cos) = sincos(self.pose.yaw);
        Point::new(
            cos * vector.x - sin * vector.y,
            sin * vector.x + cos * vector.y,
            vector.z,
        )
    }
}
