//! Agreement and progress, once robots have had the time that the bound gives them.

use super::{AGREEMENT, Election, Instance, Member, PROGRESS, Shown};
use crate::{Excuse, Violation, robot_list};
use starl_core::{Duration, Port, RobotId, Time};

/// An excuse, and its reason.
type Reason = (&'static str, Excuse);

/// Robots cannot tell whether one began to vote before another started, or so shortly after: their clocks drift,
/// and messages take their time.
const AT_ONCE: Duration = Duration::from_seconds(1);

impl Election {
    /// Judges what is due before `now`.
    pub(super) fn check_bounds(&mut self, now: Time, found: &mut Vec<Violation>) {
        while let Some(&(due, port, robot)) = self.due.first() {
            if due >= now {
                return;
            }
            self.due.pop_first();
            let Some(instance) = self.instances.get(&port) else {
                continue;
            };
            let Some(member) = instance.members.get(&robot) else {
                continue;
            };
            let excused = &mut Vec::new();
            if member.shown.since + self.bound > due {
                continue; // it is judged later
            }
            let again = match member.shown.leader {
                Some(leader) => {
                    self.judge_agreement(robot, leader, instance, due, (found, excused))
                }
                None => {
                    member.called.is_some()
                        && self.judge_progress(robot, port, due, (found, excused))
                }
            };
            for (property, excuse) in excused.drain(..) {
                self.excused.note(property, excuse);
            }
            if again {
                self.due.insert((due + self.bound, port, robot));
            }
        }
    }

    /// Whether two robots have been well and linked for the bound.
    fn are_linked(&self, one: RobotId, other: RobotId, now: Time) -> bool {
        let well = self.health.well_from(one).max(self.health.well_from(other));
        let since = well.max(self.parts.together_since(one, other));
        since != Time::NEVER && since + self.bound <= now
    }

    /// Why two robots need not agree yet.
    fn excuse(&self, one: RobotId, other: RobotId, now: Time) -> Excuse {
        let is_unwell = |robot: &RobotId| {
            let since = self.health.well_from(*robot);
            since != Time::ZERO && (since == Time::NEVER || since + self.bound > now)
        };
        let unwell = [one, other].into_iter().find(is_unwell);
        match unwell {
            Some(robot) => self.health.excuse(robot),
            None if self.is_disturbed(now) => Excuse::Corruption,
            None => Excuse::Partition,
        }
    }

    /// Whether a robot has shown the same as leader for as long as any robot that shows another; if not, the
    /// two are judged again.
    fn judge_agreement(
        &self,
        robot: RobotId,
        leader: RobotId,
        instance: &Instance,
        now: Time,
        (found, excused): (&mut Vec<Violation>, &mut Vec<Reason>),
    ) -> bool {
        let differs = |member: &Member| {
            let Shown {
                leader: shown,
                since,
            } = member.shown;
            shown.is_some_and(|other| other != leader) && since + self.bound <= now
        };
        let members = instance.members.iter();
        let different = members.filter(|(_, member)| differs(member));
        let different: Vec<RobotId> = different.map(|(&other, _)| other).collect();
        let is_linked =
            |&other: &RobotId| self.are_linked(robot, other, now) && !self.is_disturbed(now);
        let linked: Vec<RobotId> = different.iter().copied().filter(is_linked).collect();
        if linked.is_empty() {
            if let Some(&other) = different.first() {
                excused.push((AGREEMENT, self.excuse(robot, other, now)));
            }
            return !different.is_empty();
        }
        let text = format!(
            "robot {robot} shows robot {leader} as leader, {} another, for {}",
            robot_list(&linked),
            self.bound
        );
        let robots: Vec<RobotId> = [robot].into_iter().chain(linked).collect();
        found.push(Violation::new(AGREEMENT, now, robots, text));
        false
    }

    /// Whether a robot that stands is rightly without a leader; if so, it is judged again.
    fn judge_progress(
        &self,
        robot: RobotId,
        port: Port,
        now: Time,
        (found, excused): (&mut Vec<Violation>, &mut Vec<Reason>),
    ) -> bool {
        let instance = &self.instances[&port];
        let since = now - self.bound;
        let is_ready = |peer: RobotId, member: &Member| {
            member.since <= since && self.are_linked(robot, peer, now)
        };
        let called = instance
            .members
            .get(&robot)
            .and_then(|member| member.called);
        let stands =
            called.is_some_and(|called| called <= since) && instance.participants.contains(&robot);
        let is_able = !self.is_disturbed(now) && self.are_linked(robot, robot, now);
        let owes = stands
            && is_able
            && (!instance.has_leases() || self.has_quorum(instance, since, is_ready));
        if stands && !owes {
            let excuse = match is_able {
                true => Excuse::NoMajority,
                false => self.excuse(robot, robot, now),
            };
            excused.push((PROGRESS, excuse));
        }
        if owes {
            let text = format!(
                "robot {robot} is a candidate and has had no leader for {}",
                self.bound
            );
            found.push(Violation::new(PROGRESS, now, [robot], text));
        }
        !owes
    }

    /// Whether enough robots are ready to elect one of them: a majority that votes, or that all have to learn
    /// the promises, or so many voters that the others can learn the promises from them.
    fn has_quorum(
        &self,
        instance: &Instance,
        since: Time,
        is_ready: impl Fn(RobotId, &Member) -> bool,
    ) -> bool {
        let ready = instance.participants.iter().filter_map(|&peer| {
            let member = instance.members.get(&peer)?;
            is_ready(peer, member).then_some(member)
        });
        let votes = |member: &Member| member.votes_since.is_some_and(|votes| votes <= since);
        let (voting, learning): (Vec<&Member>, Vec<&Member>) =
            ready.partition(|&member| votes(member));
        let (majority, count) = (instance.majority(), instance.participants.len());
        let learns = |learner: &&&Member| {
            let remembers = |voter: &&&Member| {
                !voter.is_anew || voter.votes_since.is_some_and(|at| at < learner.since)
            };
            voting.iter().filter(remembers).count() + majority > count
        };
        let join = learning.iter().filter(learns).count();
        let is_surely_later = |member: &&&Member| {
            let votes_at_once = |at: Time| at <= since + AT_ONCE;
            !member.votes_since.is_some_and(votes_at_once)
        };
        let recovering = learning.iter().filter(is_surely_later).count();
        recovering >= majority || voting.len() + join >= majority
    }
}
