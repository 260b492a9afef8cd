//! The four cars of the intersection all get through, never two of them in one zone, whatever the network does;
//! those whose ways are disjoint are inside at the same time.

use crate::intersection_support::{Traffic, drive};
use rayon::prelude::*;
use starl_core::RobotId;
use starl_sim::Outcome;

const SEEDS: u64 = 25;

const LOSSY: [&str; 6] = [
    "network.loss=0.2",
    "network.delay=100ms",
    "network.jitter=40ms",
    "network.duplication=0.1",
    "network.reordering=0.2",
    "duration=120s",
];

const PARTED: [&str; 3] = [
    "fault_rates.partition=6/min",
    "fault_rates.heal_after=5s",
    "duration=180s",
];

const RESTARTS: [&str; 3] = [
    "fault_rates.crash=2/min",
    "fault_rates.restart_after=6s",
    "duration=300s",
];

fn with_seeds(sets: &[&str], check: impl Fn(&Traffic, &str) + Sync) {
    (0..SEEDS).into_par_iter().for_each(|seed| {
        let seed = format!("seed={seed}");
        let sets: Vec<&str> = sets.iter().copied().chain([&*seed]).collect();
        let traffic = drive("intersection", &sets, "");
        assert!(
            traffic.violations.is_empty(),
            "{sets:?} {:?}",
            traffic.violations
        );
        check(&traffic, &seed);
    });
}

fn all_pass(traffic: &Traffic, seed: &str) {
    assert_eq!(traffic.outcome, Some(Outcome::Reached), "{seed}");
    assert_eq!(traffic.passed(), [0, 1, 2, 3], "{seed}");
    assert!(traffic.stuck_at_the_end().is_empty(), "{seed}");
    traffic.holders();
}

#[test]
fn calm() {
    with_seeds(&[], |traffic, seed| {
        all_pass(traffic, seed);
        assert!(traffic.stuck.is_empty(), "{seed}: nothing was in the way");
    });
}

#[test]
fn over_a_bad_network() {
    with_seeds(&LOSSY, all_pass);
}

#[test]
fn a_partition_that_heals() {
    with_seeds(&PARTED, all_pass);
}

/// A car that restarts on the intersection requests the zones that it has not left and drives on.
#[test]
fn cars_that_crash_and_restart() {
    with_seeds(&RESTARTS, |traffic, seed| {
        assert_eq!(traffic.outcome, Some(Outcome::Reached), "{seed}");
    });
}

#[test]
fn with_traffic_lights() {
    for lights in ["program=light.starl", "parameters.lights=2"] {
        with_seeds(&[lights, "duration=90s"], |traffic, seed| {
            assert_eq!(traffic.outcome, Some(Outcome::Reached), "{lights} {seed}");
            assert_eq!(traffic.passed(), [0, 1, 2, 3], "{lights} {seed}");
        });
    }
}

/// The other two break down where they start.
const ONLY_TWO: &str = r#"
[[fault]]
at = "100ms"
kind = "crash"
robots = ["Robot1", "Robot3"]
"#;

#[test]
fn opposite_lanes_at_once() {
    // Both go straight on, one to the east and one to the west.
    let straight = ["robots.0.parameters.dest=d1", "robots.2.parameters.dest=a1"];
    let at_once = |as_one: &str, seed: u64| {
        let seed = format!("seed={seed}");
        let sets = [straight[0], straight[1], as_one, &seed];
        let traffic = drive("intersection", &sets, ONLY_TWO);
        assert!(
            traffic.violations.is_empty(),
            "{sets:?} {:?}",
            traffic.violations
        );
        assert_eq!(traffic.passed(), [0, 2], "{sets:?}");
        let both = vec![RobotId(0), RobotId(2)];
        traffic.holders().contains(&both)
    };
    for seed in 0..SEEDS {
        assert!(at_once("parameters.as_one=false", seed), "{seed}");
        assert!(!at_once("parameters.as_one=true", seed), "{seed}");
    }
}
