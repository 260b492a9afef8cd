//! The records of one mutex: holders and waiting robots of each resource.

use super::arbiters::{Arbiters, Fleet};
use super::{Bounds, FENCING, SAFETY};
use crate::{Excuse, Excused, Violation};
use starl_core::{RobotId, Time};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// A mutex.
#[derive(Clone, Debug, Default)]
pub(super) struct Locks {
    /// By resource: its holders, at most one. All except the last are doubtful or have been reported.
    holders: BTreeMap<Arc<str>, Vec<Holder>>,
    /// By resource: its last number, and the holder.
    numbers: BTreeMap<Arc<str>, (u64, RobotId)>,
    /// The same before a majority has forgotten it.
    forgotten: BTreeMap<Arc<str>, (u64, RobotId)>,
    /// By resource: all numbers that it was held with while clocks need not keep their bound.
    used: BTreeMap<Arc<str>, BTreeMap<u64, RobotId>>,
    pub(super) waiting: BTreeMap<RobotId, Waiting>,
    pub(super) arbiters: Arbiters,
}

#[derive(Clone, Copy, Debug)]
struct Holder {
    robot: RobotId,
    is_exclusive: bool,
    is_doubtful: bool,
}

/// The verdict on a robot's entry.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    /// Its number, with leases.
    pub number: Option<u64>,
    /// Whether no other robot may hold it.
    pub is_exclusive: bool,
    /// Whether some corrupted state may have led to it.
    pub is_doubtful: bool,
}

impl Locks {
    pub fn acquire(&mut self, robot: RobotId, resource: &str, at: Time) {
        // A robot that requests something holds nothing, even if it did before its state was
        // corrupted.
        for holders in self.holders.values_mut() {
            holders.retain(|holder| holder.robot != robot);
        }
        let resource = self.name(resource);
        let waiting = self
            .waiting
            .entry(robot)
            .or_insert_with(|| Waiting::new(at));
        waiting.resources.insert(resource);
    }

    pub fn withdraw(&mut self, robot: RobotId, resource: &str, at: Time) {
        if self.waiting.remove(&robot).is_some() {
            self.changed(&[resource], at);
        }
    }

    pub fn release(&mut self, robot: RobotId, resource: &str, at: Time) {
        if let Some(holders) = self.holders.get_mut(resource) {
            holders.retain(|holder| holder.robot != robot);
            self.changed(&[resource], at);
        }
    }

    pub fn enter(
        &mut self,
        robot: RobotId,
        resource: &str,
        at: Time,
        entry: Entry,
        excused: &mut Excused,
    ) -> Vec<Violation> {
        let mut found = Vec::new();
        let name = self.name(resource);
        if let Some(waiting) = self.waiting.get_mut(&robot) {
            waiting.resources.remove(resource);
            if waiting.resources.is_empty() {
                self.waiting.remove(&robot);
            }
        }
        self.changed(&[resource], at);
        self.overtake(robot, resource, at);
        let holders = self.holders.entry(name.clone()).or_default();
        holders.retain(|holder| {
            let is_other = holder.robot != robot;
            if is_other && holder.is_doubtful {
                excused.note(SAFETY, Excuse::Corruption);
            }
            is_other && !holder.is_doubtful
        });
        let excuse = |holder: &Holder| {
            let clocks = !(holder.is_exclusive && entry.is_exclusive);
            let clocks = clocks.then_some(Excuse::Clocks);
            entry.is_doubtful.then_some(Excuse::Corruption).or(clocks)
        };
        for excuse in holders.iter().filter_map(excuse) {
            excused.note(SAFETY, excuse);
        }
        let is_wrong = |holder: &&Holder| excuse(holder).is_none();
        if let Some(holder) = holders.iter().find(is_wrong) {
            found.push(Violation {
                property: SAFETY.into(),
                at,
                robots: vec![robot, holder.robot],
                text: format!(
                    "robot {robot} holds {resource} while robot {} does",
                    holder.robot
                ),
            });
        }
        holders.push(Holder {
            robot,
            is_exclusive: entry.is_exclusive,
            is_doubtful: entry.is_doubtful,
        });
        if let Some(number) = entry.number {
            found.extend(self.number((robot, number), name, at, entry, excused));
        }
        found
    }

