//! When a robot perceives an obstacle that its map lacks.
//!
//! The simulator decides by the robot's true place, `starl-node` by its estimate.

use crate::Neighbour;
use starl_core::geometry::{Bounds, ObstacleIndex};

/// Obstacles whose distance differs by less than this meet, metres.
const CORNER: f64 = 1e-3;

/// Whether the body perceives an obstacle of `map`: it is within `range` metres of the body's edge and in line of sight.
pub fn perceives(body: &Neighbour, map: &ObstacleIndex, index: u32, range: f64) -> bool {
    let obstacle = &map.obstacles()[index as usize];
    obstacle.body_gap(body.position, body.radius, body.height) <= range && sees(body, map, index)
}

/// Whether nothing stands between the body and the nearest point of an obstacle. Another one that meets it
/// there, as walls do at a corner, hides nothing of it; so the nearest of all is always seen.
fn sees(body: &Neighbour, map: &ObstacleIndex, index: u32) -> bool {
    let eye = body.position;
    let nearest = map.obstacles()[index as usize].nearest_point(eye);
    let Some(direction) = (nearest - eye).normalized() else {
        return true;
    };
    let target = nearest - direction * CORNER.min(eye.distance(nearest));
    let mut seen = true;
    map.any_near(&Bounds::of_segment(eye, target), |other| {
        seen = other == index || !map.obstacles()[other as usize].blocks_segment(eye, target, 0.0);
        !seen
    });
    seen
}
