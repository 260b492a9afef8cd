//! How a leader sends single members their missing entries: as much as may be in transit at once, and lost entries
//! again.
//!
//! A member reports the prefix in which its log equals the leader's, and the missing parts after that. If it
//! has heard a round well after the leader sent it these parts, they were lost.

use super::followers::Follower;
use super::life::Life;
use super::packet::Body;
use super::{CHUNK, FURTHEST, Role, Total, WINDOW};
use alloc::vec::Vec;
use starl_core::{Destination, Robot};

/// A member's report about its log.
pub(super) struct Answer {
    pub term: u32,
    pub round: u64,
    pub through: u64,
    pub lacks: Vec<(u64, u64)>,
    pub applied: u64,
    pub call: u64,
}

impl Total {
    /// A member says how far it is.
    pub(super) fn hear_answer(&mut self, robot: &mut Robot<'_>, from: Life, answer: Answer) {
        let Some(member) = &mut self.member else {
            return;
        };
        if answer.term == member.term {
            self.taken_by(robot, from, answer);
        } else if answer.term <= member.term.saturating_add(FURTHEST) {
            member.hear_of(answer.term);
        }
    }

    /// A member has taken entries, or lacks some.
    fn taken_by(&mut self, robot: &mut Robot<'_>, from: Life, mut answer: Answer) {
        let Some(member) = &mut self.member else {
            return;
        };
        let last = member.log.last();
        let Role::Leading(leading) = &mut member.role else {
            return;
        };
        if answer.through > last {
            return; // no member has more than its leader
        }
        // Nor has it heard more than its leader has said.
        if answer.round > leading.round || answer.call > leading.calls {
            (answer.round, answer.call) = (0, 0);
        }
        let known = leading.followers.get(&from.robot).map(|f| (f.life, f.call));
        let is_new = known.is_none_or(|(life, _)| life != from);
        let is_proven = match known {
            Some((_, call)) => call < answer.call,
            None => answer.call > 0 || leading.roll.last(from).is_some(),
        };
        if is_new && !is_proven {
            return self.call(robot, from);
        }
        if is_new {
            let follower = Follower::new(from);
            leading.followers.insert(from.robot, follower);
        }
        let since = leading.past[0].1;
        if let Some(follower) = leading.follower(from) {
            follower.take_note(&answer, since);
        }
        if is_new || !answer.lacks.is_empty() {
            self.feed(robot, from, answer);
        }
        self.replicate(robot, false);
    }

    /// Asks a life for a sign of life.
    fn call(&mut self, robot: &mut Robot<'_>, to: Life) {
        let Some(member) = &mut self.member else {
            return;
        };
        let term = member.term;
        let Role::Leading(leading) = &mut member.role else {
            return;
        };
        leading.calls += 1;
        let call = leading.calls;
        let body = Body::Call {
            to: to.name,
            term,
            call,
        };
        self.say(robot, Destination::Robot(to.robot), body);
    }

    /// Sends a member what it lacks.
    fn feed(&mut self, robot: &mut Robot<'_>, to: Life, answer: Answer) {
        let Some(member) = &mut self.member else {
            return;
        };
        let (base, applied, floor) = (member.log.base(), member.applied, member.floor());
        let Role::Leading(leading) = &mut member.role else {
            return;
        };
        let (sent, round) = (leading.sent, leading.round + 1);
        let Some(follower) = leading.follower(to) else {
            return;
        };
        // One round may overtake another.
        let is_lost = answer.round > follower.fed + 1;
        if !is_lost && answer.through < follower.fed_through {
            return; // it is on its way
        }
        let needs_snapshot = answer.through < base;
        follower.fed = round;
        follower.fed_through = applied;
        leading.round = round;
        if needs_snapshot {
            return self.send_snapshot(robot, to);
        }
        let mut left = WINDOW;
        let mut last = 0;
        let all = (answer.through, sent);
        let parts = match answer.lacks.is_empty() {
            true => core::slice::from_ref(&all),
            false => &answer.lacks,
        };
        for &(mut next, end) in parts {
            while next < end.min(sent) && left > 0 {
                let Some(member) = &self.member else { return };
                let (body, reached) = member.append_after(next, end.min(sent), floor, true);
                if reached == next {
                    break;
                }
                self.say(robot, Destination::Robot(to.robot), body);
                left = left.saturating_sub(CHUNK);
                next = reached;
            }
            last = next;
        }
        if let Some(Role::Leading(leading)) = self.member.as_mut().map(|member| &mut member.role)
            && let Some(follower) = leading.follower(to)
        {
            follower.fed_through = last;
        }
    }
}