    /// A robot holds something with a number: a greater one than before, or, where clocks may be so wrong that
    /// it comes late to hold what has been granted to another since, at least one of its own.
    fn number(
        &mut self,
        (robot, number): (RobotId, u64),
        resource: Arc<str>,
        at: Time,
        entry: Entry,
        excused: &mut Excused,
    ) -> Option<Violation> {
        let forgotten = self.forgotten.remove(&resource);
        if forgotten.is_some_and(|(last, _)| last >= number) {
            excused.note(FENCING, Excuse::NoMajority);
        }
        let before = if entry.is_exclusive {
            let last = self.numbers.insert(resource.clone(), (number, robot));
            last.filter(|&(last, _)| last >= number)
        } else {
            let used = self.used.entry(resource.clone()).or_default();
            used.insert(number, robot).map(|other| (number, other))
        };
        let (before, other) = before?;
        if entry.is_doubtful {
            excused.note(FENCING, Excuse::Corruption);
            return None;
        }
        Some(Violation {
            property: FENCING.into(),
            at,
            robots: vec![robot, other],
            text: format!(
                "robot {robot} holds {resource} with the number {number} after robot {other} held it with \
                 {before}"
            ),
        })
    }

    /// A robot holds and asks for nothing any more.
    pub fn forget(&mut self, robot: RobotId, at: Time) {
        let mut freed = Vec::new();
        for (resource, holders) in &mut self.holders {
            let before = holders.len();
            holders.retain(|holder| holder.robot != robot);
            if holders.len() < before {
                freed.push(resource.clone());
            }
        }
        if let Some(waiting) = self.waiting.remove(&robot) {
            freed.extend(waiting.resources);
        }
        let freed: Vec<&str> = freed.iter().map(|name| &**name).collect();
        self.changed(&freed, at);
    }

    /// A robot's state was overwritten: it may or may not hold its resources, and others may hold them too.
    pub fn doubt(&mut self, robot: RobotId, at: Time) {
        if let Some(waiting) = self.waiting.remove(&robot) {
            let names: Vec<&str> = waiting.resources.iter().map(|name| &**name).collect();
            self.changed(&names, at);
        }
        for holder in self.holders.values_mut().flatten() {
            holder.is_doubtful = true;
        }
        self.numbers.clear();
        self.forgotten.clear();
        self.used.clear();
    }

    /// The earlier numbers may be lost.
    pub fn forget_numbers(&mut self) {
        let mut numbers = core::mem::take(&mut self.numbers);
        self.forgotten.append(&mut numbers);
        self.used.clear();
    }

    /// Whether a robot holds it.
    pub fn is_held(&self, resource: &str) -> bool {
        self.holders
            .get(resource)
            .is_some_and(|holders| !holders.is_empty())
    }

    /// The requests whose deadline has passed; returns the time of the next check.
    pub fn look(
        &mut self,
        now: Time,
        bounds: Bounds,
        fleet: &Fleet<'_>,
        judged: (&mut Vec<Violation>, &mut Excused),
    ) -> Time {
        self.look_at_requests(now, bounds, fleet, judged)
    }

    /// A name that is kept once.
    fn name(&self, resource: &str) -> Arc<str> {
        match self.holders.get_key_value(resource) {
            Some((known, _)) => known.clone(),
            None => resource.into(),
        }
    }
}

/// A request.
#[derive(Clone, Debug)]
pub(super) struct Waiting {
    pub resources: BTreeSet<Arc<str>>,
    pub(super) since: Time,
    /// When something last happened that it may have waited for.
    pub(super) changed: Time,
    /// How often each robot has acquired the set that this one waits for.
    pub(super) overtaken: BTreeMap<RobotId, u32>,
    /// The time, and the robot that overtook it once too often.
    pub(super) starved: Option<(Time, RobotId)>,
    pub(super) is_reported: bool,
    /// Since when it waited for what it was excused for last.
    pub(super) excused: Option<Time>,
}

impl Waiting {
    pub fn new(since: Time) -> Waiting {
        Waiting {
            resources: BTreeSet::new(),
            since,
            changed: since,
            overtaken: BTreeMap::new(),
            starved: None,
            is_reported: false,
            excused: None,
        }
    }
}
