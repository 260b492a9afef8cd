//! The leader adds messages to the log, sends it to all, and determines which entries are decided.
//!
//! Invariant: an entry of the leader's term that a quorum of the voters has is decided, and with it all
//! before (Ongaro and Ousterhout 2014, section 5.4). The list of voters changes by one life at a time,
//! and only when the last change is decided, so that any quorum before intersects any quorum after it.

use super::followers::Leading;
use super::life::Life;
use super::packet::What;
use super::{CHUNK, Role, Total};
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;
use starl_core::event::BroadcastEvent;
use starl_core::{Destination, Payload, Robot};

/// A leader that has not heard of a quorum for this many ticks leads no more.
const LONGEST_SILENCE: u32 = 8;

impl Total {
    /// This robot has been elected.
    pub(super) fn lead(&mut self, robot: &mut Robot<'_>) {
        let life = self.life(robot);
        let Some(member) = &mut self.member else {
            return;
        };
        let mut roll = member.roll.clone();
        for index in member.applied + 1..=member.log.last() {
            if let Some(entry) = member.log.get(index) {
                roll.advance(&entry.what);
            }
        }
        member.leader = Some(life);
        member.silence = 0;
        member.is_active = true;
        let last = member.log.last();
        member.role = Role::Leading(Leading {
            age: 0,
            start: last + 1,
            sent: last,
            told: member.commit,
            past: [(member.log.base(), 0); 4],
            round: 0,
            calls: 0,
            followers: BTreeMap::new(),
            roll,
        });
        member.put(What::Start);
        let term = member.term;
        robot.report(self.port, BroadcastEvent::Lead { term });
        self.replicate(robot, true);
        self.propose_anew(robot);
    }

    /// A life has messages for the log, the oldest of which that still waits has this number.
    pub(super) fn put_messages(
        &mut self,
        robot: &mut Robot<'_>,
        from: Life,
        oldest: u32,
        messages: Vec<(u32, Payload)>,
    ) {
        let Some(member) = &mut self.member else {
            return;
        };
        for (number, content) in messages {
            let has_room = member.has_room();
            let Role::Leading(leading) = &member.role else {
                return;
            };
            let Some(last) = leading.roll.last(from) else {
                return; // it does not vote yet, or no longer
            };
            // Where an earlier message is missing or there is no room, it has to be proposed again.
            if number == oldest.max(last.saturating_add(1)) && has_room {
                let from = from.robot;
                member.put(What::Message {
                    from,
                    number,
                    content,
                });
            }
        }
        self.replicate(robot, false);
    }

    /// Sends new entries of the log to all, unless the last ones sent are not decided: then they are sent later
    /// together with the following entries, as soon as these fill a datagram. A beat is sent in any case.
    pub(super) fn replicate(&mut self, robot: &mut Robot<'_>, is_beat: bool) {
        self.decide(robot);
        let Some(member) = &mut self.member else {
            return;
        };
        member.admit();
        let floor = member.floor();
        let Role::Leading(leading) = &mut member.role else {
            return;
        };
        let (sent, last) = (leading.sent, member.log.last());
        let may_send =
            is_beat || sent <= member.commit || member.log.size_between(sent, last) >= CHUNK;
        let has_news = leading.sent < member.log.last() && may_send;
        if !has_news && !is_beat && leading.told >= member.commit {
            return;
        }
        leading.round += 1;
        let previous = leading.sent;
        leading.told = member.commit;
        if has_news {
            leading.sent = member.log.last();
        }
        let last = leading.sent;
        let mut next = previous.max(member.log.base());
        loop {
            let Some(member) = &self.member else { return };
            let (body, end) = member.append_after(next, last, floor, is_beat);
            self.say(robot, Destination::All, body);
            if end == next || end >= last {
                break;
            }
            next = end;
        }
        let Some(member) = &mut self.member else {
            return;
        };
        member.log.drop_through(floor);
    }

    /// Sees what is decided.
    fn decide(&mut self, robot: &mut Robot<'_>) {
        let life = self.life(robot);
        let Some(member) = &mut self.member else {
            return;
        };
        let Role::Leading(leading) = &member.role else {
            return;
        };
        let matched = |voter: &Life| match leading.followers.get(&voter.robot) {
            _ if *voter == life => member.log.last(),
            Some(follower) if follower.life == *voter => follower.matched,
            _ => 0,
        };
        let mut matches: Vec<u64> = member.log.voters().iter().map(matched).collect();
        matches.sort_unstable_by(|a, b| b.cmp(a));
        let decided = matches.get(member.needed() - 1).copied().unwrap_or(0);
        if decided > member.commit && member.log.term(decided) == Some(member.term) {
            member.commit = decided;
            self.apply(robot);
        }
    }

    /// A leader's tick.
    pub(super) fn beat(&mut self, robot: &mut Robot<'_>) {
        let life = self.life(robot);
        let Some(member) = &mut self.member else {
            return;
        };
        let Role::Leading(leading) = &mut member.role else {
            return;
        };
        leading.age = leading.age.saturating_add(1);
        for follower in leading.followers.values_mut() {
            follower.silence = follower.silence.saturating_add(1);
        }
        let near = leading.followers.values().filter(|f| f.silence <= 2);
        let mut near: BTreeSet<Life> = near.map(|f| f.life).collect();
        near.insert(life);
        if member.is_quorum(&near) {
            member.silence = 0;
        } else if member.silence >= LONGEST_SILENCE {
            member.role = Role::Following;
            member.leader = None;
            return;
        }
        self.replicate(robot, true);
        if let Some(member) = &mut self.member
            && let Role::Leading(leading) = &mut member.role
        {
            leading.past.rotate_left(1);
            leading.past[3] = (member.commit, leading.round);
        }
    }
}
