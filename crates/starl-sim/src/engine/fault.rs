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
    type Make = fn(Vec<RobotId>) -> FaultKind;
    /// The time until the end of a fault, and the end; none for a fault that does not end.
    type End = Option<(Duration, Make)>;
    let repair: End = Some((rates.repair_after, FaultKind::Repair));
    let restart: End = Some((rates.restart_after, FaultKind::Restart));
    let of_one: [(u64, Make, f64, End); 4] = [
        (1, FaultKind::Crash, rates.crash, restart),
        (2, FaultKind::StuckMotor, rates.stuck_motor, repair),
        (3, FaultKind::FrozenSensor, rates.frozen_sensor, repair),
        (4, FaultKind::CorruptState, rates.corrupt_state, None),
    ];
    for &robot in &robots {
        for (purpose, begin, rate, end) in of_one {
            draw(purpose, robot.0.into(), rate, &mut |at, _| {
                let kind = begin(vec![robot]);
                faults.push(Fault { at, kind });
                if let Some((after, end)) = end.filter(|(after, _)| !after.is_zero()) {
                    let (at, kind) = (at + after, end(vec![robot]));
                    faults.push(Fault { at, kind });
                }
            });
        }
    }
    draw(5, 0, rates.partition, &mut |at, random| {
        let half = robots
            .iter()
            .copied()
            .filter(|_| random.chance(0.5))
            .collect();
        let kind = FaultKind::Partition(vec![half]);
        faults.push(Fault { at, kind });
        if !rates.heal_after.is_zero() {
            let (at, kind) = (at + rates.heal_after, FaultKind::Heal);
            faults.push(Fault { at, kind });
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
