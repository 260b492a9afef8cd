//! One registration: its participants, the lists that they show, and all lists.

use super::{AGREEMENT, EXCLUSION, SOUNDNESS};
use crate::Violation;
use starl_core::event::agreement::ListId;
use starl_core::{Duration, RobotId, Time};
use std::collections::{BTreeMap, BTreeSet};

/// As many of the latest lists are remembered; of older ones nothing is said.
const MOST_LISTS: usize = 256;

#[derive(Clone, Debug, Default)]
pub(super) struct Instance {
    pub robots: BTreeMap<RobotId, Life>,
    lists: BTreeMap<ListId, List>,
    /// The time of the last registration or departure.
    pub changed: Time,
    /// The time since which the robots that must agree do not.
    pub apart_since: Option<Time>,
    /// Whether it was reported that they do not agree.
    pub is_reported: bool,
}

/// The reports of a robot in its present life.
#[derive(Clone, Debug, Default)]
pub(super) struct Life {
    /// Counts the robot's lives.
    pub number: u32,
    /// Since when it takes part.
    pub registered: Option<Time>,
    /// Whether it does so with the whole fleet.
    pub with_all: bool,
    pub shown: Option<ListId>,
    /// Since when it has shown no list.
    pub without: Time,
    /// Whether that was reported.
    pub is_reported: bool,
    promised: Option<ListId>,
    /// How far the times of its lists are apart.
    apart: Duration,
}

#[derive(Clone, Debug, Default)]
struct List {
    members: Option<Vec<RobotId>>,
    /// The robots that have accepted it, with their lives.
    accepted: BTreeMap<RobotId, u32>,
    /// Whether some of what was said of it may have been missed or made up.
    is_doubtful: bool,
}

impl Instance {
    pub fn life(&mut self, robot: RobotId) -> &mut Life {
        self.robots.entry(robot).or_default()
    }

    pub fn registers(&mut self, robot: RobotId, at: Time, with_all: bool, apart: Duration) {
        let life = self.life(robot);
        life.registered = Some(at);
        life.with_all = with_all;
        life.without = at;
        life.apart = apart;
        self.changed = at;
    }

    pub fn leaves(&mut self, robot: RobotId, at: Time) {
        let life = self.life(robot);
        life.registered = None;
        life.shown = None;
        self.changed = at;
    }

    pub fn shows_none(&mut self, robot: RobotId, at: Time) {
        let life = self.life(robot);
        if life.shown.take().is_some() {
            life.without = at;
        }
    }

    /// A robot proposes or accepts a list.
    pub fn accepts(
        &mut self,
        robot: RobotId,
        id: ListId,
        at: Time,
        is_disturbed: bool,
        found: &mut Vec<Violation>,
    ) {
        self.shows_none(robot, at);
        let life = self.life(robot);
        if life.registered.is_none() {
            found.push(Violation::new(
                SOUNDNESS,
                at,
                [robot],
                format!("robot {robot} accepts a list and has not registered"),
            ));
        }
        let promised = life.promised.replace(id);
        if let Some(promised) = promised.filter(|promised| *promised != id)
            && id.time < promised.time + life.apart
        {
            let text = format!(
                "robot {robot} accepts the list of {} after that of {}, less than {} before",
                id.time, promised.time, life.apart
            );
            found.push(Violation::new(AGREEMENT, at, [robot], text));
        }
        let number = life.number;
        let list = self.lists.entry(id).or_default();
        list.accepted.insert(robot, number);
        list.is_doubtful |= is_disturbed;
        if self.lists.len() > MOST_LISTS {
            self.lists.pop_first();
        }
    }

