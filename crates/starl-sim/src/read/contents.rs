//! The contents of the world while a scenario is read.

use super::Placed;
use crate::scenario::{Bounds, Thing, WorldObstacle};
use starl_core::{Pose, WayPoint};

/// The contents of the world, with the place of each for later checks.
#[derive(Default)]
pub(super) struct Contents {
    pub bounds: Option<Placed<Bounds>>,
    pub start_area: Option<Placed<Bounds>>,
    pub obstacles: Vec<WorldObstacle>,
    pub way_points: Vec<Placed<WayPoint>>,
    pub things: Vec<Placed<Thing>>,
    /// Starts of robots by name, from world files.
    pub starts: Vec<Placed<(String, Pose)>>,
}
