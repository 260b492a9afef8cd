//! Two robots that meet in a corridor too narrow for both: one of them backs out.

use crate::avoidance_world::scenes::{AGILE, narrow_corridor};
use crate::avoidance_world::{World, runs};

/// Seconds; 3 of 2,400 runs took longer. Which one backs out, and how far, is left to chance.
const BOUND: f64 = 900.0;

#[test]
fn one_of_two_backs_out_of_a_narrow_corridor() {
    for model in AGILE {
        for (positioning, seed) in runs(20) {
            if positioning.noise > 0.006 {
                // The corridor's margin is meant for errors of up to 2 cm.
                continue;
            }
            World::new(&narrow_corridor(model), positioning, seed).must_arrive(BOUND);
        }
    }
}
