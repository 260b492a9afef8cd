//! The leader's log: how it grows, when its beginning is dropped, and how the leader sends single members their missing
//! entries: as much as may be in transit at once, and lost entries again.
//!
//! A member reports the prefix in which its log equals the leader's, and the missing parts after that. If it
//! has heard a round well after the leader sent it these parts, they were lost.

use super::followers::{Answer, Follower};
use super::life::Life;
use super::packet::{Body, Entry, What};
use super::{CHUNK, FURTHEST, MOST_BYTES, Member, Role, Total, WINDOW};
use alloc::vec::Vec;
use starl_core::{Destination, Robot};

/// The log is kept for followers that were not heard for fewer ticks than this.
const LONGEST_ABSENCE: u32 = 240;

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

impl Member {
    /// Whether more entries may be added to the log before the present ones are decided.
    pub fn has_room(&self) -> bool {
        self.commit >= self.log.last() || self.log.bytes() < 2 * MOST_BYTES
    }

    /// Puts an entry into the log of a leader.
    pub fn put(&mut self, what: What) {
        let term = self.term;
        if let Role::Leading(leading) = &mut self.role {
            leading.roll.advance(&what);
            self.log.push(Entry { term, what });
        }
    }

    /// The entries after a given one, up to the size of a datagram, and the index of the last.
    pub fn append_after(&self, previous: u64, last: u64, floor: u64, is_beat: bool) -> (Body, u64) {
        let mut entries = Vec::new();
        let (mut end, mut size) = (previous, 0);
        while end < last
            && size < CHUNK
            && let Some(entry) = self.log.get(end + 1)
        {
            size += entry.size();
            entries.push(entry.clone());
            end += 1;
        }
        let round = match &self.role {
            Role::Leading(leading) => leading.round,
            _ => 0,
        };
        let body = Body::Append {
            term: self.term,
            round,
            previous,
            previous_term: self.log.term(previous).unwrap_or(0),
            entries,
            commit: self.commit,
            floor,
            is_beat,
        };
        (body, end)
    }

    /// The index up to which entries can be dropped: all members that are heard have delivered them, or there are too
    /// many.
    pub fn floor(&self) -> u64 {
        let Role::Leading(leading) = &self.role else {
            return 0;
        };
        if self.log.is_long() {
            // An eighth at a time.
            let length = self.log.last() - self.log.base();
            return self.applied.min(self.log.base() + 1 + length / 8);
        }
        let is_heard = |voter: &Life| {
            leading.followers.contains_key(&voter.robot) || Some(*voter) == self.leader
        };
        if leading.age < LONGEST_ABSENCE && !self.log.voters().iter().all(is_heard) {
            return self.log.base();
        }
        let followers = leading.followers.values();
        let near = followers.filter(|follower| follower.silence < LONGEST_ABSENCE);
        let slowest = near.map(|follower| follower.applied).min().unwrap_or(0);
        // Robots that were just let in may be about to ask for what came since.
        slowest.min(leading.past[0].0)
    }
}
