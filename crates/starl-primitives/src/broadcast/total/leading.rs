//! What the leader does: it puts messages into the log, sends it to all, and sees what is decided.
//!
//! Invariant: an entry of the leader's term that a quorum of the voters has is decided, and with it all
//! before (Ongaro and Ousterhout 2014, section 5.4). Who votes is changed by one life at a time, and only
//! when the last change is decided, so that any quorum before meets any quorum after it.

use super::followers::{Follower, Leading};
use super::following::remember;
use super::packet::{Body, Entry, Life, Sender, What};
use super::{Role, Total};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::event::BroadcastEvent;
use starl_core::{Destination, Payload, Robot, RobotId};

/// A leader that has not heard of a quorum for this many ticks leads no more.
const LONGEST_SILENCE: u32 = 8;

impl Total {
    /// This robot has been elected.
    pub(super) fn lead(&mut self, robot: &mut Robot<'_>) {
        let life = self.life(robot);
        let Some(member) = &mut self.member else {
            return;
        };
        let mut senders = member.senders.clone();
        for index in member.applied + 1..=member.log.last() {
            if let Some(Entry {
                what: What::Message { sender, number, .. },
                ..
            }) = member.log.get(index)
            {
                senders.insert(*sender, *number);
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
            followers: BTreeMap::new(),
            senders,
        });
        member.put(What::Start);
        let term = member.term;
        robot.report(self.port, BroadcastEvent::Lead { term });
        self.replicate(robot, true);
        self.propose(robot);
    }

    /// Messages for the log.
    pub(super) fn put_messages(
        &mut self,
        robot: &mut Robot<'_>,
        sender: Sender,
        messages: Vec<(u32, Payload)>,
    ) {
        let Some(member) = &mut self.member else {
            return;
        };
        for (number, content) in messages {
            let has_room = member.has_room();
            let Role::Leading(leading) = &mut member.role else {
                return;
            };
            let last = leading.senders.get(&sender).copied().unwrap_or(0);
            // With so much undecided, it has to be proposed again.
            if last < number && has_room {
                remember(&mut leading.senders, sender, number);
                member.put(What::Message {
                    sender,
                    number,
                    content,
                });
            }
        }
        self.replicate(robot, false);
    }

    /// Sends all what is new in the log, unless the last that was sent is not decided: then it is sent with
    /// what comes meanwhile. A beat is sent in any case.
    pub(super) fn replicate(&mut self, robot: &mut Robot<'_>, is_beat: bool) {
        self.decide(robot);
        let Some(member) = &mut self.member else {
            return;
        };
        let floor = member.floor();
        let Role::Leading(leading) = &mut member.role else {
            return;
        };
        let may_send = is_beat || leading.sent <= member.commit;
        let has_news = leading.sent < member.log.last() && may_send;
        if !has_news && !is_beat && leading.told >= member.commit {
            return;
        }
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

    /// A member has taken entries, or lacks some.
    pub(super) fn taken_by(
        &mut self,
        robot: &mut Robot<'_>,
        from: Life,
        (through, is_whole, applied): (u64, bool, u64),
    ) {
        let Some(member) = &mut self.member else {
            return;
        };
        let Role::Leading(leading) = &mut member.role else {
            return;
        };
        if through > member.log.last() {
            return; // no member has more than its leader
        }
        let new = Follower {
            life: from,
            matched: 0,
            applied: 0,
            silence: 0,
            is_behind: false,
        };
        let follower = leading.followers.entry(from.robot).or_insert(new.clone());
        if follower.life != from {
            *follower = new;
        }
        follower.silence = 0;
        if applied < follower.applied {
            return; // it comes late
        }
        follower.applied = applied;
        if is_whole {
            follower.matched = follower.matched.max(through);
        } else {
            follower.is_behind = true;
        }
        let lacks = through < leading.sent && follower.is_behind;
        follower.is_behind &= lacks;
        let last = leading.sent;
        if lacks && through < member.log.base() {
            self.send_snapshot(robot, from.robot);
        } else if lacks {
            let floor = member.floor();
            let (body, _) = member.append_after(through, last, floor, true);
            self.say(robot, Destination::Robot(from.robot), body);
        }
        self.replicate(robot, false);
    }

    /// Sends a robot what it has to know to go on from here.
    pub(super) fn send_snapshot(&self, robot: &mut Robot<'_>, to: RobotId) {
        let Some(member) = &self.member else { return };
        let index = member.applied;
        let body = Body::Snapshot {
            quorum: member.quorum,
            term: member.term,
            index,
            index_term: member.log.term(index).unwrap_or(0),
            voters: member.log.voters_at(index).to_vec(),
            senders: member.senders.iter().map(|(&s, &n)| (s, n)).collect(),
        };
        self.say(robot, Destination::Robot(to), body);
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
        let mut near: alloc::collections::BTreeSet<Life> = near.map(|f| f.life).collect();
        near.insert(life);
        if member.is_quorum(&near) {
            member.silence = 0;
        } else if member.silence >= LONGEST_SILENCE {
            member.role = Role::Following;
            member.leader = None;
            return;
        }
        member.admit();
        self.replicate(robot, true);
    }
}
