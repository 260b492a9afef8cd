//! The engine: robots in shards that step independently, and the work between steps.

mod act;
mod agenda;
mod discover;
mod fault;
mod inbox;
mod inspect;
mod intervene;
mod obstacles;
mod outlet;
mod populate;
mod position;
mod radio;
mod record;
mod shard;
mod shared;
mod simulated_robot;
mod simulation;
mod slots;
mod things;
mod witness;

pub use fault::timeline;
pub use inspect::{Mail, Standing};
pub use intervene::InterventionError;
pub use populate::{Complaint, Programs, StartError};
pub use record::{Drops, Tally};
pub use simulation::{Progress, Simulation};

use starl_core::Random;

/// The purpose of random draws; part of every key, so that no two purposes share a stream.
#[derive(Clone, Copy, Debug)]
enum Stream {
    Program = 1,
    Clock,
    Positioning,
    Motion,
    Link,
    Pilot,
    Faults,
    Corruption,
    Events,
    Storage,
}

fn stream(seed: u64, purpose: Stream, key: &[u64]) -> Random {
    let purpose = starl_core::random::hash_key(seed, &[purpose as u64]);
    Random::keyed(purpose, key)
}
