//! Shrinking leaves what the failure needs and nothing else, and does not go over to another failure.

use crate::broken::{self, robots};
use starl_core::{RobotId, Time};
use starl_sim::profile::Profile;
use starl_sim::scenario::FaultKind;
use starl_sim::shrink::{Limits, Shrunk, shrink};
use starl_sim::{Scenario, write};

const MIDDLE: Time = Time(15_000_000_000);

fn crashes(scenario: &Scenario) -> usize {
    let is_crash = |kind: &FaultKind| matches!(kind, FaultKind::Crash(_));
    let schedule = scenario.faults.schedule.iter();
    schedule.filter(|fault| is_crash(&fault.kind)).count()
}

/// A seed of chaos in which several robots crash, shrunk.
fn shrunk(limits: Limits, fails: impl Fn(&Scenario) -> bool) -> Shrunk {
    let base = robots(6);
    let mut drawn = (1..).map(|seed| Profile::Chaos.apply(&base, base.duration, seed));
    let found = drawn.find(|drawn| crashes(drawn) >= 3 && fails(drawn));
    let mut fails = |scenario: &Scenario| fails(scenario).then_some(MIDDLE);
    let shrunk = shrink(&found.expect("there is one"), limits, true, &mut fails);
    shrunk.expect("it fails")
}

#[test]
fn unnecessary_parts_are_removed() {
    let smallest = shrunk(Limits::default(), |scenario| crashes(scenario) >= 2);
    assert!(smallest.is_minimal);
    let scenario = smallest.scenario;
    assert_eq!(scenario.faults.schedule.len(), 2);
    assert!(scenario.fleet.len() <= 3);
    assert_eq!(scenario.network.link.loss, 0.0);
    assert!(scenario.fleet.groups[0].clock.offset.is_zero());
    assert!(scenario.duration <= MIDDLE.since(Time::ZERO));
}

#[test]
fn a_fleet_that_fails_without_trouble_is_another_failure() {
    // A robot alone fails by itself; three that see a crash fail for that.
    let fails = |scenario: &Scenario| {
        let size = scenario.fleet.len();
        size == 1 || (size >= 3 && crashes(scenario) >= 1)
    };
    let smallest = shrunk(Limits::default(), fails).scenario;
    assert_eq!((smallest.fleet.len(), crashes(&smallest)), (3, 1));
}

#[test]
fn the_search_ends_at_its_limit() {
    let limits = Limits {
        trials: 7,
        ..Limits::default()
    };
    let cut_short = shrunk(limits, |scenario| crashes(scenario) >= 2);
    assert!(!cut_short.is_minimal);
    assert_eq!(cut_short.trials, 7);
}

#[test]
fn faults_of_robots_that_are_left_out_go_with_them() {
    let last_crashes = |scenario: &Scenario| {
        let last = RobotId(scenario.fleet.len() as u32 - 1);
        let kinds = scenario.faults.schedule.iter().map(|fault| &fault.kind);
        kinds
            .into_iter()
            .any(|kind| *kind == FaultKind::Crash(vec![last]))
    };
    let smallest = shrunk(Limits::default(), last_crashes).scenario;
    let last = smallest.fleet.len() as u32 - 1;
    assert!((1..=2).contains(&last));
    assert_eq!(
        smallest.faults.schedule[0].kind,
        FaultKind::Crash(vec![RobotId(last)])
    );
    assert!(broken::read(&write::scenario(&smallest)).is_some());
}

#[test]
fn an_existing_majority_is_kept() {
    // Fails whenever a robot crashes: of two robots, one that crashes would leave no majority.
    let base = robots(5);
    let mut drawn = base.clone();
    let crash = |robot: u32, at| starl_sim::scenario::Fault {
        at: Time(at),
        kind: FaultKind::Crash(vec![RobotId(robot)]),
    };
    drawn.faults.schedule = vec![crash(1, 1_234_567_891), crash(3, 2_000_000_007)];
    let mut fails = |scenario: &Scenario| {
        let first = scenario.faults.schedule.first();
        first.map(|fault| Time(fault.at.0 + 1))
    };
    let smallest = shrink(&drawn, Limits::default(), true, &mut fails).expect("it fails");
    assert!(smallest.is_minimal);
    assert_eq!(
        (smallest.scenario.fleet.len(), crashes(&smallest.scenario)),
        (3, 1)
    );
    assert_eq!(smallest.scenario.duration.0 % 100_000_000, 0, "round");
}

#[test]
fn with_a_lost_majority_the_fleet_stays_large_enough_for_one() {
    let mut drawn = robots(5);
    drawn.faults.schedule = (0..3)
        .map(|robot| starl_sim::scenario::Fault {
            at: Time(1_000_000_000),
            kind: FaultKind::Crash(vec![RobotId(robot)]),
        })
        .collect();
    let mut fails =
        |scenario: &Scenario| (2 * crashes(scenario) > scenario.fleet.len()).then_some(MIDDLE);
    let smallest = shrink(&drawn, Limits::default(), true, &mut fails).expect("it fails");
    assert_eq!(
        (smallest.scenario.fleet.len(), crashes(&smallest.scenario)),
        (3, 2)
    );
}
