//! The robots of Flocking, of every model, line up as in its README.

use crate::support::Case;
use starl_sim::Outcome;

/// Flying robots are above their places, and in them.
#[test]
fn quadcopters_among_robots_on_the_ground() {
    for seed in 1..=5 {
        let run = Case {
            robots: Some("create=4,drone=4"),
            ..Case::new("flocking", &[], seed)
        }
        .run();
        assert_eq!(run.outcome(), Outcome::Reached, "seed {seed}");
        assert!(run.violations().is_empty(), "{seed} {:?}", run.violations());
    }
}
