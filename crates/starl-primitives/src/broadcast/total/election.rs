//! The election of the leader: the robot for which a quorum voted in its term (Ongaro and
//! Ousterhout 2014).
//!
//! Invariant: a life votes once in a term, and only for a life whose log contains the voter's log up to its
//! last term. Before a robot asks for votes it asks whether it would be elected, and robots that hear a
//! leader refuse: a robot that returns from a partition does not replace a leader.

use super::life::Life;
use super::packet::{Body, Question};
use super::{FURTHEST, Role, Total};
use alloc::collections::BTreeSet;
use starl_core::event::messaging::LeaveReason;
use starl_core::{Destination, Robot};

/// A robot that has heard the leader within this number of ticks votes for no other.
const LOYALTY: u32 = 6;

/// A robot that is refused after it has asked this often without a leader accepts every round of the leader again.
const MANY_ASKS: u32 = 8;

/// The claim of a robot that wants to lead.
#[derive(Clone, Copy)]
pub(super) struct Claim {
    pub number: u32,
    pub trial: bool,
    pub term: u32,
    pub last_term: u32,
    pub last: u64,
}

impl Total {
    /// Asks all whether they vote for this robot.
    pub(super) fn ask(&mut self, robot: &mut Robot<'_>, trial: bool) {
        let life = self.life(robot);
        let patience = super::patience(robot);
        let Some(member) = &mut self.member else {
            return;
        };
        let is_voter = member.log.voters().contains(&life);
        if !trial && !is_voter {
            return;
        }
        self.ask_number = self.ask_number.wrapping_add(1);
        if !trial {
            member.enter_term(member.term.saturating_add(1));
            member.vote = Some(life);
        }
        member.see(life, false);
        if member.is_dead() {
            return self.leave(robot, LeaveReason::Lost);
        }
        member.patience = patience;
        member.silence = 0;
        member.asked = member.asked.saturating_add(1);
        member.leader = None;
        member.role = Role::Asking {
            trial,
            votes: BTreeSet::from([life]),
        };
        self.send_ask(robot);
        self.count_votes(robot);
    }

    /// Asks, or asks again those whose answers may have been lost.
    pub(super) fn send_ask(&mut self, robot: &mut Robot<'_>) {
        let Some(member) = &self.member else { return };
        let &Role::Asking { trial, .. } = &member.role else {
            return;
        };
        let term = member.term.saturating_add(u32::from(trial));
        let end = (member.log.last_term(), member.log.last());
        let body = self.question(trial, term, end);
        self.say(robot, Destination::All, body);
    }

    /// Asks for votes for a term, with a log of this end; or, outside of groups, asks which robots
    /// are there.
    pub(super) fn question(&self, trial: bool, term: u32, (last_term, last): (u32, u64)) -> Body {
        Body::Ask {
            number: self.ask_number,
            trial,
            term,
            last_term,
            last,
        }
    }

    /// Another member wants to lead.
    pub(super) fn consider(&mut self, robot: &mut Robot<'_>, from: Life, claim: Claim) {
        let Some(member) = &mut self.member else {
            return;
        };
        let to = Destination::Robot(from.robot);
        let question = Question {
            asker: from.name,
            number: claim.number,
        };
        let refusal = Body::Vote {
            question,
            term: member.term,
            is_granted: false,
        };
        if claim.term > member.term.saturating_add(FURTHEST) {
            return self.say(robot, to, refusal);
        }
        let hears_leader = matches!(member.role, Role::Leading(_))
            || member.leader.is_some() && member.silence < LOYALTY;
        let end = (member.log.last_term(), member.log.last());
        let is_whole = (claim.last_term, claim.last) >= end;
        let is_late = claim.term < member.term || claim.trial && claim.term == member.term;
        if hears_leader || is_late {
            return self.say(robot, to, refusal);
        }
        if !claim.trial {
            member.enter_term(claim.term);
        }
        if !is_whole || !claim.trial && member.vote.is_some_and(|vote| vote != from) {
            return self.say(robot, to, refusal);
        }
        if !claim.trial && member.vote.is_none() {
            member.vote = Some(from);
            member.silence = 0;
        }
        let vote = Body::Vote {
            question,
            term: member.term,
            is_granted: true,
        };
        self.say(robot, to, vote);
    }

    /// Whether a robot answers what this one is asking now, as the life that it is now.
    pub(super) fn is_asking(&mut self, robot: &mut Robot<'_>, question: Question) -> bool {
        let present = Question {
            asker: self.life(robot).name,
            number: self.ask_number,
        };
        let is_asking = match &self.member {
            Some(member) => matches!(member.role, Role::Asking { .. }),
            None => self.is_mustering(),
        };
        is_asking && question == present
    }

    /// A member says whether it votes for this robot.
    pub(super) fn answered(
        &mut self,
        robot: &mut Robot<'_>,
        from: Life,
        question: Question,
        (term, is_granted): (u32, bool),
    ) {
        if !self.is_asking(robot, question) {
            return;
        }
        let Some(member) = &mut self.member else {
            return;
        };
        member.see(from, false);
        if is_granted && let Role::Asking { votes, .. } = &mut member.role {
            votes.insert(from);
        }
        let is_absurd = member.term > term.saturating_add(FURTHEST);
        if is_absurd || member.is_dead() {
            let reason = if is_absurd {
                LeaveReason::Corrupt
            } else {
                LeaveReason::Lost
            };
            return self.leave(robot, reason);
        }
        if !is_granted && term == member.term {
            // A leader of that term may be there, of which this robot believes to have heard more than it said. Only a
            // corruption leaves it so. Robots that have just heard a leader that has crashed refuse too, but not for
            // long, and late copies of what that leader said must not count.
            if member.asked >= MANY_ASKS {
                (member.asked, member.round) = (0, 0);
            }
        }
        match is_granted {
            true => self.count_votes(robot),
            false if term <= member.term.saturating_add(FURTHEST) => member.enter_term(term),
            false => {}
        }
    }

    fn count_votes(&mut self, robot: &mut Robot<'_>) {
        let Some(member) = &self.member else { return };
        let Role::Asking { trial, votes, .. } = &member.role else {
            return;
        };
        if !member.is_quorum(votes) {
            return;
        }
        match trial {
            true => self.ask(robot, false),
            false => self.lead(robot),
        }
    }
}
