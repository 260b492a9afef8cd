//! Race in the StarL language and Race in Rust are the same program: in every run the same actions fire, the same
//! events are recorded, the same robots finish and all drive the same paths, at the same times.

use crate::support::Case;
use rayon::prelude::*;
use starl_core::{Event, Record};

const SEEDS: u64 = 100;

/// The actions of the program and the robots, in the order of time.
fn history(program: &str, seed: u64, sets: &[&str]) -> Vec<Record> {
    let program = format!("program={program}");
    let sets: Vec<&str> = sets.iter().copied().chain([&*program]).collect();
    let mut run = Case::new("race", &sets, seed).start();
    let mut history = Vec::new();
    while !run.is_over() {
        let records = run.step().iter().filter(|record| {
            matches!(
                record.event,
                Event::Action(_)
                    | Event::Program { .. }
                    | Event::Finished
                    | Event::Failed(_)
                    | Event::Moved(_)
            )
        });
        history.extend(records.cloned());
    }
    history
}

fn are_the_same(sets: &[&str]) {
    let compare = |seed| {
        let starl = history("race.starl", seed, sets);
        let rust = history("race", seed, sets);
        let first = starl.iter().zip(&rust).position(|(a, b)| a != b);
        let first = first.unwrap_or(starl.len().min(rust.len()));
        assert!(
            starl.len() == rust.len() && first == starl.len(),
            "seed {seed}, after {first} events:\n  StarL {:?}\n  Rust  {:?}",
            starl.get(first),
            rust.get(first)
        );
        let is_told = |record: &&Record| !matches!(record.event, Event::Moved(_));
        starl.iter().filter(is_told).count()
    };
    let told: Vec<usize> = (0..SEEDS).into_par_iter().map(compare).collect();
    // Four waypoints are reached by some robot, and each of four robots finishes.
    assert!(told.iter().all(|&count| count > 20), "{told:?}");
}

#[test]
fn in_calm() {
    are_the_same(&[]);
}

#[test]
fn over_a_bad_network() {
    are_the_same(&[
        "network.loss=0.3",
        "network.delay=100ms",
        "network.duplication=0.1",
        "network.reordering=0.1",
    ]);
}

#[test]
fn with_crashes_and_restarts() {
    are_the_same(&[
        "network.loss=0.2",
        "fault_rates.crash=0.05/s",
        "fault_rates.restart_after=2s",
    ]);
}
