//! The examples reach their goals although a fault overwrites all variables and primitives of all robots at random
//! during the run, and their properties hold after the time to recover.

use crate::support::Case;
use rayon::prelude::*;
use starl_core::Time;
use starl_sim::Outcome;

/// Overwrites all robots at this moment, with so many seeds.
fn recovers(example: &str, at: &str, seeds: u64) {
    let faults = format!("[[fault]]\nat = \"{at}\"\nkind = \"corrupt_state\"\nrobots = \"all\"\n");
    (1..=seeds).into_par_iter().for_each(|seed| {
        let run = Case {
            faults: &faults,
            ..Case::new(example, &[], seed)
        }
        .run();
        let violations = run.violations();
        assert!(violations.is_empty(), "{example} {seed}: {violations:?}");
        assert_eq!(run.outcome(), Outcome::Reached, "{example}, seed {seed}");
        let simulation = run.simulation();
        let since = simulation.uncorrupted();
        assert!(
            since < simulation.now().since(Time::ZERO),
            "{example} {seed} was over before"
        );
    });
}

#[test]
fn race() {
    recovers("race", "5s", 30);
}

#[test]
fn line() {
    recovers("line", "40s", 3);
}

#[test]
fn formation() {
    recovers("formation", "40s", 3);
}

#[test]
fn search() {
    recovers("search", "20s", 10);
}

#[test]
fn flocking() {
    recovers("flocking", "30s", 6);
}

#[test]
fn auction() {
    recovers("auction", "15s", 30);
}

#[test]
fn maze() {
    recovers("maze", "20s", 4);
}

#[test]
fn light_painting() {
    recovers("light-painting", "30s", 10);
}

#[test]
fn memory() {
    recovers("memory", "1s", 30);
}

#[test]
fn register() {
    recovers("register", "1s", 150);
}

#[test]
fn registration() {
    recovers("registration", "3s", 30);
}

#[test]
fn intersection() {
    recovers("intersection", "10s", 20);
}

#[test]
fn traffic_signs() {
    recovers("traffic-signs", "10s", 20);
}
