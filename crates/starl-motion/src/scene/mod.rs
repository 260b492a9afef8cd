//! The bodies and obstacles of a world, with indexes of both.

mod grid;

pub use grid::{Entry, Grid};

use crate::Neighbour;
use starl_core::geometry::ObstacleIndex;

/// The world that bodies touch and rays meet.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// All bodies.
    pub bodies: &'a [Neighbour],
    /// An index of them.
    pub grid: &'a Grid,
    /// The obstacles.
    pub map: &'a ObstacleIndex,
}
