//! How robots that are in no group come into one: they found it, or are let in.
//!
//! Robots keep nothing when they stop, so nobody knows at its start whether there is a group. All say that
//! they are up. A leader that hears it lets the robot in. If nobody does, and a majority of the
//! fleet is in no group, then no group has enough members left to decide anything, and one of them
//! founds the next.

use super::packet::{Body, Generation, Life};
use super::{FURTHEST, Member, Total};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::event::BroadcastEvent;
use starl_core::event::messaging::LeaveReason;
use starl_core::{Destination, Robot, RobotId};

/// A robot that was heard of counts as up for this many ticks.
const FRESH: u32 = 6;

/// The first of those that are in no group waits for others for twice as many ticks before it founds
/// one; the next as many more.
const ATTEMPTS: u32 = 4;

/// Who is in no group, as far as a robot that is in none knows.
#[derive(Clone, Debug, Default)]
pub(super) struct Idle {
    /// Ticks since it came to be in none, or last founded one.
    waited: u32,
    /// The lives of others, and the ticks since they were heard.
    others: BTreeMap<RobotId, (u32, u32)>,
}

impl Total {
    /// A tick of a robot that is in no group.
    pub(super) fn wait_for_group(&mut self, robot: &mut Robot<'_>) {
        let life = self.life(robot);
        let idle = &mut self.idle;
        idle.waited = idle.waited.saturating_add(1);
        for (_, silence) in idle.others.values_mut() {
            *silence = silence.saturating_add(1);
        }
        idle.others.retain(|_, (_, silence)| *silence <= FRESH);
        let rank = idle.others.range(..life.robot).count() as u32;
        let quorum = robot.fleet().len() / 2 + 1;
        let is_time = idle.waited >= ATTEMPTS.saturating_mul(rank.saturating_add(2));
        // Those who are heard of in time are there from the first message on.
        let are_all = rank == 0 && idle.others.len() + 1 == robot.fleet().len();
        if idle.others.len() + 1 >= quorum && (is_time || are_all) {
            return self.found(robot, life, quorum as u32);
        }
        self.greet(robot, Destination::All, None);
    }

    fn found(&mut self, robot: &mut Robot<'_>, life: Life, quorum: u32) {
        let others = self.idle.others.iter();
        let mut voters: Vec<Life> = others
            .map(|(&robot, &(number, _))| Life { robot, number })
            .collect();
        voters.push(life);
        voters.sort_unstable();
        let generation = Generation {
            counter: self.highest.saturating_add(1),
            founder: life,
        };
        let mut member = Member::at(generation, quorum, (0, 0), voters);
        member.patience = 0;
        self.invite_founders(robot, Destination::All, &member);
        self.join(robot, member);
        self.ask(robot, false);
    }

    /// Tells founding members of their group, which they join with an empty log.
    fn invite_founders(&self, robot: &mut Robot<'_>, to: Destination, member: &Member) {
        let body = Body::Found {
            generation: member.generation,
            quorum: member.quorum,
            voters: member.log.voters_at(0).to_vec(),
        };
        self.say(robot, to, body);
    }

    /// This robot is up, in answer to asking where it is if so.
    pub(super) fn greet(&mut self, robot: &mut Robot<'_>, to: Destination, answer: Option<u32>) {
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
        (bound_to, answer): (Option<Generation>, Option<u32>),
    ) {
        let Some(member) = &mut self.member else {
            if generation.is_none() {
                self.idle.others.insert(from.robot, (from.number, 0));
            } else {
                self.idle.others.remove(&from.robot);
            }
            return;
        };
        if bound_to.is_some_and(|bound_to| bound_to > member.generation) {
            // It cannot go back, so this group cannot take it in: the next one will.
            return self.leave(robot, LeaveReason::Obsolete);
        }
        if generation == Some(member.generation) {
            return;
        }
        if answer.is_some() && answer == Some(self.ask_number) {
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
        let Some(member) = &self.member else { return };
        let to = Destination::Robot(from.robot);
        let is_founder = member.log.base() == 0 && member.log.voters_at(0).contains(&from);
        if is_founder && (member.is_leading() || member.log.last() == 0) {
            self.invite_founders(robot, to, member);
        } else if member.is_leading() {
            self.send_snapshot(robot, from.robot);
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
            self.join(robot, Member::at(generation, quorum, (0, 0), voters));
        }
    }

    /// Whether this robot would not go back.
    pub(super) fn may_join(&self, generation: Generation) -> bool {
        let position = self.position.map(|(generation, _)| generation);
        position.is_none_or(|position| position <= generation)
            && generation.counter <= self.highest.saturating_add(FURTHEST)
    }

    pub(super) fn join(&mut self, robot: &mut Robot<'_>, mut member: Member) {
        self.highest = self.highest.max(member.generation.counter);
        member.patience = member.patience.max(super::patience(robot));
        let is_next = self
            .position
            .is_some_and(|position| position < (member.generation, member.commit));
        let group = member.generation.counter;
        robot.report(self.port, BroadcastEvent::Join { group });
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
