//! In the examples `register` and `memory` all robots finish, with and without a bad network, and no property
//! is violated: no ticket is drawn twice, and no robot sees a finished round without its result.

use crate::support::Case;
use rayon::prelude::*;
use starl_sim::Outcome;

fn all_finish(sets: &[&str], seeds: u64) {
    (0..seeds).into_par_iter().for_each(|seed| {
        for example in ["register", "memory"] {
            let run = Case::new(example, sets, seed).run();
            assert_eq!(run.violations(), [], "{example} {sets:?} seed {seed}");
            let outcome = run.outcome();
            assert_eq!(outcome, Outcome::Reached, "{example} {sets:?} seed {seed}");
        }
    });
}

#[test]
fn in_calm() {
    all_finish(&[], 100);
}

#[test]
fn over_a_bad_network() {
    let bad = [
        "network.loss=0.2",
        "network.duplication=0.2",
        "network.reordering=0.2",
        "duration=300s",
    ];
    all_finish(&bad, 50);
}

#[test]
fn in_spite_of_partitions() {
    let parted = [
        "network.loss=0.1",
        "fault_rates.partition=6/min",
        "fault_rates.heal_after=3s",
        "duration=600s",
    ];
    all_finish(&parted, 50);
}

#[test]
fn in_spite_of_crashes() {
    let crashing = [
        "network.loss=0.1",
        "fault_rates.crash=1/min",
        "fault_rates.restart_after=2s",
        "duration=600s",
    ];
    let no_violation = |example, seed| {
        let run = Case::new(example, &crashing, seed).run();
        assert_eq!(run.violations(), [], "{example} seed {seed}");
    };
    (0..50_u64).into_par_iter().for_each(|seed| {
        no_violation("register", seed);
        no_violation("memory", seed);
    });
}
