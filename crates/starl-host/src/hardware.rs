//! The arguments of each call of a node: the robot's hardware, and its current knowledge.

use alloc::sync::Arc;
use starl_core::motion::{Body, Obstacles};
use starl_core::{Duration, RobotId, Sensors, WayPoint};
use starl_motion::{Model, avoidance};

/// The common properties of robots of one kind.
#[derive(Clone)]
pub struct Hardware {
    /// The space that the robot takes.
    pub body: Body,
    /// How often the program is activated; never if zero.
    pub control_period: Duration,
    /// The model that the motion layer drives; none if the host takes the robot to waypoints itself
    /// ([`crate::Outlet::request_motion`]).
    pub drive: Option<Drive>,
}

/// The model that the node's motion layer drives, with its options.
#[derive(Clone)]
pub struct Drive {
    /// The robot's dynamics and limits.
    pub model: Arc<dyn Model>,
    /// The robot's avoidance of others; no avoidance if none.
    pub avoidance: Option<avoidance::Options>,
    /// Standard deviation of positions, metres: planned paths keep at least four times as much away from
    /// obstacles where they can.
    pub position_error: f64,
    /// Seeds the random choices of avoidance.
    pub seed: u64,
}

/// A robot's current knowledge beyond the state that its node keeps.
#[derive(Clone, Copy)]
pub struct Snapshot<'a> {
    /// The robot's hardware.
    pub hardware: &'a Hardware,
    /// Current readings.
    pub sensors: Sensors<'a>,
    /// All robots of the application, this one too, in the order of their numbers.
    pub fleet: &'a [RobotId],
    /// The application's waypoints.
    pub way_points: &'a [WayPoint],
    /// The obstacles that this robot knows.
    pub obstacles: &'a Obstacles,
}
