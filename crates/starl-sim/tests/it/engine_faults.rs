//! Robots and network fail, and recover, as the scenario says.

use crate::engine_support::{Chatter, Drive, count, exact_delay, run, scenario, simulate};
use starl_core::event;
use starl_core::event::DropReason;
use starl_core::{Command, Duration, Event, RobotId, Time};
use starl_sim::Scenario;
use starl_sim::scenario::{Fault, FaultKind};

fn fault(scenario: &mut Scenario, millis: u64, kind: FaultKind) {
    scenario.faults.schedule.push(Fault {
        at: Time::ZERO + Duration::from_millis(millis),
        kind,
    });
}

fn pair() -> Scenario {
    let mut scenario = scenario("create", &[(0.0, 0.0), (5.0, 0.0)]);
    exact_delay(&mut scenario, 10);
    scenario
}

#[test]
fn a_crashed_robot_hears_nothing_and_says_nothing_until_it_restarts() {
    let mut scenario = pair();
    fault(&mut scenario, 1000, FaultKind::Crash(vec![RobotId(1)]));
    fault(&mut scenario, 2000, FaultKind::Restart(vec![RobotId(1)]));
    fault(&mut scenario, 3000, FaultKind::Crash(vec![RobotId(0)]));
    let mut simulation = simulate(scenario, Chatter::default());
    let heard = |event: &Event| matches!(event, Event::Program { .. });
    assert_eq!(count(&run(&mut simulation, 1.0), heard), 10);
    let down = run(&mut simulation, 1.0);
    assert_eq!(count(&down, heard), 0);
    let lost = |event: &Event| {
        matches!(
            event,
            Event::Dropped {
                reason: DropReason::Down,
                ..
            }
        )
    };
    assert_eq!(count(&down, lost), 10);
    assert_eq!(count(&run(&mut simulation, 1.0), heard), 10);
    assert_eq!(
        count(&run(&mut simulation, 1.0), |event| matches!(
            event,
            Event::Sent { .. }
        )),
        0
    );
    assert_eq!(simulation.progress().up, 1);
}

#[test]
fn a_restarted_robot_has_forgotten_everything() {
    let mut scenario = pair();
    fault(&mut scenario, 1000, FaultKind::Crash(vec![RobotId(0)]));
    fault(&mut scenario, 1100, FaultKind::Restart(vec![RobotId(0)]));
    let records = run(&mut simulate(scenario, Chatter::default()), 1.15);
    let payloads: Vec<u8> = records
        .iter()
        .filter_map(|record| match &record.event {
            Event::Sent { payload, .. } => Some(payload[0]),
            _ => None,
        })
        .collect();
    assert_eq!(payloads, [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 0]);
}

/// Checkers count on it: what is on record of a robot after it has crashed is of its next life.
#[test]
fn a_robot_that_restarts_within_the_step_of_its_crash_was_down_before() {
    for step in [1000, 1050] {
        let mut scenario = pair();
        scenario.physics.step = Duration::from_millis(50);
        let (crash, restart) = (step + 1, step + 30);
        fault(&mut scenario, crash, FaultKind::Crash(vec![RobotId(1)]));
        fault(&mut scenario, restart, FaultKind::Restart(vec![RobotId(1)]));
        let records = run(&mut simulate(scenario, Chatter::default()), 2.0);
        let down =
            Time::ZERO + Duration::from_millis(crash)..Time::ZERO + Duration::from_millis(restart);
        let does = |event: &Event| matches!(event, Event::Program { .. } | Event::Estimated(_));
        let mut early = records.iter().filter(|record| {
            record.robot == Some(RobotId(1)) && down.contains(&record.at) && does(&record.event)
        });
        assert_eq!(early.next(), None, "{step}");
        assert!(count(&records, |event| matches!(event, Event::Program { .. })) >= 18);
    }
}

