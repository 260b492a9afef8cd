//! Streams of cars that arrive at random all get through, under every kind of temporary fault. Where cars break
//! down permanently there are no collisions, and cars that are stuck know it.

use crate::intersection_support::{Traffic, drive};
use rayon::prelude::*;
use starl_sim::Outcome;

fn stream(sets: &[&str]) -> Traffic {
    let traffic = drive("intersection-stream", sets, "");
    assert!(
        traffic.violations.is_empty(),
        "{sets:?} {:?}",
        traffic.violations
    );
    traffic
}

#[test]
fn all_get_through_in_calm() {
    let traffic = stream(&[]);
    assert_eq!(traffic.outcome, Some(Outcome::Reached));
    assert_eq!(traffic.through.len(), 100);
    traffic.holders();
}

#[test]
#[ignore = "takes half a minute without optimisation"]
fn all_get_through_with_temporary_faults() {
    let profiles: [&[&str]; 3] = [
        &[
            "network.loss=0.2",
            "network.delay=100ms",
            "network.jitter=40ms",
        ],
        &["fault_rates.partition=3/min", "fault_rates.heal_after=5s"],
        &["fault_rates.crash=0.1/min", "fault_rates.restart_after=6s"],
    ];
    profiles.into_par_iter().for_each(|profile| {
        let traffic = stream(profile);
        assert_eq!(traffic.outcome, Some(Outcome::Reached), "{profile:?}");
    });
}

#[test]
fn no_car_collides_with_a_broken_down_car() {
    some_break_down("seed=1");
}

#[test]
#[ignore = "takes seconds without optimisation, and is the same with another seed"]
fn no_car_collides_with_another_broken_down_car() {
    some_break_down("seed=2");
}

fn some_break_down(seed: &str) {
    let traffic = stream(&["fault_rates.crash=0.05/min", seed, "duration=240s"]);
    assert!(!traffic.stuck_at_the_end().is_empty(), "{seed}");
}
