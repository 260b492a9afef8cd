//! The records of one election: its participants, the leader that each shows, and the leader of
//! each epoch.

use super::{EXCLUSION, ORDER, SOUNDNESS, UNIQUENESS};
use crate::Violation;
use starl_core::event::agreement::Algorithm;
use starl_core::{RobotId, Time};
use std::collections::{BTreeMap, BTreeSet};

/// An election.
#[derive(Clone, Debug, Default)]
pub(super) struct Instance {
    pub participants: Vec<RobotId>,
    pub algorithm: Option<Algorithm>,
    /// Robots that have it and are up.
    pub members: BTreeMap<RobotId, Member>,
    /// Those that lead, with their epochs.
    pub leading: BTreeMap<RobotId, Option<u64>>,
    /// The leader of each epoch.
    leaders: BTreeMap<u64, RobotId>,
    /// The epochs that robots have led in.
    led: BTreeSet<u64>,
    /// The latest of those that later ones have to be greater than.
    pub highest: Option<u64>,
}

/// A robot that has the election.
#[derive(Clone, Copy, Debug)]
pub(super) struct Member {
    /// Since when.
    pub since: Time,
    /// Since when it stands.
    pub called: Option<Time>,
    /// Since when it votes.
    pub votes_since: Option<Time>,
    /// Whether no robot could tell it the earlier promises.
    pub is_anew: bool,
    pub shown: Shown,
    /// The outcome that it believes, with ballots.
    outcome: Option<Outcome>,
}

/// The outcome of an election by ballots. Of two, a robot believes the greater.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Outcome {
    pub round: u64,
    pub ballot: u32,
    pub leader: RobotId,
}

/// The leader that a robot shows, if any, and since when.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shown {
    pub leader: Option<RobotId>,
    pub since: Time,
}

impl Member {
    pub fn new(at: Time) -> Member {
        Member {
            since: at,
            called: None,
            votes_since: None,
            is_anew: false,
            shown: Shown {
                leader: None,
                since: at,
            },
            outcome: None,
        }
    }

    /// A robot believes an outcome from now on.
    pub fn believe(&mut self, robot: RobotId, outcome: Outcome, at: Time) -> Option<Violation> {
        let before = self
            .outcome
            .replace(outcome)
            .filter(|before| *before > outcome)?;
        let text = format!(
            "robot {robot} shows robot {} by ballot {} of round {}, after robot {} by ballot {} of round {}",
            outcome.leader,
            outcome.ballot,
            outcome.round,
            before.leader,
            before.ballot,
            before.round
        );
        Some(Violation::new(
            ORDER,
            at,
            [outcome.leader, before.leader],
            text,
        ))
    }

    fn show(&mut self, leader: Option<RobotId>, at: Time) {
        if self.shown.leader != leader {
            self.shown = Shown { leader, since: at };
        }
    }
}

impl Instance {
    /// Whether it promises that no two robots lead at a time.
    pub fn has_leases(&self) -> bool {
        self.algorithm == Some(Algorithm::Leases)
    }

    /// More than half of the participants.
    pub fn majority(&self) -> usize {
        self.participants.len() / 2 + 1
    }

    /// A robot shows a leader from now on.
    pub fn shows(
        &mut self,
        robot: RobotId,
        leader: RobotId,
        epoch: Option<u64>,
        at: Time,
        is_disturbed: bool,
        found: &mut Vec<Violation>,
    ) {
        if let Some(member) = self.members.get_mut(&robot) {
            member.show(Some(leader), at);
        }
        self.leading.remove(&robot);
        if let Some(epoch) = epoch {
            let known = *self.leaders.entry(epoch).or_insert(leader);
            if known != leader {
                let text = format!("epoch {epoch} has two leaders, robots {known} and {leader}");
                found.push(Violation::new(UNIQUENESS, at, [known, leader], text));
            }
        }
        if !self.participants.contains(&leader) {
            let text =
                format!("robot {robot} shows robot {leader}, which takes no part, as leader");
            found.push(Violation::new(SOUNDNESS, at, [leader, robot], text));
        }
        if robot == leader {
            self.leads(robot, epoch, at, is_disturbed, found);
        }
    }

    /// A robot shows no leader from now on.
    pub fn shows_none(&mut self, robot: RobotId, at: Time) {
        self.leading.remove(&robot);
        if let Some(member) = self.members.get_mut(&robot) {
            member.show(None, at);
            member.outcome = None;
        }
    }

    /// A robot comes to lead.
    fn leads(
        &mut self,
        robot: RobotId,
        epoch: Option<u64>,
        at: Time,
        is_disturbed: bool,
        found: &mut Vec<Violation>,
    ) {
        let has_called = self
            .members
            .get(&robot)
            .is_some_and(|member| member.called.is_some());
        if !has_called {
            let text = format!("robot {robot} leads without having called for an election");
            found.push(Violation::new(SOUNDNESS, at, [robot], text));
        }
        if let Some(epoch) = epoch {
            if !self.led.insert(epoch) {
                let text = format!("robot {robot} leads twice in epoch {epoch}");
                found.push(Violation::new(UNIQUENESS, at, [robot], text));
            }
            let highest = self.highest.filter(|_| !is_disturbed);
            if let Some(highest) = highest.filter(|&highest| highest >= epoch) {
                let before = self.leaders.get(&highest).copied().unwrap_or(robot);
                let text = format!(
                    "robot {robot} leads in epoch {epoch} after robot {before} did in epoch {highest}"
                );
                found.push(Violation::new(ORDER, at, [robot, before], text));
            }
            self.highest = self.highest.max(Some(epoch)).filter(|_| !is_disturbed);
        }
        if self.has_leases()
            && let Some(&other) = self.leading.keys().next()
        {
            let text = format!("robots {other} and {robot} lead at the same time");
            found.push(Violation::new(EXCLUSION, at, [other, robot], text));
        }
        self.leading.insert(robot, epoch);
    }

    /// If a majority does not vote, because it has crashed or not started, possibly no robot remembers the latest
    /// epoch. Returns whether there was one.
    pub fn note_forgotten(&mut self) -> bool {
        let votes = |robot: &RobotId| {
            let member = self.members.get(robot);
            member.is_some_and(|member| member.votes_since.is_some())
        };
        let forgetful = self.participants.iter().filter(|robot| !votes(robot));
        forgetful.count() >= self.majority() && self.highest.take().is_some()
    }
}
