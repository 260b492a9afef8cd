//! What a node is told with each call: what the robot is made of, and what it knows at the moment.

use alloc::sync::Arc;
use starl_core::motion::{Body, Obstacles};
use starl_core::{Duration, RobotId, Sensors, WayPoint};
use starl_motion::{Model, avoidance};

/// What robots of one kind have in common.
#[derive(Clone)]
pub struct Hardware {
    /// The space that the robot takes.
    pub body: Body,
    /// How often the program is activated; never if zero.
    pub control_period: Duration,
    /// What the motion layer drives; none where the host takes the robot to way-points itself
    /// ([`crate::Outlet::request_motion`]).
    pub drive: Option<Drive>,
}

/// What the node's motion layer drives.
#[derive(Clone)]
pub struct Drive {
    /// The robot's dynamics and limits.
    pub model: Arc<dyn Model>,
    /// How the robot keeps clear of others; it does not where there are no options.
    pub avoidance: Option<avoidance::Options>,
    /// Standard deviation of positions, metres: planned paths keep at least four times as much away from
    /// obstacles where they can.
    pub position_error: f64,
    /// Seeds the random choices of avoidance.
    pub seed: u64,
}

/// What a robot knows at one moment beyond what its node keeps.
#[derive(Clone, Copy)]
pub struct Snapshot<'a> {
    /// What the robot is made of.
    pub hardware: &'a Hardware,
    /// Current readings.
    pub sensors: Sensors<'a>,
    /// All robots of the application, this one too, in the order of their numbers.
    pub fleet: &'a [RobotId],
    /// The application's way-points.
    pub way_points: &'a [WayPoint],
    /// The obstacles that this robot knows.
    pub obstacles: &'a Obstacles,
}
