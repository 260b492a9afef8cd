//! How robots without a group get into one: they found it, or are admitted.
//!
//! Robots keep nothing when they stop, so at its start a robot does not know whether there is a group. All
//! announce that they are up. A leader that hears this admits the robot. If no leader does, and a majority
//! of the fleet is in no group, then no group has enough members left to decide anything, and one of the
//! robots founds the next.

use super::life::{Life, LifeName};
use super::packet::{Body, Generation, Question};
use super::roll::Roll;
use super::{Member, Role, Total};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::event::BroadcastEvent;
use starl_core::event::messaging::LeaveReason;
use starl_core::{Destination, Robot, RobotId};

/// A robot that was heard of counts as up for this many ticks.
const FRESH: u32 = 6;

/// The first of those that are in no group waits for others for twice as many ticks before it begins to found
/// one; the next begins as many ticks after the first must have come to an end with it.
const ATTEMPTS: u32 = 4;

/// A robot that is about to found a group waits for so many ticks for answers that are missing.
const MUSTER: u32 = 6;

/// The robots without a group, as known to a robot without a group.
#[derive(Clone, Debug, Default)]
pub(super) struct Idle {
    /// Ticks since it came to be in none, or last founded one.
    waited: u32,
    /// Others that were heard, and the ticks since. Some of it may be old.
    others: BTreeMap<RobotId, u32>,
    muster: Option<Muster>,
}

/// The question of a group's founder to all others: which lives are there now without a group.
#[derive(Clone, Debug, Default)]
struct Muster {
    /// Ticks since it first asked.
    age: u32,
    present: BTreeMap<RobotId, LifeName>,
}

impl Total {
    /// A tick of a robot that is in no group.
    pub(super) fn wait_for_group(&mut self, robot: &mut Robot<'_>) {
        let me = robot.id();
        let idle = &mut self.idle;
        idle.waited = idle.waited.saturating_add(1);
        for silence in idle.others.values_mut() {
            *silence = silence.saturating_add(1);
        }
        idle.others.retain(|_, silence| *silence <= FRESH);
        let rank = idle.others.range(..me).count() as u32;
        let quorum = robot.fleet().len() / 2 + 1;
        let is_time = idle.waited >= 2 * ATTEMPTS + (ATTEMPTS + MUSTER).saturating_mul(rank);
        // Robots that are heard in time get all messages from the first on.
        let are_all = rank == 0 && idle.others.len() + 1 == robot.fleet().len();
        if idle.others.len() + 1 < quorum || !is_time && !are_all {
            idle.muster = None;
            return self.greet(robot, Destination::All, None);
        }
        match &mut idle.muster {
            Some(muster) => muster.age += 1,
            None => {
                idle.muster = Some(Muster::default());
                self.ask_number = self.ask_number.wrapping_add(1);
            }
        }
        self.greet(robot, Destination::All, None);
        if !self.found_if_due(robot) {
            let question = self.question(true, 0, (0, 0));
            self.say(robot, Destination::All, question);
        }
    }

    /// Founds a group of the robots that have answered, if they are enough.
    fn found_if_due(&mut self, robot: &mut Robot<'_>) -> bool {
        let Some(muster) = &self.idle.muster else {
            return false;
        };
        let quorum = robot.fleet().len() / 2 + 1;
        let mut others = self.idle.others.keys();
        let are_all = others.all(|other| muster.present.contains_key(other));
        let is_due = muster.present.len() + 1 >= quorum && (are_all || muster.age >= MUSTER);
        if is_due {
            let others = muster.present.iter();
            let mut voters: Vec<Life> =
                others.map(|(&robot, &name)| Life { robot, name }).collect();
            voters.push(self.life(robot));
            voters.sort_unstable();
            self.found(robot, voters, quorum as u32);
        }
        is_due
    }

    fn found(&mut self, robot: &mut Robot<'_>, voters: Vec<Life>, quorum: u32) {
        let generation = Generation {
            counter: self.highest.saturating_add(1),
            founder: self.life(robot),
        };
        let member = Member::at(generation, quorum, (0, 0), founders(voters));
        self.say(robot, Destination::All, member.invitation());
        self.join(robot, member);
        self.ask(robot, false);
    }

    /// Another robot that is in no group is up, or is not in none.
    fn note_idle(&mut self, robot: &mut Robot<'_>, from: Life, is_idle: bool, is_answer: bool) {
        if !is_idle {
            self.idle.others.remove(&from.robot);
        } else {
            self.idle.others.insert(from.robot, 0);
        }
        if let Some(muster) = &mut self.idle.muster
            && is_idle
            && is_answer
        {
            muster.present.insert(from.robot, from.name);
            self.found_if_due(robot);
        }
    }

    /// Whether it asks which robots are there.
    pub(super) fn is_mustering(&self) -> bool {
        self.idle.muster.is_some()
    }

