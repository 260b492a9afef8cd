//! Every robot of the example `mutex` has its turns, whichever algorithm it uses, in calm, over a bad network
//! and after crashes and partitions; and no property is violated.

use crate::support::Case;
use rayon::prelude::*;
use starl_core::event::{MutexEvent, PrimitiveEvent};
use starl_core::{Duration, Event, Time};
use starl_sim::{Outcome, Run};

const ALGORITHMS: [&str; 3] = ["permission", "quorum", "lease"];

fn start(sets: &[&str], algorithm: &str, seed: u64) -> Run {
    let algorithm = format!("parameters.algorithm={algorithm}");
    let sets: Vec<&str> = sets.iter().copied().chain([&*algorithm]).collect();
    Case::new("mutex", &sets, seed).start()
}

fn run(sets: &[&str], algorithm: &str, seed: u64) -> Run {
    let mut run = start(sets, algorithm, seed);
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

/// Robots crash and restart, and the network is partitioned and heals.
fn trouble() -> Vec<&'static str> {
    let mut sets = BAD.to_vec();
    sets.extend([
        "parameters.entries=10",
        "fault_rates.crash=0.02/s",
        "fault_rates.restart_after=3s",
        "fault_rates.partition=0.02/s",
        "fault_rates.heal_after=3s",
        "duration=900s",
    ]);
    sets
}

#[test]
fn through_crashes_and_partitions() {
    all_have_turns(&trouble(), 20);
}

/// A robot that crashes restarts its turns, so a fleet need not finish in the end. But while nothing fails
/// some robot enters regularly, as soon as those that restarted have asked all others for their grants.
#[test]
fn a_quorum_continues_after_crashes_and_partitions() {
    (20..28).into_par_iter().for_each(|seed| {
        let mut run = start(&trouble(), "quorum", seed);
        let (mut last, mut longest) = (Time::ZERO, Duration::ZERO);
        while !run.is_over() {
            for record in run.step() {
                let is_entry = |event: &Event| match event {
                    Event::Primitive { event, .. } => {
                        matches!(event, PrimitiveEvent::Mutex(MutexEvent::Enter { .. }))
                    }
                    Event::Fault(_) => true,
                    _ => false,
                };
                if is_entry(&record.event) {
                    longest = longest.max(record.at.since(last));
                    last = record.at;
                }
            }
        }
        assert_eq!(run.violations(), [], "seed {seed}");
        assert!(
            longest < Duration::from_seconds(30),
            "seed {seed}: {longest}"
        );
    });
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

/// Two robots tried other quorums while the network was partitioned, and what they gave back was not heard: of their
/// old requests one was granted and the other waited for it.
#[test]
fn requests_with_lost_releases_block_no_robot() {
    let faults = "
        [[fault]]
        at = \"700ms\"
        kind = \"partition\"
        groups = [[\"robot3\"], [\"robot1\"], [\"robot0\", \"robot2\"]]
        [[fault]]
        at = \"1s\"
        kind = \"partition\"
        groups = [[\"robot1\", \"robot2\"], [\"robot0\", \"robot3\"]]
        [[fault]]
        at = \"2300ms\"
        kind = \"heal\"";
    let run = Case {
        faults,
        ..Case::new("mutex", &["parameters.algorithm=quorum"], 976)
    }
    .run();
    assert_eq!(run.outcome(), Outcome::Reached, "{:?}", run.violations());
}

/// Two of five robots die while all request something all the time, and stay dead. Their resources are free after
/// their leases.
#[test]
fn leases_continue_while_a_minority_stays_down() {
    let sets = [
        "parameters.algorithm=lease",
        "parameters.entries=60",
        "parameters.longest_use=1500ms",
    ];
    (0..40).into_par_iter().for_each(|seed| {
        let (first, second) = (3000 + 37 * seed, 5000 + 53 * seed);
        let faults = format!(
            "[[fault]]\nat = \"{first}ms\"\nkind = \"crash\"\nrobots = [\"robot0\"]\n\
             [[fault]]\nat = \"{second}ms\"\nkind = \"crash\"\nrobots = [\"robot1\"]\n"
        );
        let case = Case {
            robots: Some("create=5"),
            faults: &faults,
            ..Case::new("mutex", &sets, seed)
        };
        let run = case.run();
        assert_eq!(run.violations(), [], "seed {seed}");
    });
}
