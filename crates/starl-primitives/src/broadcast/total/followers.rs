//! The leader's knowledge of the other members, and the consequences for the log.
//!
//! Invariant: of the lives of one robot the leader goes by the latest that it has heard. A life takes the place
//! of another one only if it has answered a later call, and a call goes to one life, after that was heard:
//! an earlier life, from which something arrives late, was dead by then and never answers it.

use super::feeding::Answer;
use super::life::Life;
use super::packet::{Body, Entry, What};
use super::roll::Roll;
use super::{CHUNK, MOST_BYTES, Member, Role};
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
    /// The decided part of the log that all have received.
    pub told: u64,
    /// The decided index at the last ticks, and the round then, the oldest first.
    pub past: [(u64, u64); 4],
    /// Counts the rounds of datagrams; datagrams that were sent together count once.
    pub round: u64,
    /// Counts its calls.
    pub calls: u64,
    pub followers: BTreeMap<RobotId, Follower>,
    /// The lives that may add messages after the last entry of the log.
    pub roll: Roll,
}

/// Another member, as its leader knows it.
#[derive(Clone, Debug)]
pub(super) struct Follower {
    pub life: Life,
    /// The last round and the last call of the leader that it has heard.
    pub round: u64,
    pub call: u64,
    /// Its log is the leader's up to here.
    pub matched: u64,
    pub applied: u64,
    /// Ticks since it was heard.
    pub silence: u32,
    /// It alone was last sent entries up to here, in this round.
    pub fed_through: u64,
    pub fed: u64,
}

impl Leading {
    pub fn follower(&mut self, life: Life) -> Option<&mut Follower> {
        let follower = self.followers.get_mut(&life.robot);
        follower.filter(|follower| follower.life == life)
    }
}

impl Follower {
    pub fn new(life: Life) -> Follower {
        Follower {
            life,
            round: 0,
            call: 0,
            matched: 0,
            applied: 0,
            silence: 0,
            fed_through: 0,
            fed: 0,
        }
    }

    /// Records an answer, which is a sign of life if it has heard a round since this one.
    pub fn take_note(&mut self, answer: &Answer, since: u64) {
        if answer.round > since {
            self.silence = 0;
        }
        self.round = self.round.max(answer.round);
        self.call = self.call.max(answer.call);
        self.matched = self.matched.max(answer.through);
        self.applied = self.applied.max(answer.applied);
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
