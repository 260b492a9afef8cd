//! Late estimates: at a lower rate than in the options, or missing now and then.

use crate::avoidance_world::scenes::{AGILE, circle, head_on};
use crate::avoidance_world::{EXACT, Positioning, World, runs};
use starl_motion::avoidance::Options;

#[test]
fn a_slower_rate_is_noticed() {
    for steps in [10, 20] {
        for model in AGILE {
            for (positioning, seed) in runs(6) {
                let slower = Positioning {
                    steps,
                    ..positioning
                };
                World::new(&circle(model, 8), slower, seed).must_arrive(240.0);
            }
        }
    }
}

/// The first gap of its length comes as a surprise, later ones do not.
#[test]
fn gaps_are_reckoned_with_for_a_while() {
    for model in AGILE {
        for (positioning, seed) in runs(12) {
            let lossy = Positioning {
                loss: 0.3,
                ..positioning
            };
            World::new(&circle(model, 8), lossy, seed).must_arrive(240.0);
        }
    }
}

#[test]
fn half_of_the_estimates_may_be_lost_if_the_options_name_the_gaps() {
    let options = Options {
        period: 0.5,
        ..Options::default()
    };
    for model in AGILE {
        for (positioning, seed) in runs(6) {
            let lossy = Positioning {
                loss: 0.5,
                ..positioning
            };
            let scene = circle(model, 8);
            let mut world = World::with_options(&scene, lossy, seed, Some(options.clone()));
            world.must_arrive(240.0);
        }
    }
}

/// A robot without estimates for a second continues with its last command, so only robots whose
/// options allow for this are safe.
#[test]
fn outages_that_the_options_name_do_no_harm() {
    let options = Options {
        period: 1.0,
        ..Options::default()
    };
    for model in AGILE {
        for seed in 0..30 {
            let options = Some(options.clone());
            let mut world = World::with_options(&head_on(model), EXACT, seed, options);
            for _ in 0..30 {
                world.run_for(1.0);
                world.lose_estimates(1.0);
            }
            world.must_be_clear();
        }
    }
}
