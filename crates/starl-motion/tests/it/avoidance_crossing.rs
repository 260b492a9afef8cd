//! Two streams of robots that cross at a right angle get through each other.

use crate::avoidance_world::scenes::{AGILE, crossing};
use crate::avoidance_world::{World, runs};

#[test]
fn streams_cross() {
    for model in AGILE.into_iter().chain(["car"]) {
        for (positioning, seed) in runs(12) {
            World::new(&crossing(model), positioning, seed).must_arrive(240.0);
        }
    }
}
