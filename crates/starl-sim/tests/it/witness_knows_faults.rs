//! A witness returns the time since the last fault began or ended, and zero during a fault that robots cannot
//! detect.

use crate::engine_support::scenario;
use starl_core::event::Name;
use starl_core::{Duration, Primitives, Program, Robot, RobotId, Time};
use starl_properties::{Monitor, Violation, Witness};
use starl_sim::Run;
use starl_sim::scenario::{Fault, FaultKind};
use std::sync::{Arc, Mutex};

#[derive(Clone, Primitives)]
struct Idle;

impl Program for Idle {
    fn activate(&mut self, _: &mut Robot<'_>) {}
}

/// Writes down what the witness says after each step, in milliseconds.
#[derive(Clone, Default)]
struct Watch(Arc<Mutex<Vec<(u64, u64)>>>);

impl Monitor for Watch {
    fn properties(&self) -> Vec<Name> {
        Vec::new()
    }

    fn observe(&mut self, witness: &dyn Witness, _: &mut Vec<Violation>) {
        let [now, calm] = [witness.now().0, witness.undisturbed().0].map(|time| time / 1_000_000);
        self.0.lock().unwrap().push((now, calm));
    }

    fn is_open(&self, _: usize) -> bool {
        false
    }
}

fn calm_times(faults: &[(u64, FaultKind)]) -> Vec<(u64, u64)> {
    let mut scenario = scenario("create", &[(0.0, 0.0), (2.0, 0.0)]);
    scenario.duration = Duration::from_seconds(1);
    scenario.physics.step = Duration::from_millis(50);
    scenario.faults.schedule = faults
        .iter()
        .map(|(millis, kind)| Fault {
            at: Time(millis * 1_000_000),
            kind: kind.clone(),
        })
        .collect();
    let watch = Watch::default();
    let mut run = Run::new(scenario, &|_| Ok(Box::new(Idle))).unwrap();
    run.add_monitor(Box::new(watch.clone()));
    while !run.is_over() {
        run.step();
    }
    watch.0.lock().unwrap().clone()
}

fn one() -> Vec<RobotId> {
    vec![RobotId(1)]
}

/// The value at a time.
fn at(times: &[(u64, u64)], millis: u64) -> u64 {
    let found = times.iter().find(|(now, _)| *now == millis);
    found.expect("it is the end of a step").1
}

#[test]
fn without_faults_it_is_the_time_since_the_start() {
    let times = calm_times(&[]);
    assert_eq!(times.len(), 20);
    assert!(times.iter().all(|(now, calm)| now == calm), "{times:?}");
}

#[test]
fn crashes_and_restarts_are_disturbances_but_not_the_time_between() {
    let times = calm_times(&[
        (300, FaultKind::Crash(one())),
        (700, FaultKind::Restart(one())),
    ]);
    assert_eq!(at(&times, 300), 300);
    assert_eq!(at(&times, 350), 50);
    assert_eq!(at(&times, 700), 400);
    assert_eq!(at(&times, 1000), 300);
}

#[test]
fn a_partition_is_a_disturbance() {
    let times = calm_times(&[
        (300, FaultKind::Partition(vec![one()])),
        (700, FaultKind::Heal),
    ]);
    assert_eq!([at(&times, 350), at(&times, 700)], [0, 0]);
    assert_eq!(at(&times, 1000), 300);
}

#[test]
fn nor_while_a_robot_cannot_move_or_sense() {
    for broken in [FaultKind::StuckMotor, FaultKind::FrozenSensor] {
        let times = calm_times(&[(300, broken(one())), (700, FaultKind::Repair(one()))]);
        assert_eq!([at(&times, 350), at(&times, 700)], [0, 0]);
        assert_eq!(at(&times, 1000), 300);
        // One that crashes has no other trouble.
        let times = calm_times(&[(300, broken(one())), (700, FaultKind::Crash(one()))]);
        assert_eq!([at(&times, 700), at(&times, 1000)], [0, 300]);
    }
}
