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
fn what_is_not_needed_goes() {
    let smallest = shrunk(Limits::default(), |scenario| crashes(scenario) >= 2);
    assert!(smallest.is_minimal);
    let scenario = smallest.scenario;
    assert_eq!(scenario.faults.schedule.len(), 2);
    assert!(scenario.fleet.len() <= 2);
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
    assert_eq!(smallest.fleet.len(), 1);
    assert_eq!(
        smallest.faults.schedule[0].kind,
        FaultKind::Crash(vec![RobotId(0)])
    );
    assert!(broken::read(&write::scenario(&smallest)).is_some());
}
