//! The state of a robot as a member of a group.

use super::early::Early;
use super::followers::Leading;
use super::life::Life;
use super::log::Log;
use super::packet::Generation;
use super::roll::Roll;
use alloc::collections::BTreeSet;

/// A member of a group.
#[derive(Clone, Debug)]
pub(super) struct Member {
    pub generation: Generation,
    /// No fewer than this many decide: a majority of the fleet that founded it.
    pub quorum: u32,
    /// The latest term that it has heard of.
    pub term: u32,
    /// The life for which it voted in that term.
    pub vote: Option<Life>,
    pub log: Log,
    /// The log is decided up to here.
    pub commit: u64,
    /// Messages up to this index have been delivered.
    pub applied: u64,
    /// The lives that may send up to there.
    pub roll: Roll,
    /// The leader in that term, as far as known.
    pub leader: Option<Life>,
    /// The last of that leader's rounds and calls that it has heard.
    pub round: u64,
    pub call: u64,
    /// The leader that counted this round, and its term. A corrupted term may be that of a later leader.
    pub counted_by: Option<(Life, u32)>,
    /// How often it has asked to lead since a leader was heard.
    pub asked: u32,
    /// The log is known to be that leader's up to here.
    pub agreed: u64,
    /// Parts of that leader's log that arrived early.
    pub early: Early,
    /// Ticks since the leader was heard; of a leader, since it heard of a quorum.
    pub silence: u32,
    /// It starts an election after this number of beats.
    pub patience: u32,
    pub role: Role,
    /// Whether a leader of the group was ever heard of.
    pub is_active: bool,
    /// Voters that have died, or are members of another group permanently.
    pub gone: BTreeSet<Life>,
}

/// The role of a member.
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
        roll: Roll,
    ) -> Member {
        let voters = roll.rows().iter().map(|row| row.0).collect();
        Member {
            generation,
            quorum,
            term,
            vote: None,
            log: Log::after(index, term, voters),
            commit: index,
            applied: index,
            roll,
            leader: None,
            round: 0,
            call: 0,
            counted_by: None,
            asked: 0,
            agreed: 0,
            early: Early::default(),
            silence: 0,
            patience: 0,
            role: Role::Following,
            is_active: false,
            gone: BTreeSet::new(),
        }
    }

    /// Whether these are enough of the voters to decide.
    pub fn is_quorum(&self, lives: &BTreeSet<Life>) -> bool {
        let voters = self.log.voters().iter();
        voters.filter(|voter| lives.contains(voter)).count() >= self.needed()
    }

    /// A robot has answered that it is in this life. If another of its lives is a voter, that life is over.
    pub fn see(&mut self, life: Life, is_elsewhere: bool) {
        let either = [self.log.voters(), self.log.voters_at(self.commit)];
        for voters in either {
            let voter = voters.iter().find(|voter| voter.robot == life.robot);
            if let Some(&voter) = voter
                && (voter != life || is_elsewhere)
            {
                self.gone.insert(voter);
            }
        }
        let votes = |life: &Life| either.iter().any(|voters| voters.contains(life));
        self.gone.retain(votes);
    }

    /// Whether too many voters have failed for the others to decide ever again.
    pub fn is_dead(&self) -> bool {
        let is_dead = |voters: &[Life]| {
            let left = voters.iter().filter(|voter| !self.gone.contains(voter));
            left.count() < self.needed_of(voters.len())
        };
        // The voters by an undecided entry may still be the previous ones.
        is_dead(self.log.voters()) && is_dead(self.log.voters_at(self.commit))
    }

    /// Whether its parts fit together, as they always do unless a fault has changed them.
    pub fn is_sound(&self) -> bool {
        self.log.base() <= self.applied
            && self.applied <= self.commit
            && self.commit <= self.log.last()
            && self.log.last_term() <= self.term
            && !self.log.voters().is_empty()
            && self.roll.is_of(self.log.voters_at(self.applied))
    }

    /// Records a later term.
    pub fn enter_term(&mut self, term: u32) {
        if term > self.term {
            self.term = term;
            self.vote = None;
            self.leader = None;
            (self.round, self.call, self.agreed) = (0, 0, 0);
            self.early = Early::default();
            self.role = Role::Following;
        }
    }

    /// Some robot is in this term; if it is later than this robot's, this robot no longer leads and asks again soon.
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
        self.asked = 0;
        self.is_active = true;
    }
}
