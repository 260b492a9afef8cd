//! How a robot continues from a position in the log that it has not reached itself: an admitted robot, or one that was
//! away for longer than the log is kept.
//!
//! Invariant: a member does not drop entries that it has acknowledged to a leader that may still rely on them.

use super::life::{Life, LifeName};
use super::log::Log;
use super::packet::{Body, Generation};
use super::roll::Roll;
use super::{Member, Role, Total};
use alloc::vec::Vec;
use starl_core::event::BroadcastEvent;
use starl_core::{Destination, Robot};

/// Where a robot can continue.
pub(super) struct Place {
    pub to: LifeName,
    pub call: u64,
    pub quorum: u32,
    pub term: u32,
    pub index: u64,
    pub index_term: u32,
    pub base: u64,
    pub roll: Vec<(Life, u32)>,
}

impl Total {
    /// Sends a life the state from which it can continue.
    pub(super) fn send_snapshot(&mut self, robot: &mut Robot<'_>, to: Life) {
        let Some(member) = &mut self.member else {
            return;
        };
        let Role::Leading(leading) = &mut member.role else {
            return;
        };
        leading.calls += 1;
        let index = member.applied;
        let body = Body::Snapshot {
            to: to.name,
            call: leading.calls,
            quorum: member.quorum,
            term: member.term,
            index,
            index_term: member.log.term(index).unwrap_or(0),
            base: member.log.base(),
            roll: member.roll.rows().to_vec(),
        };
        self.say(robot, Destination::Robot(to.robot), body);
    }

    /// The leader says where this robot can continue.
    pub(super) fn go_on(
        &mut self,
        robot: &mut Robot<'_>,
        from: Life,
        generation: Generation,
        place: Place,
    ) {
        let is_sound = !place.roll.is_empty()
            && place.index_term <= place.term
            && place.roll.is_sorted_by(|a, b| a.0.robot < b.0.robot);
        if !is_sound || place.to != self.life(robot).name {
            return;
        }
        match &self.member {
            None if self.may_join(generation) => {
                let start = (place.index, place.index_term);
                let roll = Roll::new(place.roll);
                self.join(robot, Member::at(generation, place.quorum, start, roll));
            }
            Some(member)
                if member.generation == generation
                    && !member.is_leading()
                    && (place.term, place.call) > (member.term, member.call) =>
            {
                self.leap(robot, &place);
            }
            _ => return,
        }
        let Some(member) = &mut self.member else {
            return;
        };
        member.follow(from, place.term);
        member.call = place.call;
        let answer = member.taken(Vec::new());
        self.settle_proposed(robot);
        self.say(robot, Destination::Robot(from.robot), answer);
        self.propose_anew(robot);
    }

    /// A member continues from a later place, if it has to.
    fn leap(&mut self, robot: &mut Robot<'_>, place: &Place) {
        let me = self.life(robot);
        let Some(member) = &mut self.member else {
            return;
        };
        let (index, term) = (place.index, place.index_term);
        if index <= member.commit || place.base <= member.commit {
            return;
        }
        if member.log.term(index) == Some(term) {
            // It has all up to there, and perhaps more, on which the leader may count.
            member.commit = index;
            return self.apply(robot);
        }
        let has_voted = member.roll.last(me).is_some();
        member.roll = Roll::new(place.roll.clone());
        let votes = member.roll.last(me).is_some();
        let voters = place.roll.iter().map(|row| row.0).collect();
        member.log = Log::after(index, term, voters);
        member.quorum = place.quorum;
        (member.commit, member.applied) = (index, index);
        if votes && !has_voted {
            robot.report(self.port, BroadcastEvent::Voter);
        }
        self.miss(robot);
    }
}
