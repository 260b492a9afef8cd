//! Faults of one robot each, at round times.

use super::Search;
use crate::Scenario;
use crate::scenario::Fault;
use starl_core::Time;

/// Takes faults of several robots apart, so that each can be left out. The run stays the same.
pub(super) fn one_by_one(scenario: &mut Scenario) {
    let schedule = std::mem::take(&mut scenario.faults.schedule);
    scenario.faults.schedule = schedule.into_iter().flat_map(apart).collect();
}

fn apart(mut fault: Fault) -> Vec<Fault> {
    let Some(robots) = fault.kind.robots_mut().map(std::mem::take) else {
        return vec![fault];
    };
    let one = |robot| {
        let mut fault = fault.clone();
        fault
            .kind
            .robots_mut()
            .into_iter()
            .for_each(|robots| robots.push(robot));
        fault
    };
    robots.into_iter().map(one).collect()
}

/// Round times, nanoseconds.
const ROUND: [u64; 3] = [1_000_000_000, 100_000_000, 10_000_000];

impl Search<'_> {
    /// Moves faults to rounder times.
    pub(super) fn rounder(&mut self) -> bool {
        let mut any = false;
        for index in 0..self.best.faults.schedule.len() {
            for grain in ROUND {
                let mut candidate = self.best.clone();
                let Some(fault) = candidate.faults.schedule.get_mut(index) else {
                    break;
                };
                let at = Time(fault.at.0 / grain * grain);
                if at == fault.at {
                    break;
                }
                fault.at = at;
                candidate.faults.schedule.sort_by_key(|fault| fault.at);
                if self.propose(candidate) {
                    any = true;
                    break;
                }
            }
        }
        any
    }
}
