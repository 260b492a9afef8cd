//! Two robots that meet head-on pass each other, each on the right of the way.

use crate::avoidance_world::scenes::{AGILE, head_on};
use crate::avoidance_world::{EXACT, World, runs};

#[test]
fn two_that_meet_head_on_pass() {
    for model in AGILE.into_iter().chain(["car"]) {
        for (positioning, seed) in runs(40) {
            World::new(&head_on(model), positioning, seed).must_arrive(60.0);
        }
    }
}

/// Robots on wheels have to turn round first, which takes them off the straight way.
#[test]
fn holonomic_robots_keep_to_the_right() {
    for model in ["drone", "holonomic"] {
        for (positioning, seed) in runs(20) {
            let mut world = World::new(&head_on(model), positioning, seed);
            // The first goes towards positive x.
            while world.robots[0].position().x < world.robots[1].position().x {
                world.step();
                assert!(
                    world.seconds() < 30.0,
                    "{model}, seed {seed}: they do not pass"
                );
            }
            let (one, other) = (world.robots[0].position().y, world.robots[1].position().y);
            assert!(
                one < other,
                "{model}, {positioning:?}, seed {seed}: on the left"
            );
        }
    }
}

#[test]
fn without_avoidance_they_would_collide() {
    for model in AGILE {
        let collide = (0..10).filter(|&seed| {
            let mut world = World::with_options(&head_on(model), EXACT, seed, None);
            world.run_for(30.0);
            world.least_gap < 0.0
        });
        let collide = collide.count();
        assert!(collide > 5, "{model}: only {collide} of 10 collide");
    }
}
