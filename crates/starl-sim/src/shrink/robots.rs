//! A scenario with fewer robots.

use crate::Scenario;
use crate::scenario::{Fault, FaultKind, LinkOverride};
use starl_core::RobotId;

/// The scenario with only these of its robots, by number and in ascending order. They are renumbered, and
/// so are the names within a group; faults and links of the others are removed. References to robots in
/// the parameters of programs stay unchanged.
pub fn keep_robots(scenario: &Scenario, kept: &[usize]) -> Scenario {
    let mut smaller = scenario.clone();
    let mut number = 0;
    for group in &mut smaller.fleet.groups {
        group.starts.retain(|_| {
            number += 1;
            kept.binary_search(&(number - 1)).is_ok()
        });
    }
    smaller
        .fleet
        .groups
        .retain(|group| !group.starts.is_empty());
    let new = |robots: &[RobotId]| -> Vec<RobotId> {
        let new = robots
            .iter()
            .filter_map(|robot| kept.binary_search(&robot.index()).ok());
        new.map(|number| RobotId(number as u32)).collect()
    };
    let schedule = scenario.faults.schedule.iter();
    smaller.faults.schedule = schedule
        .filter_map(|fault| renumbered(fault, &new))
        .collect();
    let overrides = scenario.network.overrides.iter();
    let overrides = overrides.filter_map(|entry| {
        let of = |robots: &Option<Vec<RobotId>>| robots.as_deref().map(new);
        let (from, to) = (of(&entry.from), of(&entry.to));
        let is_of_nobody =
            |robots: &Option<Vec<RobotId>>| robots.as_ref().is_some_and(Vec::is_empty);
        (!is_of_nobody(&from) && !is_of_nobody(&to)).then_some(LinkOverride {
            from,
            to,
            link: entry.link,
        })
    });
    smaller.network.overrides = overrides.collect();
    smaller.fit_avoidance();
    smaller
}

/// A fault of robots with new numbers; none if no robot remains.
fn renumbered(fault: &Fault, new: &dyn Fn(&[RobotId]) -> Vec<RobotId>) -> Option<Fault> {
    let manned = |parts: &[Vec<RobotId>]| -> Vec<Vec<RobotId>> {
        let parts = parts.iter().map(|part| new(part));
        parts.filter(|part| !part.is_empty()).collect()
    };
    let mut fault = fault.clone();
    if let FaultKind::Partition(parts) | FaultKind::OneWay(parts) = &mut fault.kind {
        *parts = manned(parts);
    } else if let Some(robots) = fault.kind.robots_mut() {
        *robots = new(robots);
    }
    let is_nobodys = fault.kind.robots().is_some_and(<[_]>::is_empty);
    (!is_nobodys).then_some(fault)
}
