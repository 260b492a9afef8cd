//! Agreement in total order, with a bound: a broadcast of a robot in a majority of the fleet is delivered to all of
//! that majority.
//!
//! The bound starts when the message was sent, or after the last fault, whichever is later. It is judged for
//! robots that work then and are in one part with the sender, if they are a majority. Robots that have
//! entered the order after the message was sent, or report a gap, are not judged; those that never enter it are.

use super::AGREEMENT;
use crate::health::{Health, Needs};
use crate::parts::Parts;
use crate::report::MessageKey;
use crate::{Excuse, Excused, Violation, robot_list};
use starl_core::event::{Event, Fault};
use starl_core::{Duration, Port, Record, RobotId, Time};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// A fault is got over after this time: another leader is elected, a robot let in again.
const RECOVERY: Duration = Duration::from_seconds(30);

#[derive(Clone, Debug)]
pub(super) struct Agreement {
    robots: u32,
    bound: Duration,
    health: Health,
    parts: Parts,
    /// When the last fault set in or ended.
    last_fault: Option<Time>,
    /// Since when each robot has been in the order of an instance.
    joined: BTreeMap<(Port, RobotId), Time>,
    /// The robots that delivered each message, and the time when it was sent.
    handed: BTreeMap<MessageKey, (Time, BTreeSet<RobotId>)>,
    /// By when it is judged, in that order.
    due: VecDeque<(Time, MessageKey)>,
    /// The robots that vote in the present group of each instance.
    voters: BTreeSet<(Port, RobotId)>,
    down: BTreeSet<RobotId>,
}

impl Agreement {
    pub fn new(robots: usize, bound: Duration) -> Agreement {
        Agreement {
            robots: robots as u32,
            bound,
            health: Health::new(robots, Needs::Computing, bound),
            parts: Parts::new(robots, bound + RECOVERY),
            last_fault: None,
            joined: BTreeMap::new(),
            handed: BTreeMap::new(),
            due: VecDeque::new(),
            voters: BTreeSet::new(),
            down: BTreeSet::new(),
        }
    }

    pub fn observe(&mut self, record: &Record) {
        self.parts.observe(record);
        self.health.observe(record);
        if let Event::Fault(_) | Event::Failed(_) = &record.event {
            self.last_fault = Some(record.at);
        }
        if let (Event::Fault(fault), Some(robot)) = (&record.event, record.robot) {
            match fault {
                Fault::Crash => {
                    self.voters.retain(|(_, voter)| *voter != robot);
                    self.down.insert(robot);
                }
                Fault::Restart => {
                    self.down.remove(&robot);
                }
                _ => {}
            }
        }
    }

    pub fn sent(&mut self, key: MessageKey, at: Time) {
        self.handed.insert(key, (at, BTreeSet::new()));
        self.due.push_back((at + self.bound, key));
    }

    pub fn handed(&mut self, key: MessageKey, robot: RobotId) {
        if let Some((_, handed)) = self.handed.get_mut(&key) {
            handed.insert(robot);
        }
    }

    /// The sender has given it up. This is an error only without a fault that explains it and in a majority; then the
    /// bound decides.
    pub fn failed(&mut self, key: MessageKey, excused: &mut Excused) {
        let Some((sent, _)) = self.handed.get(&key) else {
            return;
        };
        if self.last_fault.is_some_and(|at| *sent < at + RECOVERY) {
            self.handed.remove(&key);
            excused.note(AGREEMENT, Excuse::Recovery);
        } else if self.majority_with(key.from).is_none() || self.may_lack_voters(key) {
            self.handed.remove(&key);
            excused.note(AGREEMENT, Excuse::NoMajority);
        }
    }

    /// A robot delivers what is decided from now on.
    pub fn joined(&mut self, port: Port, robot: RobotId, at: Time) {
        self.joined.insert((port, robot), at);
    }

    /// A robot has become a voter of its group.
    pub fn votes(&mut self, port: Port, robot: RobotId) {
        self.voters.insert((port, robot));
    }

    /// A robot has left its group.
    pub fn left(&mut self, port: Port, robot: RobotId) {
        self.voters.remove(&(port, robot));
    }

