//! The discovery of hidden obstacles by robots.

use super::shared::Shared;
use super::simulated_robot::{Knowledge, Senses};
use starl_core::event::Hit;
use starl_core::geometry::Bounds;
use starl_core::{Obstacle, RobotId};
use starl_motion::State;

/// Obstacles whose distance differs by less than this meet, metres.
const CORNER: f64 = 1e-3;

/// Hidden obstacles within `range` metres and in line of sight, or touched, become known. Returns those that
/// were not known before.
pub fn discover(
    shared: &Shared,
    robot: RobotId,
    state: &State,
    range: f64,
    senses: &mut Senses,
) -> Vec<Obstacle> {
    let body = &shared.bodies[robot.index()];
    let mut found = Vec::new();
    for &index in &shared.hidden {
        let world_index = shared.standing[index as usize];
        let known = senses.knowledge.as_ref();
        if known.is_some_and(|known| known.met.contains(&world_index)) {
            continue;
        }
        let obstacle = &shared.map.obstacles()[index as usize];
        let touched = senses.touching == Some(Hit::Obstacle(world_index));
        let gap = obstacle.body_gap(body.position, body.radius, body.height);
        if !touched && (gap > range || !sees(shared, state, index)) {
            continue;
        }
        let knowledge = senses.knowledge.get_or_insert_with(|| {
            Box::new(Knowledge {
                met: Vec::new(),
                obstacles: shared.known.clone(),
            })
        });
        knowledge.met.push(world_index);
        knowledge.obstacles = knowledge
            .obstacles
            .iter()
            .cloned()
            .chain([obstacle.clone()])
            .collect();
        found.push(obstacle.clone());
    }
    found
}

/// Whether nothing stands between the robot and the nearest point of an obstacle. Another one that meets it
/// there, as walls do at a corner, hides nothing of it; so the nearest of all is always seen.
fn sees(shared: &Shared, state: &State, index: u32) -> bool {
    let map = &shared.map;
    let eye = state.pose.position;
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
