//! Robots crash; most of them restart. A majority is up at any time.

use super::Trouble;
use crate::scenario::FaultKind;
use starl_core::{RobotId, Time};

/// From when to when a robot is down.
struct Outage {
    robot: RobotId,
    from: Time,
    /// [`Time::NEVER`] for one that does not restart.
    to: Time,
}

impl Outage {
    fn overlaps(&self, other: &Outage) -> bool {
        self.from <= other.to && other.from <= self.to
    }
}

/// Up to as many crashes as there are robots. One in four is for ever.
pub(super) fn crash(trouble: &mut Trouble<'_>) {
    let robots = trouble.robots();
    let most_down = robots.len().saturating_sub(1) / 2;
    if most_down == 0 {
        return;
    }
    let wanted = trouble.count(1, robots.len() as u32);
    let mut outages: Vec<Outage> = Vec::new();
    for _ in 0..wanted {
        let from = trouble.moment();
        let to = match trouble.random.chance(0.25) {
            true => Time::NEVER,
            false => (from + trouble.span(0.01, 0.4)).min(trouble.until),
        };
        let robot = trouble.one(&robots);
        let outage = Outage { robot, from, to };
        // The greatest number that is down at any moment of it.
        let meanwhile = outages.iter().filter(|other| other.overlaps(&outage));
        let again = outages
            .iter()
            .any(|other| other.robot == robot && other.overlaps(&outage));
        if !again && meanwhile.count() < most_down {
            outages.push(outage);
        }
    }
    for Outage { robot, from, to } in outages {
        trouble.add(from, FaultKind::Crash(vec![robot]));
        if to != Time::NEVER {
            trouble.add(to, FaultKind::Restart(vec![robot]));
        }
    }
}