    /// Whether anything will be due.
    pub fn is_owed(&self) -> bool {
        !self.due.is_empty()
    }

    /// Judges what was due before `now`.
    pub fn check(&mut self, now: Time, found: &mut Vec<Violation>, excused: &mut Excused) {
        while let Some(&(due, key)) = self.due.front()
            && due < now
        {
            self.due.pop_front();
            let Some((sent, handed)) = self.handed.get(&key) else {
                continue;
            };
            let calm = self.last_fault.map(|at| at + RECOVERY + self.bound);
            if let Some(calm) = calm
                && calm > due
            {
                // Again then; those after it in the queue wait for it.
                let later = self.due.back().map_or(calm, |(last, _)| calm.max(*last));
                self.due.push_back((later, key));
                continue;
            }
            let owed = self.owed(key, *sent, handed, excused);
            let missed: Vec<RobotId> = owed.into_iter().filter(|r| !handed.contains(r)).collect();
            if !missed.is_empty() {
                let text = format!(
                    "message {} that robot {} broadcast at {sent} has no place in the order of {} \
                     within {}",
                    key.number,
                    key.from,
                    robot_list(&missed),
                    self.bound
                );
                found.push(Violation {
                    property: AGREEMENT.into(),
                    at: due,
                    robots: [key.from].into_iter().chain(missed).collect(),
                    text,
                });
            }
            self.handed.remove(&key);
        }
    }

    /// The robots that must have delivered a message by now.
    fn owed(
        &self,
        key: MessageKey,
        sent: Time,
        handed: &BTreeSet<RobotId>,
        excused: &mut Excused,
    ) -> Vec<RobotId> {
        for robot in (0..self.robots)
            .map(RobotId)
            .filter(|r| !handed.contains(r))
        {
            if self.health.well_from(robot) > sent {
                excused.note(AGREEMENT, self.health.excuse(robot));
            } else if self.parts.together_since(key.from, robot) == Time::NEVER {
                excused.note(AGREEMENT, Excuse::Partition);
            }
        }

        let has_been = |robot: &RobotId| {
            let joined = self.joined.get(&(key.port, *robot));
            let well_from = self.health.well_from(*robot);
            let met = self.parts.together_since(key.from, *robot);
            let is_late = || well_from + RECOVERY <= sent && met + RECOVERY <= sent;
            well_from <= sent && joined.map_or_else(is_late, |&at| at <= sent)
        };
        if self.may_lack_voters(key) {
            excused.note(AGREEMENT, Excuse::NoMajority);
            return Vec::new();
        }
        // A sender that has stopped since may never have told anyone.
        if !has_been(&key.from) {
            return Vec::new();
        }
        let near = self.majority_with(key.from).into_iter().flatten();
        near.filter(has_been).collect()
    }

    fn is_with(&self, sender: RobotId, robot: RobotId) -> bool {
        robot == sender || self.parts.together_since(sender, robot) != Time::NEVER
    }

    /// The robots that work and are in one part with a sender, if they are a majority.
    fn majority_with(&self, sender: RobotId) -> Option<Vec<RobotId>> {
        let is_well = |robot: &RobotId| self.health.well_from(*robot) != Time::NEVER;
        let all = (0..self.robots).map(RobotId).filter(is_well);
        let near: Vec<RobotId> = all.filter(|robot| self.is_with(sender, *robot)).collect();
        (near.len() > self.robots as usize / 2).then_some(near)
    }

    /// Whether too few voters may be left to decide on a message of this sender. A robot that has restarted, or was cut
    /// off when the group was founded, votes only once a leader has let it in.
    fn may_lack_voters(&self, key: MessageKey) -> bool {
        let all = || (0..self.robots).map(RobotId);
        let is_away =
            |robot: &RobotId| self.down.contains(robot) || !self.is_with(key.from, *robot);
        let votes = |robot: &RobotId| self.voters.contains(&(key.port, *robot));
        let left = all()
            .filter(|robot| votes(robot) && !is_away(robot))
            .count();
        all().any(|robot| is_away(&robot)) && left < self.robots as usize / 2 + 1
    }
}
