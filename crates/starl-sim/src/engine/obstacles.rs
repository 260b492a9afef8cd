//! The existing obstacles: they expire, appear, move and disappear, and the robots' knowledge is updated.
//!
//! An obstacle's index in the world never changes: first come those of the scenario, then the walls around
//! the world, then those that have appeared since.

use super::Simulation;
use crate::scenario::WorldObstacle;
use starl_core::geometry::ObstacleIndex;
use starl_core::{Obstacle, Time};

impl Simulation {
    /// How many obstacles the scenario has, and how many walls come behind them.
    fn first_indices(&self) -> (usize, usize) {
        let world = &self.origin.world;
        let walls = world.bounds.map_or(0, |bounds| bounds.walls().len());
        (world.obstacles.len(), walls)
    }

    /// The obstacle of the world with this index, if it exists and is not a wall.
    pub(super) fn obstacle(&mut self, index: u32) -> Option<&mut WorldObstacle> {
        let (first, walls) = self.first_indices();
        let index = index as usize;
        let place = match index {
            index if index < first => index,
            index => index.checked_sub(walls).filter(|&place| place >= first)?,
        };
        let now = self.now;
        let obstacle = self.shared.obstacles.get_mut(place);
        obstacle.filter(|obstacle| obstacle.expires > now)
    }

    /// An obstacle appears.
    pub(super) fn add_obstacle(&mut self, obstacle: Obstacle, hidden: bool) {
        self.shared.obstacles.push(WorldObstacle {
            obstacle,
            hidden,
            expires: Time::NEVER,
        });
    }

    /// Builds the map of the existing obstacles, and that of the known ones.
    pub(super) fn raise_obstacles(&mut self) {
        let now = self.now;
        let (first, walls) = self.first_indices();
        let mut standing = Vec::new();
        let mut obstacles = Vec::new();
        let mut known = Vec::new();
        let mut hidden = Vec::new();
        self.next_expiry = Time::NEVER;
        let mut raise = |index: usize, obstacle: &Obstacle, is_hidden: bool| {
            if is_hidden {
                hidden.push(obstacles.len() as u32);
            } else {
                known.push(obstacle.clone());
            }
            standing.push(index as u32);
            obstacles.push(obstacle.clone());
        };
        for (place, entry) in self.shared.obstacles.iter().enumerate() {
            if place == first {
                self.origin.world.raise_walls(&mut raise);
            }
            if entry.expires > now {
                self.next_expiry = self.next_expiry.min(entry.expires);
                let index = if place < first { place } else { place + walls };
                raise(index, &entry.obstacle, entry.hidden);
            }
        }
        if self.shared.obstacles.len() == first {
            self.origin.world.raise_walls(&mut raise);
        }
        self.shared.map = ObstacleIndex::new(&obstacles);
        self.shared.standing = standing;
        self.shared.hidden = hidden;
        self.shared.known = known.into();
        self.forget_vanished();
    }

    /// Brings what single robots know up to date with the obstacles that stand.
    fn forget_vanished(&mut self) {
        let shared = &self.shared;
        for member in self.shards.iter_mut().flat_map(|shard| &mut shard.members) {
            if let Some(knowledge) = &mut member.senses.knowledge {
                let met = |index: &u32| shared.standing.binary_search(index).ok();
                knowledge.met.retain(|index| met(index).is_some());
                let extra = knowledge.met.iter().filter_map(met);
                let extra = extra.map(|index| shared.map.obstacles()[index].clone());
                knowledge.obstacles = shared.known.iter().cloned().chain(extra).collect();
            }
        }
    }
}
