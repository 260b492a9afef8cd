//! Requests that wait, and whether they wait too long.
//!
//! Requests that overlap, directly or through others, wait for each other. As long as a robot holds a
//! resource that one of them asks for, all of them may wait for that. When no robot does, one of them must be
//! granted within the bound; a request without overlap must be granted itself (non-interference). Of robots
//! that wait for the same resource, none may be granted it repeatedly while another waits.
//!
//! The arbiters determine which robots must work and be connected meanwhile: see
//! [`super::arbiters`].

use super::arbiters::Fleet;
use super::locks::Locks;
use super::{Bounds, NON_INTERFERENCE, PROGRESS};
use crate::{Excuse, Excused, Violation, robot_list};
use starl_core::{RobotId, Time};
use std::collections::{BTreeMap, BTreeSet};

/// So often another may be granted what one waits for, as messages that cross can be ordered either way.
const MOST_OVERTAKEN: u32 = 100;

impl Locks {
    /// The state of these resources has changed: all requests that wait for them, directly or through others,
    /// may have waited for that.
    pub(super) fn changed(&mut self, resources: &[&str], at: Time) {
        if self.waiting.is_empty() {
            return;
        }
        let group = self.group(&mut resources.iter().copied().collect());
        for robot in group {
            if let Some(waiting) = self.waiting.get_mut(&robot) {
                waiting.changed = at;
            }
        }
    }

    /// A robot has got a resource.
    pub(super) fn overtake(&mut self, robot: RobotId, resource: &str, at: Time) {
        for (&other, waiting) in &mut self.waiting {
            if other != robot && waiting.resources.contains(resource) {
                let count = waiting.overtaken.entry(robot).or_default();
                *count += 1;
                if *count > MOST_OVERTAKEN {
                    waiting.starved.get_or_insert((at, robot));
                }
            }
        }
    }

    /// Reports what waits too long; gives when to look again.
    pub(super) fn look_at_requests(
        &mut self,
        now: Time,
        bounds: Bounds,
        fleet: &Fleet<'_>,
        (found, excused): (&mut Vec<Violation>, &mut Excused),
    ) -> Time {
        let mut next = Time::NEVER;
        if self.waiting.is_empty() {
            return next;
        }
        let waiting = self.waiting.keys();
        let well = waiting.map(|&robot| (robot, self.arbiters.well_since(robot, fleet)));
        let well: BTreeMap<RobotId, (Time, Excuse)> = well.collect();
        let mut left: BTreeSet<RobotId> = self.waiting.keys().copied().collect();
        while let Some(first) = left.first().copied() {
            let resources = self.waiting[&first].resources.iter();
            let mut reached: BTreeSet<&str> = resources.map(|name| &**name).collect();
            let group = self.group(&mut reached);
            let is_held = reached.iter().any(|resource| self.is_held(resource));
            left.retain(|robot| !group.contains(robot));
            left.remove(&first);
            self.look_for_overtaken(&group, &well, found);
            if is_held {
                continue;
            }
            let (property, bound, why) = match group.len() {
                1 => (
                    NON_INTERFERENCE,
                    bounds.alone,
                    "though no other robot holds or requests any of it",
                ),
                _ => (PROGRESS, bounds.among, "though no robot holds any of it"),
            };
            let changes = group.iter().map(|robot| self.waiting[robot].changed);
            // A newcomer does not excuse earlier robots, and a robot that cannot continue does not excuse those
            // that can.
            let changed = changes.min().unwrap_or(now);
            let since = |robot: &RobotId| self.waiting[robot].changed.max(well[robot].0);
            let latest = group.iter().map(since).min().unwrap_or(now);
            let due = match latest {
                Time::NEVER => now + bound,
                latest => latest + bound,
            };
            if due >= now {
                next = next.min(due);
                if changed + bound >= now {
                    next = next.min(changed + bound);
                } else if let Some(waiting) = self.waiting.get_mut(&first)
                    && waiting.excused.replace(changed) != Some(changed)
                {
                    excused.note(property, well[&first].1);
                }
                continue;
            }
            let waits = |robot: &&RobotId| since(robot) <= latest;
            let late: Vec<RobotId> = group.iter().filter(waits).copied().collect();
            let is_reported = |robot: &RobotId| self.waiting[robot].is_reported;
            if late.is_empty() || late.iter().any(is_reported) {
                continue;
            }
            found.push(Violation {
                property: property.into(),
                at: due,
                text: format!(
                    "{} did not get the requested resources within {bound}, {why}",
                    robot_list(&late)
                ),
                robots: late.clone(),
            });
            for robot in late {
                if let Some(waiting) = self.waiting.get_mut(&robot) {
                    waiting.is_reported = true;
                }
            }
        }
        next
    }

    fn look_for_overtaken(
        &mut self,
        group: &[RobotId],
        well: &BTreeMap<RobotId, (Time, Excuse)>,
        found: &mut Vec<Violation>,
    ) {
        for &robot in group {
            let Some(waiting) = self.waiting.get_mut(&robot) else {
                continue;
            };
            if well[&robot].0 > waiting.since {
                waiting.overtaken.clear();
                waiting.starved = None;
            }
            if let Some((at, other)) = waiting.starved.take()
                && !waiting.is_reported
            {
                waiting.is_reported = true;
                found.push(Violation {
                    property: PROGRESS.into(),
                    at,
                    robots: vec![robot, other],
                    text: format!(
                        "robot {robot} waits while robot {other} was granted the same more than \
                         {MOST_OVERTAKEN} times"
                    ),
                });
            }
        }
    }

    /// All whose requests overlap with these resources, directly or through others; the resources become all
    /// that they ask for.
    fn group<'a>(&'a self, resources: &mut BTreeSet<&'a str>) -> Vec<RobotId> {
        let mut group = Vec::new();
        loop {
            let before = group.len();
            for (&robot, waiting) in &self.waiting {
                let overlaps = || {
                    waiting
                        .resources
                        .iter()
                        .any(|name| resources.contains(&**name))
                };
                if !group.contains(&robot) && overlaps() {
                    resources.extend(waiting.resources.iter().map(|name| &**name));
                    group.push(robot);
                }
            }
            if group.len() == before {
                return group;
            }
        }
    }
}