#[test]
fn a_partition_keeps_its_parts_apart_until_it_heals() {
    let mut scenario = pair();
    fault(
        &mut scenario,
        1000,
        FaultKind::Partition(vec![vec![RobotId(0)]]),
    );
    fault(&mut scenario, 2000, FaultKind::Heal);
    let mut simulation = simulate(scenario, Chatter::default());
    let heard = |event: &Event| matches!(event, Event::Program { .. });
    assert_eq!(count(&run(&mut simulation, 1.0), heard), 10);
    assert_eq!(count(&run(&mut simulation, 1.0), heard), 0);
    assert_eq!(count(&run(&mut simulation, 1.0), heard), 10);
}

#[test]
fn robots_that_are_cut_off_in_one_direction_hear_and_are_not_heard() {
    // Robot 0 speaks.
    for (cut, heard_meanwhile) in [(0, 0), (1, 10)] {
        let mut scenario = pair();
        let groups = vec![vec![RobotId(cut)]];
        fault(&mut scenario, 1000, FaultKind::OneWay(groups));
        fault(&mut scenario, 2000, FaultKind::Heal);
        let mut simulation = simulate(scenario, Chatter::default());
        let heard = |event: &Event| matches!(event, Event::Program { .. });
        assert_eq!(count(&run(&mut simulation, 1.0), heard), 10);
        assert_eq!(count(&run(&mut simulation, 1.0), heard), heard_meanwhile);
        assert_eq!(count(&run(&mut simulation, 1.0), heard), 10);
    }
}

#[test]
fn stuck_motors_stand_still_until_repaired() {
    let mut scenario = pair();
    fault(&mut scenario, 1000, FaultKind::StuckMotor(vec![RobotId(0)]));
    fault(&mut scenario, 2000, FaultKind::Repair(vec![RobotId(0)]));
    let mut simulation = simulate(scenario, Drive(Command::Straight { speed: 0.1 }));
    run(&mut simulation, 1.0);
    let stuck_at = simulation.state(RobotId(0)).pose;
    run(&mut simulation, 1.0);
    assert_eq!(simulation.state(RobotId(0)).pose, stuck_at);
    run(&mut simulation, 1.0);
    assert!(simulation.state(RobotId(0)).pose.position.x > stuck_at.position.x + 0.05);
}

#[test]
fn frozen_sensors_repeat_themselves_while_the_robot_moves_on() {
    let mut scenario = pair();
    fault(
        &mut scenario,
        1000,
        FaultKind::FrozenSensor(vec![RobotId(0)]),
    );
    let mut simulation = simulate(scenario, Drive(Command::Straight { speed: 0.1 }));
    run(&mut simulation, 1.1);
    let believed = *simulation.estimate(RobotId(0));
    run(&mut simulation, 1.0);
    assert_eq!(*simulation.estimate(RobotId(0)), believed);
    assert!(simulation.state(RobotId(0)).pose.position.x > believed.pose.position.x + 0.09);
}

#[test]
fn corruption_changes_the_programs_variables() {
    let mut scenario = pair();
    fault(
        &mut scenario,
        1000,
        FaultKind::CorruptState(vec![RobotId(0)]),
    );
    let records = run(&mut simulate(scenario, Chatter::default()), 1.1);
    let last = records.iter().rev().find_map(|record| match &record.event {
        Event::Sent { payload, .. } => Some(u32::from_le_bytes(payload[..].try_into().ok()?)),
        _ => None,
    });
    assert!(last.is_some_and(|count| count >= 1_000_000));
}

#[test]
fn random_crashes_have_their_rate_and_end() {
    let places: Vec<(f64, f64)> = (0..100).map(|i| (f64::from(i), 0.0)).collect();
    let mut scenario = scenario("create", &places);
    scenario.faults.rates.crash = 0.02;
    scenario.faults.rates.restart_after = Duration::from_seconds(2);
    let mut simulation = simulate(scenario, Drive(Command::Stop));
    let records = run(&mut simulation, 55.0);
    let told = |what: event::Fault| {
        let is_it = |event: &Event| matches!(event, Event::Fault(fault) if *fault == what);
        count(&records, is_it)
    };
    // 100 robots for 55 s at 0.02 a second.
    let crashes = told(event::Fault::Crash);
    assert!((80..=140).contains(&crashes), "{crashes} crashes");
    assert!(told(event::Fault::Restart) >= crashes - 10);
}
