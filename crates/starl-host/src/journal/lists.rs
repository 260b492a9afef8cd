//! Lists that many robots share. Each is kept once, under the hash of its content.

use super::encode;
use super::knowledge::Knowledge;
use alloc::sync::Arc;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use starl_core::{Obstacle, RobotId, WayPoint, random};

/// The content of a list.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum List {
    Fleet(Arc<[RobotId]>),
    WayPoints(Arc<[WayPoint]>),
    Obstacles(Arc<[Obstacle]>),
}

/// The lists that the robots of one journal know, and those that are still to be written down.
#[derive(Clone, Debug, Default)]
pub struct Lists {
    kept: Vec<(u64, List)>,
    /// The encoding of lists that came up since this was last emptied, by their hashes.
    pub fresh: Vec<(u64, Vec<u8>)>,
}

impl Lists {
    /// Lets a robot know a list, and gives its hash. Robots that know the same share it.
    pub fn share(&mut self, list: List, known: &mut Knowledge) -> u64 {
        let bytes = encode(&list);
        let hash = hash(&bytes);
        if let Some((_, kept)) = self.kept.iter().find(|kept| kept.0 == hash) {
            kept.clone().put_into(known);
            return hash;
        }
        self.kept.retain(|(_, list)| list.is_shared());
        self.kept.push((hash, list.clone()));
        self.fresh.push((hash, bytes));
        list.put_into(known);
        hash
    }
}

impl List {
    /// Replaces the robot's previous list by this one.
    pub fn put_into(self, known: &mut Knowledge) {
        match self {
            List::Fleet(list) => known.fleet = list,
            List::WayPoints(list) => known.way_points = list,
            List::Obstacles(list) => known.obstacles = list,
        }
    }

    /// Whether anyone else holds it too.
    fn is_shared(&self) -> bool {
        let holders = match self {
            List::Fleet(list) => Arc::strong_count(list),
            List::WayPoints(list) => Arc::strong_count(list),
            List::Obstacles(list) => Arc::strong_count(list),
        };
        holders > 1
    }
}

/// 64 bits that stand for a list: of a billion lists, two are taken for one with a probability of 3 %.
fn hash(bytes: &[u8]) -> u64 {
    let words = bytes.chunks(size_of::<u64>()).map(|chunk| {
        let mut word = [0; size_of::<u64>()];
        word[..chunk.len()].copy_from_slice(chunk);
        u64::from_le_bytes(word)
    });
    let words: Vec<u64> = words.collect();
    random::hash_key(bytes.len() as u64, &words)
}
