//! What the leader does: it puts messages into the log, sends it to all, and sees what is decided.
//!
//! Invariant: an entry of the leader's term that a quorum of the voters has is decided, and with it all
//! before (Ongaro and Ousterhout 2014, section 5.4). Who votes is changed by one life at a time, and only
//! when the last change is decided, so that any quorum before meets any quorum after it.

use super::following::remember;
use super::packet::{Body, Entry, Life, Sender, What};
use super::{CHUNK, MOST_BYTES, MOST_LOG, Member, Role, Total};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::{Destination, Payload, Robot, RobotId};

/// A leader that has not heard of a quorum for this many ticks leads no more.
const LONGEST_SILENCE: u32 = 8;

/// The log is kept for followers that were not heard for fewer ticks than this.
const LONGEST_ABSENCE: u32 = 240;

/// A leader's knowledge of the others.
#[derive(Clone, Debug)]
pub(super) struct Leading {
    /// Ticks since it was elected.
    age: u32,
    /// The first entry of its term.
    start: u64,
    /// All have been sent the log up to here.
    sent: u64,
    /// The decided part of the log of which all have been told.
    told: u64,
    followers: BTreeMap<RobotId, Follower>,
    /// The number of each sender's last message in the log.
    senders: BTreeMap<Sender, u32>,
}

/// Another member, as its leader knows it.
#[derive(Clone, Debug)]
struct Follower {
    life: Life,
    /// Its log is the leader's up to here.
    matched: u64,
    applied: u64,
    /// Ticks since it was heard.
    silence: u32,
    /// It is sent what it lacks.
    is_behind: bool,
}

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
        let term = ("term", member.term.into());
        self.report(robot, "lead", [term]);
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

impl Member {
    /// Whether more may be put into the log before what is in it is decided.
    fn has_room(&self) -> bool {
        let undecided = self.log.last().saturating_sub(self.commit);
        undecided == 0 || undecided < MOST_LOG && self.log.bytes() < 2 * MOST_BYTES
    }

    fn put(&mut self, what: What) {
        let term = self.term;
        self.log.push(Entry { term, what });
    }

    /// What follows an entry, up to the size of a datagram, and the last that it holds.
    fn append_after(&self, previous: u64, last: u64, floor: u64, is_beat: bool) -> (Body, u64) {
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
        let body = Body::Append {
            term: self.term,
            previous,
            previous_term: self.log.term(previous).unwrap_or(0),
            entries,
            commit: self.commit,
            floor,
            is_beat,
        };
        (body, end)
    }

    /// Up to where entries need not be kept: all that are heard of have handed them out, or there are
    /// too many.
    fn floor(&self) -> u64 {
        let Role::Leading(leading) = &self.role else {
            return 0;
        };
        let is_heard = |voter: &Life| {
            leading.followers.contains_key(&voter.robot) || Some(*voter) == self.leader
        };
        if leading.age < LONGEST_ABSENCE
            && !self.log.is_long()
            && !self.log.voters().iter().all(is_heard)
        {
            return self.log.base();
        }
        let followers = leading.followers.values();
        let near = followers.filter(|follower| follower.silence < LONGEST_ABSENCE);
        let slowest = near.map(|follower| follower.applied).min().unwrap_or(0);
        match self.log.is_long() {
            true => self.applied.min(self.log.base() + MOST_LOG / 4),
            false => slowest.min(self.applied),
        }
    }

    /// Lets those vote who have come, in place of their earlier lives.
    fn admit(&mut self) {
        let Role::Leading(leading) = &self.role else {
            return;
        };
        if self.log.voters_since() > self.commit || leading.start > self.commit {
            return;
        }
        let voters = self.log.voters();
        let is_replaced = |voter: &&Life| {
            let follower = leading.followers.get(&voter.robot);
            follower.is_some_and(|follower| follower.life != **voter)
        };
        let votes = |life: &Life| voters.iter().any(|voter| voter.robot == life.robot);
        let mut changed = voters.to_vec();
        if let Some(replaced) = voters.iter().find(is_replaced) {
            changed.retain(|voter| voter != replaced);
        } else if let Some(new) = leading
            .followers
            .values()
            .find(|f| f.silence <= 2 && f.matched >= self.commit && !votes(&f.life))
        {
            changed.push(new.life);
            changed.sort_unstable();
        } else {
            return;
        }
        self.put(What::Voters(changed));
    }
}

impl Entry {
    /// About how long it is in a datagram, bytes.
    pub(super) fn size(&self) -> usize {
        match &self.what {
            What::Start => 4,
            What::Voters(voters) => 4 + 8 * voters.len(),
            What::Message { content, .. } => 16 + content.len(),
        }
    }
}
