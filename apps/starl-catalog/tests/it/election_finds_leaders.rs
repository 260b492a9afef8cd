//! The robots of the example `election` see one leader after the other, with every algorithm, without faults and over a
//! bad network, and no property is violated.

use crate::support::Case;
use rayon::prelude::*;
use starl_sim::Outcome;

fn all_see_leaders(sets: &[&str], seeds: u64) {
    for algorithm in ["leases", "ballots", "bully"] {
        let algorithm = format!("parameters.algorithm={algorithm}");
        let sets: Vec<&str> = sets.iter().copied().chain([&*algorithm]).collect();
        (0..seeds).into_par_iter().for_each(|seed| {
            let run = Case::new("election", &sets, seed).run();
            assert_eq!(run.violations(), [], "{sets:?} seed {seed}");
            assert_eq!(run.outcome(), Outcome::Reached, "{sets:?} seed {seed}");
        });
    }
}

#[test]
fn in_calm() {
    all_see_leaders(&[], 100);
}

#[test]
fn over_a_bad_network() {
    let bad = [
        "network.loss=0.2",
        "network.duplication=0.2",
        "network.reordering=0.2",
        "network.delay=100ms",
    ];
    all_see_leaders(&bad, 50);
}
