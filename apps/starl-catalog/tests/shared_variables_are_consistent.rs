//! In the examples `register` and `memory` all robots come to their end, in calm and over a bad network, and no
//! property is violated: no ticket is drawn twice, nobody sees that a round is done without its result.

use rayon::prelude::*;
use starl_catalog::examples;
use starl_sim::read::{Override, Request};
use starl_sim::{Outcome, Run};

fn run(example: &str, sets: &[&str], seed: u64) -> Run {
    let example = examples::find(example).expect("it is an example");
    let seed = format!("seed={seed}");
    let sets = sets.iter().copied().chain([&*seed]);
    let request = Request {
        overrides: sets.map(|set| Override::set(set).unwrap()).collect(),
        ..Request::new(example.source())
    };
    let application = starl_catalog::read(&request, example).unwrap();
    let mut run = application.run().unwrap();
    while !run.is_over() {
        run.step();
    }
    run
}

fn all_finish(sets: &[&str], seeds: u64) {
    (0..seeds).into_par_iter().for_each(|seed| {
        for example in ["register", "memory"] {
            let run = run(example, sets, seed);
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
        let run = run(example, &crashing, seed);
        assert_eq!(run.violations(), [], "{example} seed {seed}");
    };
    (0..50_u64).into_par_iter().for_each(|seed| {
        no_violation("register", seed);
        no_violation("memory", seed);
    });
}
