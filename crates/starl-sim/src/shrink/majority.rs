//! Whether a majority of the fleet is up and connected all the time.
//!
//! Many protocols promise less where it is not. So a failure without a majority and one with it are not the same.

use crate::Scenario;
use crate::scenario::FaultKind;
use starl_core::RobotId;

/// Whether the scheduled crashes and partitions leave at some time no majority that is up and connected.
pub(super) fn is_lost(scenario: &Scenario) -> bool {
    let robots = scenario.fleet.len();
    let mut is_down = vec![false; robots];
    let mut part = vec![0_usize; robots];
    let mut schedule: Vec<_> = scenario.faults.schedule.iter().collect();
    schedule.sort_by_key(|fault| fault.at);
    schedule.into_iter().any(|fault| {
        let mut set_down = |robots: &[RobotId], value| {
            for robot in robots {
                if let Some(is_down) = is_down.get_mut(robot.index()) {
                    *is_down = value;
                }
            }
        };
        match &fault.kind {
            FaultKind::Crash(robots) => set_down(robots, true),
            FaultKind::Restart(robots) => set_down(robots, false),
            FaultKind::Partition(parts) | FaultKind::OneWay(parts) => {
                part.fill(0);
                for (number, robots) in parts.iter().enumerate() {
                    for robot in robots {
                        if let Some(part) = part.get_mut(robot.index()) {
                            *part = number + 1;
                        }
                    }
                }
            }
            FaultKind::Heal => part.fill(0),
            _ => {}
        }
        let connected = |number: usize| {
            let robots = part.iter().zip(&is_down);
            robots
                .filter(|&(&part, &is_down)| part == number && !is_down)
                .count()
        };
        !part.iter().any(|&number| 2 * connected(number) > robots)
    })
}

/// The smallest fleet in which the failure of a scenario can be of the same kind. Where a majority was lost it has
/// three robots, since of two robots only both are a majority; where something happened that should not have, it
/// has two.
pub(super) fn least_robots(scenario: &Scenario, has_happened: bool) -> usize {
    let least = match (is_lost(scenario), has_happened) {
        (true, _) => 3,
        (false, true) => 2,
        (false, false) => 1,
    };
    scenario.fleet.len().min(least)
}
