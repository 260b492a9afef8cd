//! A monitor judges the variables of programs and the true positions of robots after every step; its violations are
//! reported like any other.

use crate::engine_support::scenario;
use starl_core::event::Name;
use starl_core::{Duration, Event, Primitives, Program, Robot, Time};
use starl_properties::{Monitor, Violation, Witness};
use starl_sim::scenario::{Fault, FaultKind};
use starl_sim::{Outcome, Run};
use std::any::Any;

/// Counts its activations; the robots' number 1 fails at its third.
#[derive(Clone, Default, Primitives)]
struct Counter(u32);

impl Program for Counter {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        self.0 += 1;
        if self.0 == 3 && robot.id().0 == 1 {
            robot.fail("it cannot continue");
        }
    }

    fn inspect(&self) -> Option<&dyn Any> {
        Some(self)
    }
}

/// No robot counts beyond a limit; and one day all are down.
#[derive(Clone)]
struct Limit {
    limit: u32,
    seen: Vec<Vec<(u32, bool)>>,
    found: bool,
    all_down: bool,
}

impl Monitor for Limit {
    fn properties(&self) -> Vec<Name> {
        vec!["limit".into(), format!("all {}", "down").into()]
    }

    fn observe(&mut self, witness: &dyn Witness, violations: &mut Vec<Violation>) {
        let robots = witness.robots().iter();
        let counts = robots.clone().map(|&robot| {
            let program = witness.program(robot).expect("it shows itself");
            let Counter(count) = program.downcast_ref().expect("it is a counter");
            assert_eq!(witness.pose(robot).unwrap().position.z, 0.0);
            (*count, witness.is_up(robot))
        });
        self.seen.push(counts.collect());
        self.all_down |= robots.clone().all(|&robot| !witness.is_up(robot));
        for (&robot, (count, _)) in robots.zip(self.seen.last().unwrap()) {
            if *count > self.limit && !self.found {
                self.found = true;
                violations.push(Violation {
                    property: "limit".into(),
                    at: witness.now(),
                    robots: vec![robot],
                    text: format!("robot {robot} counts {count}"),
                });
            }
        }
    }

    fn is_open(&self, property: usize) -> bool {
        property == 1 && !self.all_down
    }
}

fn run(limit: u32) -> Run {
    let mut scenario = scenario("create", &[(0.0, 0.0), (2.0, 0.0)]);
    scenario.duration = Duration::from_seconds(1);
    scenario.faults.schedule = vec![Fault {
        at: Time(550_000_000),
        kind: FaultKind::Crash(vec![starl_core::RobotId(0)]),
    }];
    let mut run = Run::new(scenario, &|_| Ok(Box::<Counter>::default())).unwrap();
    run.add_monitor(Box::new(Limit {
        limit,
        seen: Vec::new(),
        found: false,
        all_down: false,
    }));
    run
}

#[test]
fn a_violation_is_reported_with_time_robot_and_state() {
    let mut run = run(3);
    let mut told = Vec::new();
    while !run.is_over() {
        let records = run.step().iter().cloned();
        told.extend(records.filter(|record| matches!(record.event, Event::Violated { .. })));
    }
    let [violation] = run.violations() else {
        panic!("not one violation: {:?}", run.violations());
    };
    // The fourth activation is at 300 ms, and the step that takes it in ends 25 ms later.
    assert_eq!(violation.at, Time(325_000_000));
    assert_eq!(violation.text, "robot 0 counts 4");
    let [record] = &told[..] else {
        panic!("not one record: {told:?}");
    };
    assert_eq!(record.at, violation.at);
    assert_eq!(record.robot, Some(starl_core::RobotId(0)));
    let verdicts = run.verdicts();
    let limit = verdicts.iter().find(|v| v.property == "limit").unwrap();
    assert_eq!((limit.violations, limit.open), (1, false));
    assert_eq!(limit.first.as_ref(), Some(violation));
}

#[test]
fn open_properties_have_their_own_verdict() {
    let mut run = run(100);
    while !run.is_over() {
        run.step();
    }
    let verdicts = run.verdicts();
    let last = verdicts.last().unwrap();
    assert_eq!(
        (&*last.property, last.violations, last.open),
        ("all down", 0, true)
    );
    assert!(verdicts[..verdicts.len() - 1].iter().all(|v| !v.open));
}

#[test]
fn a_program_that_failed_is_named_with_its_reason() {
    let mut run = run(100);
    while !run.is_over() {
        run.step();
    }
    let [failure] = run.failures() else {
        panic!("not one failure: {:?}", run.failures());
    };
    assert_eq!(failure.robot, starl_core::RobotId(1));
    assert_eq!(failure.at, Time(200_000_000));
    assert_eq!(failure.text, "it cannot continue");
    assert_eq!(run.outcome(), Outcome::Failed);
}
