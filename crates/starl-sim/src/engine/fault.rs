//! The faults with their times: the schedule, with the seeded random faults drawn into it.

use super::{Stream, stream};
use crate::scenario::{Fault, FaultKind, Scenario};
use starl_core::event::{self, Event};
use starl_core::{Duration, Random, RobotId, Time};

/// All faults of a run in the order of their times. Faults of the same time keep the order of the scenario, followed by
/// random ones.
pub fn timeline(scenario: &Scenario) -> Vec<Fault> {
    let mut faults = scenario.faults.schedule.clone();
    let rates = &scenario.faults.rates;
    let end = Time::ZERO + scenario.duration;
    let draw = |purpose: u64, robot: u64, rate: f64, make: &mut dyn FnMut(Time, &mut Random)| {
        if rate <= 0.0 {
            return;
        }
        let mut random = stream(scenario.seed, Stream::Faults, &[purpose, robot]);
        let mut at = Time::ZERO;
        loop {
            at += Duration::from_seconds_f64(random.exponential(1.0 / rate));
            if at >= end {
                return;
            }
            make(at, &mut random);
        }
    };
    let robots: Vec<RobotId> = (0..scenario.fleet.len() as u32).map(RobotId).collect();
    for &robot in &robots {
        let id = u64::from(robot.0);
        let mut both = |at: Time, kind: FaultKind, after: Duration, end: FaultKind| {
            faults.push(Fault { at, kind });
            if !after.is_zero() {
                faults.push(Fault {
                    at: at + after,
                    kind: end,
                });
            }
        };
        let one = || vec![robot];
        draw(1, id, rates.crash, &mut |at, _| {
            both(
                at,
                FaultKind::Crash(one()),
                rates.restart_after,
                FaultKind::Restart(one()),
            );
        });
        draw(2, id, rates.stuck_motor, &mut |at, _| {
            both(
                at,
                FaultKind::StuckMotor(one()),
                rates.repair_after,
                FaultKind::Repair(one()),
            );
        });
        draw(3, id, rates.frozen_sensor, &mut |at, _| {
            both(
                at,
                FaultKind::FrozenSensor(one()),
                rates.repair_after,
                FaultKind::Repair(one()),
            );
        });
        draw(4, id, rates.corrupt_state, &mut |at, _| {
            both(
                at,
                FaultKind::CorruptState(one()),
                Duration::ZERO,
                FaultKind::Heal,
            );
        });
    }
    draw(5, 0, rates.partition, &mut |at, random| {
        let half = robots
            .iter()
            .copied()
            .filter(|_| random.chance(0.5))
            .collect();
        faults.push(Fault {
            at,
            kind: FaultKind::Partition(vec![half]),
        });
        if !rates.heal_after.is_zero() {
            faults.push(Fault {
                at: at + rates.heal_after,
                kind: FaultKind::Heal,
            });
        }
    });
    faults.sort_by_key(|fault| fault.at);
    faults
}

/// The event of a fault in traces.
pub fn event(kind: &FaultKind) -> Event {
    Event::Fault(match kind {
        FaultKind::Crash(_) => event::Fault::Crash,
        FaultKind::Restart(_) => event::Fault::Restart,
        FaultKind::Partition(_) => event::Fault::Partition,
        FaultKind::OneWay(_) => event::Fault::OneWay,
        FaultKind::Heal => event::Fault::Heal,
        FaultKind::StuckMotor(_) => event::Fault::StuckMotor,
        FaultKind::FrozenSensor(_) => event::Fault::FrozenSensor,
        FaultKind::Repair(_) => event::Fault::Repair,
        FaultKind::CorruptState(_) => event::Fault::CorruptState,
    })
}

/// Each robot's part of a network partitioned so; those in no group form part 0.
pub fn parts(groups: &[Vec<RobotId>], robots: usize) -> Vec<u32> {
    let mut parts = vec![0; robots];
    for (group, members) in groups.iter().enumerate() {
        for robot in members {
            parts[robot.index()] = group as u32 + 1;
        }
    }
    parts
}
