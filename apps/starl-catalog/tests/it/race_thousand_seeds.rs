//! Race reaches its goal and violates no property with any seed: without faults and over a bad network, with its own
//! fleet and with one of twelve, in the StarL language and in Rust. A hundred seeds are tried, and a thousand by `make
//! nightly`.

use crate::support::Case;
use rayon::prelude::*;
use starl_sim::Outcome;

const SEEDS: u64 = 100;
const BAD_NETWORK: [&str; 2] = ["network.loss=0.2", "network.delay=100ms"];
const PROGRAMS: [&str; 2] = ["program=race.starl", "program=race"];
const TWELVE: Option<&str> = Some("create=6,drone=6");

/// The failure of a race, ready to be repeated; none if there is none.
fn race(program: &str, seed: u64, fleet: Option<&str>, sets: &[&str]) -> Option<String> {
    let sets: Vec<&str> = sets.iter().copied().chain([program]).collect();
    let run = Case {
        robots: fleet,
        ..Case::new("race", &sets, seed)
    }
    .run();
    (run.outcome() != Outcome::Reached).then(|| {
        let mut command = String::from("starl run race");
        fleet
            .iter()
            .for_each(|fleet| command += &format!(" --robots {fleet}"));
        sets.iter()
            .for_each(|set| command += &format!(" --set {set}"));
        command += &format!(" --seed {seed}");
        format!(
            "{command}: {:?} {:?}",
            run.outcome(),
            run.violations().first()
        )
    })
}

fn all_reach_their_goal(fleet: Option<&str>, sets: &[&str], seeds: u64) {
    let runs = PROGRAMS.len() as u64 * seeds;
    let race = |run| race(PROGRAMS[(run / seeds) as usize], run % seeds, fleet, sets);
    let failures: Vec<String> = (0..runs).into_par_iter().filter_map(race).collect();
    let first = failures
        .iter()
        .take(5)
        .cloned()
        .collect::<Vec<_>>()
        .join("\n");
    assert!(
        failures.is_empty(),
        "{} of {runs} fail:\n{first}",
        failures.len()
    );
}

#[test]
fn four_in_calm() {
    all_reach_their_goal(None, &[], SEEDS);
}

#[test]
fn four_over_a_bad_network() {
    all_reach_their_goal(None, &BAD_NETWORK, SEEDS);
}

#[test]
fn twelve_in_calm() {
    all_reach_their_goal(TWELVE, &[], SEEDS);
}

#[test]
fn twelve_over_a_bad_network() {
    all_reach_their_goal(TWELVE, &BAD_NETWORK, SEEDS);
}

#[test]
#[ignore = "minutes"]
fn a_thousand_seeds_of_each() {
    for fleet in [None, TWELVE] {
        all_reach_their_goal(fleet, &[], 1_000);
        all_reach_their_goal(fleet, &BAD_NETWORK, 1_000);
    }
}
