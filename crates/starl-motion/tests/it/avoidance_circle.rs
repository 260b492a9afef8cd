//! Robots on a circle, each of which wants to get to the other side, do so: all their ways cross in
//! one point.

use crate::avoidance_world::scenes::{AGILE, circle};
use crate::avoidance_world::{World, runs};

/// Seconds; the slowest of 9,000 runs took 150.
const BOUND: f64 = 240.0;

#[test]
fn four_change_sides() {
    for model in AGILE.into_iter().chain(["car"]) {
        for (positioning, seed) in runs(25) {
            World::new(&circle(model, 4), positioning, seed).must_arrive(BOUND);
        }
    }
}

#[test]
fn eight_change_sides() {
    for model in AGILE {
        for (positioning, seed) in runs(15) {
            World::new(&circle(model, 8), positioning, seed).must_arrive(BOUND);
        }
    }
}

#[test]
fn sixteen_change_sides() {
    for model in AGILE {
        for (positioning, seed) in runs(6) {
            World::new(&circle(model, 16), positioning, seed).must_arrive(BOUND);
        }
    }
}
