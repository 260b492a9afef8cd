//! Random places that are free: for robots to start at, and to go to.

use starl_core::geometry::ObstacleIndex;
use starl_core::{Point, Random};
use thiserror::Error;

/// Where to look for places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// The corner with the least coordinates, metres.
    pub low: Point,
    /// The corner with the greatest coordinates, metres.
    pub high: Point,
    /// The least distance of a place from obstacles, metres.
    pub clearance: f64,
    /// The height of the body for which places are free, metres.
    pub height: f64,
    /// The least distance between places in the plane, metres.
    pub gap: f64,
}

/// A region has no room for all places.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "only {found} of {wanted} free places found in {TRIES} tries each; use a larger region or a smaller gap"
)]
pub struct NoRoom {
    /// How many places were found.
    pub found: usize,
    /// How many there should be.
    pub wanted: usize,
}

/// How often a place is drawn before the region counts as full.
const TRIES: usize = 2000;

/// Draws places one after another.
pub fn scatter(
    random: &mut Random,
    map: &ObstacleIndex,
    region: &Region,
    places: &mut [Point],
) -> Result<(), NoRoom> {
    let Region { low, high, .. } = *region;
    for index in 0..places.len() {
        let (before, rest) = places.split_at_mut(index);
        let mut tries = (0..TRIES).map(|_| {
            let x = random.between(low.x, high.x);
            Point::new(
                x,
                random.between(low.y, high.y),
                random.between(low.z, high.z),
            )
        });
        let is_free = |place: &Point| {
            let apart = |other: &Point| other.planar_distance(*place) >= region.gap;
            before.iter().all(apart)
                && !map.blocks_body(*place, *place, region.clearance, region.height)
        };
        let found = tries.find(is_free);
        let wanted = before.len() + rest.len();
        rest[0] = found.ok_or(NoRoom {
            found: index,
            wanted,
        })?;
    }
    Ok(())
}
