//! What a robot knows as a member of a group.

use super::followers::Leading;
use super::log::Log;
use super::packet::{Generation, Life, Sender};
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

/// A member of a group.
#[derive(Clone, Debug)]
pub(super) struct Member {
    pub generation: Generation,
    /// No fewer than this many decide: a majority of the fleet that founded it.
    pub quorum: u32,
    /// The latest term that it has heard of.
    pub term: u32,
    /// For whom it voted in that term.
    pub vote: Option<Life>,
    pub log: Log,
    /// The log is decided up to here.
    pub commit: u64,
    /// Messages up to here have been handed out.
    pub applied: u64,
    /// The number of each sender's last message up to there.
    pub senders: BTreeMap<Sender, u32>,
    /// Who leads in that term, as far as known.
    pub leader: Option<Life>,
    /// Ticks since the leader was heard; of a leader, since it heard of a quorum.
    pub silence: u32,
    /// It asks to lead after so many.
    pub patience: u32,
    pub role: Role,
    /// Whether a leader of the group was ever heard of.
    pub is_active: bool,
    /// Voters that have died, or are members of another group for good.
    pub gone: BTreeSet<Life>,
}

/// What a member does.
#[derive(Clone, Debug)]
pub(super) enum Role {
    Following,
    /// It asks to lead.
    Asking {
        trial: bool,
        votes: BTreeSet<Life>,
    },
    Leading(Leading),
}

impl Member {
    /// A member whose log begins after this place.
    pub fn at(
        generation: Generation,
        quorum: u32,
        (index, term): (u64, u32),
        voters: Vec<Life>,
    ) -> Member {
        Member {
            generation,
            quorum,
            term,
            vote: None,
            log: Log::after(index, term, voters),
            commit: index,
            applied: index,
            senders: BTreeMap::new(),
            leader: None,
            silence: 0,
            patience: 0,
            role: Role::Following,
            is_active: false,
            gone: BTreeSet::new(),
        }
    }

    /// How many of the voters decide.
    pub fn needed(&self) -> usize {
        let majority = self.log.voters().len() / 2 + 1;
        majority.max(self.quorum as usize)
    }

    /// Whether these are enough of the voters to decide.
    pub fn is_quorum(&self, lives: &BTreeSet<Life>) -> bool {
        let voters = self.log.voters().iter();
        voters.filter(|voter| lives.contains(voter)).count() >= self.needed()
    }

    /// A robot has said, when asked, that it is this life. If another one of it votes, that one is gone.
    pub fn see(&mut self, life: Life, is_elsewhere: bool) {
        for voters in [self.log.voters(), self.log.voters_at(self.commit)] {
            let voter = voters.iter().find(|voter| voter.robot == life.robot);
            if let Some(&voter) = voter
                && (voter != life || is_elsewhere)
            {
                self.gone.insert(voter);
            }
        }
    }

    /// Whether so many voters are gone that the others will never be enough.
    pub fn is_dead(&self) -> bool {
        let is_dead = |voters: &[Life]| {
            let left = voters.iter().filter(|voter| !self.gone.contains(voter));
            left.count() < (voters.len() / 2 + 1).max(self.quorum as usize)
        };
        // Who votes by an entry that is not decided may yet be who voted before.
        is_dead(self.log.voters()) && is_dead(self.log.voters_at(self.commit))
    }

    /// Whether its parts fit together, as they always do unless a fault has changed them.
    pub fn is_sound(&self) -> bool {
        self.log.base() <= self.applied
            && self.applied <= self.commit
            && self.commit <= self.log.last()
            && self.log.last_term() <= self.term
            && !self.log.voters().is_empty()
    }

    /// Takes note of a later term.
    pub fn enter_term(&mut self, term: u32) {
        if term > self.term {
            self.term = term;
            self.vote = None;
            self.leader = None;
            self.role = Role::Following;
        }
    }

    /// Someone is in this term; if it is later than this robot's, it leads no more and asks again soon.
    pub fn hear_of(&mut self, term: u32) {
        if term > self.term {
            self.enter_term(term);
            self.silence = self.silence.max(self.patience);
        }
    }

    /// A leader of this term speaks.
    pub fn follow(&mut self, leader: Life, term: u32) {
        self.enter_term(term);
        if !matches!(self.role, Role::Leading(_)) {
            self.role = Role::Following;
        }
        self.leader = Some(leader);
        self.silence = 0;
        self.is_active = true;
    }
}
