//! The leader's knowledge of the other members.
//!
//! Invariant: of the lives of one robot the leader goes by the latest that it has heard. A life takes the place
//! of another one only if it has answered a later call, and a call goes to one life, after that was heard:
//! an earlier life, from which something arrives late, was dead by then and never answers it.

use super::life::Life;
use super::relaying::Link;
use super::roll::Roll;
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::RobotId;

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
    /// How robots hear this one, and this one them.
    pub links: BTreeMap<RobotId, Link>,
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

/// A member's report about its log.
pub(super) struct Answer {
    pub term: u32,
    pub round: u64,
    pub through: u64,
    pub lacks: Vec<(u64, u64)>,
    pub applied: u64,
    pub call: u64,
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