    /// A robot shows a list from now on. Returns whether a violation may be due to a corruption.
    pub fn shows(
        &mut self,
        robot: RobotId,
        id: ListId,
        members: &[RobotId],
        at: Time,
        is_disturbed: bool,
        found: &mut Vec<Violation>,
    ) -> bool {
        let life = self.life(robot);
        life.shown = Some(id);
        life.is_reported = false;
        let Some(list) = self.lists.get_mut(&id) else {
            return false;
        };
        list.is_doubtful |= is_disturbed;
        let is_doubtful = list.is_doubtful;
        let known = list.members.get_or_insert_with(|| members.to_vec());
        if known != members {
            let text = format!(
                "robot {robot} shows another list of {} than others, by the same coordinator",
                id.time
            );
            found.push(Violation::new(AGREEMENT, at, [robot, id.coordinator], text));
        }
        let missing = members.iter().filter(|m| !list.accepted.contains_key(m));
        for &member in missing {
            let text = format!(
                "robot {robot} shows a list with robot {member}, which has not accepted it"
            );
            found.push(Violation::new(SOUNDNESS, at, [robot, member], text));
        }
        if !members.contains(&robot) {
            let text = format!("robot {robot} shows a list without itself");
            found.push(Violation::new(SOUNDNESS, at, [robot], text));
        }
        for both in self.in_two_lists(id, members) {
            let text = format!("robot {both} is in two lists of {}", id.time);
            found.push(Violation::new(AGREEMENT, at, [robot, both], text));
        }
        for &other in members.iter().filter(|other| **other != robot) {
            if self.exclude_each_other(robot, id, other) {
                let text =
                    format!("robots {robot} and {other} list each other, and show different lists");
                found.push(Violation::new(EXCLUSION, at, [robot, other], text));
            }
        }
        is_doubtful
    }

    /// The members of this list that are in a list of the same time by another coordinator, with any of their lives.
    fn in_two_lists(&self, id: ListId, members: &[RobotId]) -> Vec<RobotId> {
        let first = ListId {
            coordinator: RobotId(0),
            incarnation: 0,
            ..id
        };
        let others = self.lists.range(first..);
        let others = others.take_while(|(other, _)| other.time == id.time);
        let others =
            others.filter(|(other, list)| other.coordinator != id.coordinator && !list.is_doubtful);
        let theirs = others.filter_map(|(_, other)| other.members.as_ref());
        let of_both = theirs.flatten().filter(|robot| members.contains(robot));
        of_both.copied().collect()
    }

    /// Whether the other robot shows a different list than this one, and each lists the other's present
    /// life.
    fn exclude_each_other(&self, robot: RobotId, id: ListId, other: RobotId) -> bool {
        let lists = |id: &ListId, whom: RobotId| {
            let number = self.robots.get(&whom).map(|life| life.number);
            self.lists.get(id).is_some_and(|list| {
                !list.is_doubtful
                    && list.members.as_ref().is_some_and(|all| all.contains(&whom))
                    && list.accepted.get(&whom).copied() == number
            })
        };
        let theirs = self.robots.get(&other).and_then(|life| life.shown);
        theirs.is_some_and(|theirs| theirs != id && lists(&theirs, robot) && lists(&id, other))
    }

    /// A robot has lost all it knew.
    pub fn crashes(&mut self, robot: RobotId, at: Time) {
        if let Some(life) = self.robots.get_mut(&robot) {
            *life = Life {
                number: life.number + 1,
                ..Life::default()
            };
            self.changed = at;
        }
    }

    /// Every report may be due to a corruption from now on.
    pub fn doubts(&mut self) {
        for list in self.lists.values_mut() {
            list.is_doubtful = true;
        }
        for life in self.robots.values_mut() {
            life.promised = None;
        }
    }

    /// Something has changed: notes since when they do not agree.
    pub fn note_agreement(&mut self, at: Time) {
        if self.apart().is_empty() {
            self.apart_since = None;
            self.is_reported = false;
        } else {
            self.apart_since.get_or_insert(at);
        }
    }

    /// The robots that participate with the whole fleet and do not show the list of the first.
    pub fn apart(&self) -> Vec<RobotId> {
        let all = self.robots.iter();
        let mut all = all.filter(|(_, life)| life.registered.is_some() && life.with_all);
        let first = all.next().map(|(robot, life)| (*robot, life.shown));
        let Some((_, Some(list))) = first else {
            return first.map(|(robot, _)| robot).into_iter().collect();
        };
        let others = all.filter(|(_, life)| life.shown != Some(list));
        let others: BTreeSet<RobotId> = others.map(|(robot, _)| *robot).collect();
        others.into_iter().collect()
    }
}
