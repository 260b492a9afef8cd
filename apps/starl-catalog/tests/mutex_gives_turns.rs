//! Every robot of the example `mutex` has its turns, whichever algorithm it uses, in calm, over a bad network
//! and after crashes and partitions; and no property is violated.

use rayon::prelude::*;
use starl_catalog::examples;
use starl_sim::read::{Override, Request};
use starl_sim::{Outcome, Run};

const ALGORITHMS: [&str; 3] = ["permission", "quorum", "lease"];

fn run(sets: &[&str], algorithm: &str, seed: u64) -> Run {
    let example = examples::find("mutex").expect("it is an example");
    let chosen = format!("parameters.algorithm={algorithm}");
    let seed = format!("seed={seed}");
    let sets = sets.iter().copied().chain([&*chosen, &*seed]);
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

fn all_have_turns(sets: &[&str], seeds: u64) {
    for algorithm in ALGORITHMS {
        (0..seeds).into_par_iter().for_each(|seed| {
            let run = run(sets, algorithm, seed);
            assert_eq!(run.violations(), [], "{algorithm} {sets:?} seed {seed}");
            assert_eq!(
                run.outcome(),
                Outcome::Reached,
                "{algorithm} {sets:?} seed {seed}"
            );
        });
    }
}

const BAD: [&str; 4] = [
    "network.loss=0.3",
    "network.duplication=0.2",
    "network.reordering=0.2",
    "duration=300s",
];

#[test]
fn in_calm() {
    all_have_turns(&[], 200);
}

#[test]
fn over_a_bad_network() {
    all_have_turns(&BAD, 50);
}

#[test]
fn with_wrong_clocks() {
    let clocks = ["robots.0.clock.offset=1h", "robots.0.clock.drift=0.9%"];
    all_have_turns(&clocks, 100);
}

/// What crashes and restarts, and falls apart and meets again.
fn trouble() -> Vec<&'static str> {
    let mut sets = BAD.to_vec();
    sets.extend([
        "parameters.entries=10",
        "fault_rates.crash=0.02/s",
        "fault_rates.restart_after=3s",
        "fault_rates.partition=0.02/s",
        "fault_rates.heal_after=3s",
        "duration=600s",
    ]);
    sets
}

#[test]
fn through_crashes_and_partitions() {
    all_have_turns(&trouble(), 20);
}

#[test]
#[ignore = "is not mended yet: nobody enters any more"]
fn a_quorum_goes_on_after_crashes_and_partitions() {
    let run = run(&trouble(), "quorum", 20);
    assert_eq!(run.outcome(), Outcome::Reached);
}

#[test]
fn nothing_is_held_twice_a_while_after_a_corruption_of_state() {
    let corrupting = ["parameters.entries=30", "fault_rates.corrupt_state=0.02/s"];
    for algorithm in ALGORITHMS {
        (0..100).into_par_iter().for_each(|seed| {
            let run = run(&corrupting, algorithm, seed);
            assert_eq!(run.violations(), [], "{algorithm} seed {seed}");
        });
    }
}
