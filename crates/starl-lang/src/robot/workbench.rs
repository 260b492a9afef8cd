//! Caches that are kept between activations, shared by all robots that take turns on one thread.
//!
//! Invariant: the caches do not change what a program does. Registers are empty when an activation begins, and a cached
//! value is reused only where a new one would be equal.

use crate::machine::{List, Object, Workspace};
use alloc::vec::Vec;
use starl_core::{Point, RobotId, WayPoint};

/// Registers, and values that were made before.
#[derive(Clone, Default)]
pub struct Workbench {
    pub workspace: Workspace,
    pub memo: Memo,
}

/// Values shared by the robots of one fleet, created once.
#[derive(Clone, Default)]
pub struct Memo {
    way_points: Object,
    fleet: Object,
}

impl Memo {
    /// The positions of the waypoints as a list.
    pub fn way_points(&mut self, way_points: &[WayPoint]) -> Object {
        let places = way_points.iter().map(|way_point| way_point.position);
        let bits = |p: Point| [p.x, p.y, p.z].map(f64::to_bits);
        if !holds(&self.way_points, places.clone().flat_map(bits)) {
            self.way_points = List::of_points(&places.collect::<Vec<_>>()).into();
        }
        self.way_points.clone()
    }

    /// The robots of the fleet, which are in ascending order, as a set.
    pub fn fleet(&mut self, fleet: &[RobotId]) -> Object {
        if !holds(&self.fleet, fleet.iter().map(|robot| u64::from(robot.0))) {
            self.fleet = robots(fleet.iter().copied());
        }
        self.fleet.clone()
    }
}

/// Whether a list, or a set, holds these scalars.
fn holds(object: &Object, scalars: impl Iterator<Item = u64>) -> bool {
    let known = object.list().map_or(&[][..], List::scalars);
    scalars.eq(known.iter().copied())
}

/// A list of robots; a set, if they are in ascending order.
pub fn robots(robots: impl IntoIterator<Item = RobotId>) -> Object {
    let numbers = robots.into_iter().map(|robot| u64::from(robot.0));
    List::of_scalars(numbers.collect()).into()
}
