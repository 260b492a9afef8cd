//! What a leader knows of the other members, and what follows for the log.

use super::packet::{Body, Entry, Life, Sender, What};
use super::{CHUNK, MOST_BYTES, MOST_LOG, Member, Role};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::RobotId;

/// The log is kept for followers that were not heard for fewer ticks than this.
const LONGEST_ABSENCE: u32 = 240;

/// A leader's knowledge of the others.
#[derive(Clone, Debug)]
pub(super) struct Leading {
    /// Ticks since it was elected.
    pub age: u32,
    /// The first entry of its term.
    pub start: u64,
    /// All have been sent the log up to here.
    pub sent: u64,
    /// The decided part of the log of which all have been told.
    pub told: u64,
    pub followers: BTreeMap<RobotId, Follower>,
    /// The number of each sender's last message in the log.
    pub senders: BTreeMap<Sender, u32>,
}

/// Another member, as its leader knows it.
#[derive(Clone, Debug)]
pub(super) struct Follower {
    pub life: Life,
    /// Its log is the leader's up to here.
    pub matched: u64,
    pub applied: u64,
    /// Ticks since it was heard.
    pub silence: u32,
    /// It is sent what it lacks.
    pub is_behind: bool,
}

impl Member {
    /// Whether more may be put into the log before what is in it is decided.
    pub fn has_room(&self) -> bool {
        let undecided = self.log.last().saturating_sub(self.commit);
        undecided == 0 || undecided < MOST_LOG && self.log.bytes() < 2 * MOST_BYTES
    }

    pub fn put(&mut self, what: What) {
        let term = self.term;
        self.log.push(Entry { term, what });
    }

    /// What follows an entry, up to the size of a datagram, and the last that it holds.
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
    pub fn floor(&self) -> u64 {
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
    pub fn admit(&mut self) {
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
    pub fn size(&self) -> usize {
        match &self.what {
            What::Start => 4,
            What::Voters(voters) => 4 + 8 * voters.len(),
            What::Message { content, .. } => 16 + content.len(),
        }
    }
}
