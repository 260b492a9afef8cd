//! The robots of the example `election` see one leader after the other, whatever the algorithm, in calm and over
//! a bad network, and no property is violated.

use rayon::prelude::*;
use starl_catalog::examples;
use starl_sim::read::{Override, Request};
use starl_sim::{Outcome, Run};

fn run(sets: &[&str], seed: u64) -> Run {
    let example = examples::find("election").expect("it is an example");
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

fn all_see_leaders(sets: &[&str], seeds: u64) {
    for algorithm in ["leases", "ballots", "bully"] {
        let algorithm = format!("parameters.algorithm={algorithm}");
        let sets: Vec<&str> = sets.iter().copied().chain([&*algorithm]).collect();
        (0..seeds).into_par_iter().for_each(|seed| {
            let run = run(&sets, seed);
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
