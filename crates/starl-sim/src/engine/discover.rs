//! The discovery of hidden obstacles by robots.

use super::shared::Shared;
use super::simulated_robot::{Knowledge, Senses};
use starl_core::event::Hit;
use starl_core::{Obstacle, RobotId};
use starl_motion::discovery::perceives;

/// Hidden obstacles within `range` metres and in line of sight, or touched, become known. Returns those that
/// were not known before.
pub fn discover(shared: &Shared, robot: RobotId, range: f64, senses: &mut Senses) -> Vec<Obstacle> {
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
        if !touched && !perceives(body, &shared.map, index, range) {
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
