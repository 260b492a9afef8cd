//! The wheels of an emulated robot: velocities in, odometry out.

use crate::{BodyHandle, Odometer};
use starl_core::math::{sincos, wrap_angle};
use starl_core::{Command, Point, Pose};
use starl_ros2::message::Twist;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// The wheels stop when no velocity has come for so long.
const WATCHDOG: Duration = Duration::from_millis(500);

#[derive(Debug)]
pub(super) struct Wheels {
    body: BodyHandle,
    driven: Option<Instant>,
    counted: Odometer,
    /// By the wheels alone, from where the robot was switched on.
    odometry: Pose,
}

impl Wheels {
    pub fn new(body: BodyHandle) -> Wheels {
        Wheels {
            driven: None,
            counted: body.odometer(),
            odometry: Pose::default(),
            body,
        }
    }

    /// Drives at this velocity. One that makes no sense is left out.
    pub fn drive(&mut self, twist: &Twist) {
        let (ahead, turn) = (twist.linear.x, twist.angular.z);
        if !(ahead.is_finite() && turn.is_finite()) {
            return;
        }
        let limits = self.body.model().limits();
        let half_axle = limits.speed / limits.turn_rate;
        self.driven = Some(Instant::now());
        self.body.command(Command::Wheels {
            left: ahead - turn * half_axle,
            right: ahead + turn * half_axle,
        });
    }

    pub fn halt(&mut self) {
        self.driven = None;
        self.body.command(Command::Stop);
    }

    /// Looks what the wheels have done: odometry, and the velocity in the robot's frame.
    pub fn turn(&mut self) -> (Pose, Twist) {
        if self.driven.is_some_and(|at| at.elapsed() > WATCHDOG) {
            self.halt();
        }
        let now = self.body.odometer();
        let before = std::mem::replace(&mut self.counted, now);
        let (driven, turned) = (now.distance - before.distance, now.turn - before.turn);
        // Along an arc, whose chord leads half of the turn away from the heading.
        let (sin, cos) = sincos(self.odometry.yaw + 0.5 * turned);
        self.odometry.position += Point::planar(driven * cos, driven * sin);
        self.odometry.yaw = wrap_angle(self.odometry.yaw + turned);
        let state = self.body.state();
        let (sin, cos) = sincos(state.pose.yaw);
        let ahead = state.twist.linear.dot(Point::planar(cos, sin));
        let velocity = Twist {
            linear: Point::planar(ahead, 0.0),
            angular: Point::new(0.0, 0.0, state.twist.yaw),
        };
        (self.odometry, velocity)
    }
}

pub(super) fn lock<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}
