//! The scenarios of profiles: the same for the same seed, within the given time, and within their
//! stated limits.

use crate::broken::{self, robots};
use starl_core::{Duration, RobotId, Time};
use starl_sim::profile::{Profile, list_faults};
use starl_sim::scenario::{FaultKind, FaultRates};
use starl_sim::{Scenario, write};
use std::collections::BTreeSet;

const SPAN: Duration = Duration::from_seconds(20);

/// Every profile with many seeds, for fleets of several sizes.
fn every_case(mut check: impl FnMut(Profile, &Scenario, Scenario)) {
    for size in [1, 2, 3, 4, 9] {
        let scenario = robots(size);
        for profile in Profile::ALL {
            for seed in 0..100 {
                check(profile, &scenario, profile.apply(&scenario, SPAN, seed));
            }
        }
    }
}

#[test]
fn the_same_seed_draws_the_same_faults() {
    every_case(|profile, scenario, drawn| {
        let again = profile.apply(scenario, SPAN, drawn.seed);
        assert_eq!(format!("{drawn:?}"), format!("{again:?}"));
    });
}

#[test]
fn most_seeds_draw_other_faults() {
    for profile in Profile::ALL
        .into_iter()
        .filter(|profile| *profile != Profile::Calm)
    {
        let drawn = (0..100).map(|seed| {
            let mut drawn = profile.apply(&robots(5), SPAN, seed);
            drawn.seed = 0;
            write::scenario(&drawn)
        });
        let different: BTreeSet<String> = drawn.collect();
        assert!(
            different.len() > 95,
            "{} {}",
            profile.name(),
            different.len()
        );
    }
}

#[test]
fn calm_adds_nothing() {
    let scenario = robots(4);
    let calm = Profile::Calm.apply(&scenario, SPAN, scenario.seed);
    assert_eq!(format!("{calm:?}"), format!("{scenario:?}"));
}

#[test]
fn all_faults_begin_and_end_within_three_quarters_of_the_time() {
    let until = Time::ZERO + SPAN * 3 / 4;
    every_case(|profile, _, drawn| {
        let schedule = &drawn.faults.schedule;
        assert!(schedule.is_sorted_by_key(|fault| fault.at));
        assert!(
            schedule.iter().all(|fault| fault.at <= until),
            "{}",
            profile.name()
        );
        let last = schedule.iter().rfind(|fault| {
            matches!(
                fault.kind,
                FaultKind::Partition(_) | FaultKind::OneWay(_) | FaultKind::Heal
            )
        });
        let healed = last.is_none_or(|fault| fault.kind == FaultKind::Heal);
        assert!(healed, "{} {}", profile.name(), drawn.seed);
    });
}

#[test]
fn a_majority_is_always_up_but_in_swarms() {
    let mut crashes = 0;
    every_case(|profile, _, drawn| {
        let mut down = BTreeSet::new();
        for fault in &drawn.faults.schedule {
            match &fault.kind {
                FaultKind::Crash(robots) => {
                    crashes += 1;
                    for robot in robots {
                        assert!(down.insert(*robot), "{robot} crashes twice");
                    }
                }
                FaultKind::Restart(robots) => {
                    for robot in robots {
                        assert!(down.remove(robot), "{robot} restarts though it is up");
                    }
                }
                _ => {}
            }
            let up = drawn.fleet.len() - down.len();
            assert!(
                profile == Profile::Swarm || 2 * up > drawn.fleet.len(),
                "{} {}",
                profile.name(),
                drawn.seed
            );
        }
    });
    assert!(crashes > 500, "{crashes}");
}

#[test]
fn partitions_part_the_whole_fleet() {
    let mut partitions = 0;
    every_case(|_, _, drawn| {
        for fault in &drawn.faults.schedule {
            if let FaultKind::Partition(parts) | FaultKind::OneWay(parts) = &fault.kind {
                partitions += 1;
                let mut robots: Vec<RobotId> = parts.concat();
                robots.sort_unstable();
                let fleet: Vec<RobotId> = (0..drawn.fleet.len() as u32).map(RobotId).collect();
                assert_eq!(robots, fleet);
                assert!(parts.len() > 1 && parts.iter().all(|part| !part.is_empty()));
            }
        }
    });
    assert!(partitions > 500, "{partitions}");
}

#[test]
fn only_corruption_overwrites_state() {
    every_case(|profile, _, drawn| {
        let corrupts = |kind: &FaultKind| matches!(kind, FaultKind::CorruptState(_));
        let any = drawn
            .faults
            .schedule
            .iter()
            .any(|fault| corrupts(&fault.kind));
        assert_eq!(any, profile == Profile::Corruption);
    });
}

#[test]
fn drawn_faults_can_be_written_and_read() {
    every_case(|profile, _, drawn| {
        let read = broken::read(&write::scenario(&drawn));
        let Some(read) = read else {
            panic!("{}\n{}", profile.name(), write::scenario(&drawn));
        };
        assert_eq!(read.faults, drawn.faults);
        assert_eq!(read.network, drawn.network);
        assert_eq!(read.fleet.groups[0].clock, drawn.fleet.groups[0].clock);
    });
}

#[test]
fn faults_at_random_rates_become_a_list() {
    let mut scenario = robots(3);
    scenario.faults.rates = FaultRates {
        crash: 0.2,
        restart_after: Duration::from_seconds(1),
        ..FaultRates::default()
    };
    let mut listed = scenario.clone();
    list_faults(&mut listed);
    assert!(listed.faults.schedule.len() > 6);
    assert_eq!(listed.faults.rates, FaultRates::default());
    let digest = |scenario: Scenario| {
        let end = Time::ZERO + scenario.duration;
        let program = broken::election::Bully::default();
        let mut simulation =
            starl_sim::Simulation::new(scenario, &|_| Ok(Box::new(program.clone()))).unwrap();
        while simulation.now() < end {
            simulation.step();
        }
        simulation.digest()
    };
    assert_eq!(digest(scenario), digest(listed));
}
