//! The robots that have reported that they are ready to grant, and the time from which a request must be granted.
//!
//! With leases a majority that works, is ready and connected with the robot suffices, whichever other robots
//! are down. With permissions and quorums all robots are needed.

use crate::Excuse;
use crate::health::Health;
use crate::parts::Parts;
use starl_core::{RobotId, Time};
use std::collections::BTreeMap;

/// The arbiters of a mutex; none with permissions.
#[derive(Clone, Debug, Default)]
pub(super) struct Arbiters {
    /// How many robots take part, and how many of them have to be ready.
    participants: u32,
    needed: u32,
    /// The robots that know their grants, since when, and the number of participants then.
    ready: BTreeMap<RobotId, (Time, u32)>,
    /// Whether so few have known it at some moment that possibly no robot knows the last number.
    may_have_forgotten: bool,
}

/// The state of all robots.
pub(super) struct Fleet<'a> {
    pub robots: u32,
    pub health: &'a Health,
    pub parts: &'a Parts,
    /// When a state was overwritten last; zero if none was.
    pub corrupted: Time,
}

impl Fleet<'_> {
    /// Since when all have been well and together, and why not before.
    fn well_since(&self) -> (Time, Excuse) {
        let all = || (0..self.robots).map(RobotId);
        let together = all().map(|robot| self.parts.together_since(RobotId(0), robot));
        let parted = together.max().map(|since| (since, Excuse::Partition));
        let unwell = all().map(|robot| self.unwell(robot));
        let last = unwell.chain(parted).max();
        last.unwrap_or((Time::ZERO, Excuse::Recovery))
    }

    fn unwell(&self, robot: RobotId) -> (Time, Excuse) {
        (self.health.well_from(robot), self.health.excuse(robot))
    }
}

impl Arbiters {
    /// A robot knows its grants; `anew` says whether earlier numbers may be forgotten.
    pub fn ready(
        &mut self,
        robot: RobotId,
        at: Time,
        participants: u32,
        needed: u32,
        is_anew: bool,
    ) -> bool {
        self.participants = participants;
        self.needed = needed;
        self.ready.insert(robot, (at, participants));
        is_anew && core::mem::take(&mut self.may_have_forgotten)
    }

    /// A robot has lost its grants.
    pub fn forgot(&mut self, robot: RobotId) {
        if self.ready.remove(&robot).is_some() {
            let few = self.ready.len() as u32 + self.needed <= self.participants;
            self.may_have_forgotten |= few;
        }
    }

    /// The time since which the conditions for granting a robot's request are met, and the reason why not before.
    pub fn well_since(&self, robot: RobotId, fleet: &Fleet<'_>) -> (Time, Excuse) {
        if self.needed >= self.participants {
            return fleet.well_since();
        }
        let since = |(&arbiter, &(ready, participants)): (&RobotId, &(Time, u32))| {
            let (well, _) = fleet.unwell(arbiter);
            let together = fleet.parts.together_since(robot, arbiter);
            (participants == self.participants).then(|| ready.max(well).max(together))
        };
        let mut since: Vec<Time> = self.ready.iter().filter_map(since).collect();
        since.sort_unstable();
        let needed = since.get(self.needed as usize - 1);
        let majority = needed.copied().unwrap_or(Time::NEVER);
        let corrupted = (fleet.corrupted, Excuse::Corruption);
        let own = fleet.unwell(robot).max(corrupted);
        own.max((majority, Excuse::NoMajority))
    }
}