    /// This robot is up, in answer to asking where it is if so.
    pub(super) fn greet(
        &mut self,
        robot: &mut Robot<'_>,
        to: Destination,
        answer: Option<Question>,
    ) {
        let active = self.member.as_ref().filter(|member| member.is_active);
        let bound_to = active.map(|member| member.generation);
        let taken_in = self.position.map(|(generation, _)| generation);
        let body = Body::Hello {
            bound_to: bound_to.max(taken_in),
            answer,
        };
        self.say(robot, to, body);
    }

    /// Another robot is up.
    pub(super) fn greeted(
        &mut self,
        robot: &mut Robot<'_>,
        from: Life,
        generation: Option<Generation>,
        (bound_to, answer): (Option<Generation>, Option<Question>),
    ) {
        // The next group must be one that it can join.
        if bound_to.is_some_and(|bound_to| !self.learn(bound_to)) {
            return;
        }
        let is_answer = answer.is_some_and(|question| self.is_asking(robot, question));
        let Some(member) = &mut self.member else {
            return self.note_idle(robot, from, generation.is_none(), is_answer);
        };
        if bound_to.is_some_and(|bound_to| bound_to > member.generation) {
            // It cannot go back, so this group cannot take it in: the next one will.
            return self.leave(robot, LeaveReason::Obsolete);
        }
        if generation == Some(member.generation) {
            return;
        }
        if is_answer {
            // It was asked after the voters were known, so this is no earlier life of one.
            member.see(from, generation.is_some());
            if member.is_dead() {
                return self.leave(robot, LeaveReason::Lost);
            }
        }
        if generation.is_none() {
            self.let_in(robot, from);
        }
    }

    /// A robot that is in no group is up.
    fn let_in(&mut self, robot: &mut Robot<'_>, from: Life) {
        let Some(member) = &mut self.member else {
            return;
        };
        if let Role::Leading(leading) = &mut member.role
            && leading.follower(from).is_some()
        {
            return; // it has been let in since then
        }
        let is_founder = member.log.base() == 0 && member.log.voters_at(0).contains(&from);
        if is_founder && (member.is_leading() || member.log.last() == 0) {
            let invitation = member.invitation();
            self.say(robot, Destination::Robot(from.robot), invitation);
        } else if member.is_leading() {
            self.send_snapshot(robot, from);
        }
    }

    /// Lives found a group.
    pub(super) fn founded(
        &mut self,
        robot: &mut Robot<'_>,
        generation: Generation,
        quorum: u32,
        voters: Vec<Life>,
    ) {
        let life = self.life(robot);
        let is_sound = !voters.is_empty()
            && quorum as usize > robot.fleet().len() / 2
            && voters.len() <= robot.fleet().len()
            && voters.is_sorted_by(|a, b| a.robot < b.robot);
        if self.member.is_none() && is_sound && voters.contains(&life) && self.may_join(generation)
        {
            let roll = founders(voters);
            self.join(robot, Member::at(generation, quorum, (0, 0), roll));
        }
    }

    /// Whether this robot would not go back.
    pub(super) fn may_join(&self, generation: Generation) -> bool {
        let position = self.position.map(|(generation, _)| generation);
        position.is_none_or(|position| position <= generation)
    }

    pub(super) fn join(&mut self, robot: &mut Robot<'_>, mut member: Member) {
        self.highest = self.highest.max(member.generation.counter);
        member.patience = member.patience.max(super::patience(robot));
        let is_next = self
            .position
            .is_some_and(|position| position < (member.generation, member.commit));
        let group = member.generation.counter;
        robot.report(self.port, BroadcastEvent::Join { group });
        if member.roll.last(self.life(robot)).is_some() {
            robot.report(self.port, BroadcastEvent::Voter);
        }
        self.member = Some(member);
        self.idle = Idle::default();
        if is_next {
            self.miss(robot);
        }
    }

    /// Gives the group up: from now on this robot is another life, which knows nothing of it.
    pub(super) fn leave(&mut self, robot: &mut Robot<'_>, reason: LeaveReason) {
        let Some(member) = self.member.take() else {
            return;
        };
        robot.report(self.port, BroadcastEvent::Leave { reason });
        self.lives = self.lives.wrapping_add(1);
        self.idle = Idle::default();
        // In the next group it would have another place than in this one, where it may have one.
        self.fail_bound(robot, member.generation);
    }
}

/// The lives that may send at the beginning.
fn founders(voters: Vec<Life>) -> Roll {
    Roll::new(voters.into_iter().map(|life| (life, 0)).collect())
}

impl Member {
    /// Tells founding members of their group, which they join with an empty log.
    fn invitation(&self) -> Body {
        Body::Found {
            generation: self.generation,
            quorum: self.quorum,
            voters: self.log.voters_at(0).to_vec(),
        }
    }
}
