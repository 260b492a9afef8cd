//! What a member takes from its leader, and hands out.
//!
//! Invariant: what is decided is never dropped from the log before it is handed out, nor replaced; and
//! messages are handed out in the order of generation and index, never going back.

use super::packet::{Body, Entry, Generation, Life, Sender, What};
use super::{Gap, Member, Role, Total};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::event::messaging::LeaveReason;
use starl_core::event::messaging::MessageNumber;
use starl_core::event::{BroadcastEvent, TransferEvent};
use starl_core::{Destination, Robot};

/// The incarnations of a robot whose last message is remembered.
const INCARNATIONS: usize = 4;

/// How a leader's log goes on.
pub(super) struct Continuation {
    pub term: u32,
    pub previous: u64,
    pub previous_term: u32,
    pub entries: Vec<Entry>,
    pub commit: u64,
    pub floor: u64,
    pub is_beat: bool,
}

/// Where a robot can go on.
pub(super) struct Place {
    pub quorum: u32,
    pub term: u32,
    pub index: u64,
    pub index_term: u32,
    pub voters: Vec<Life>,
    pub senders: Vec<(Sender, u32)>,
}

impl Total {
    /// The leader's log goes on.
    pub(super) fn append(&mut self, robot: &mut Robot<'_>, from: Life, next: Continuation) {
        let Some(member) = &mut self.member else {
            return;
        };
        let latest = member.term.saturating_add(super::FURTHEST);
        if next.term > latest || next.term == member.term && member.is_leading() {
            return;
        }
        if next.term < member.term {
            // The leader has to hear of the later term, or it would never lead this robot again.
            let answer = member.lacking();
            return self.say(robot, Destination::Robot(from.robot), answer);
        }
        let had_leader = member.leader == Some(from);
        member.follow(from, next.term);
        let has_news = !next.entries.is_empty() || next.is_beat;
        let through = match member.take(next.previous, next.previous_term, next.entries) {
            Ok(Some(through)) => {
                member.commit = member.commit.max(next.commit.min(through));
                Some(through)
            }
            Ok(None) => None,
            // What is decided cannot differ: the state is corrupt.
            Err(()) => return self.leave(robot, LeaveReason::Corrupt),
        };
        self.apply(robot);
        let Some(member) = &mut self.member else {
            return;
        };
        member.log.drop_through(next.floor.min(member.applied));
        let answer = Body::Taken {
            term: member.term,
            through: through.unwrap_or(member.commit),
            is_whole: through.is_some(),
            applied: member.applied,
        };
        if has_news || through.is_none() {
            self.say(robot, Destination::Robot(from.robot), answer);
        }
        if !had_leader {
            self.propose(robot);
        }
    }

    /// The leader says where this robot can go on.
    pub(super) fn go_on(
        &mut self,
        robot: &mut Robot<'_>,
        from: Life,
        generation: Generation,
        place: Place,
    ) {
        let is_member = |member: &Member| member.generation == generation;
        let fleet = robot.fleet().len();
        let is_sound = !place.voters.is_empty()
            && place.index_term <= place.term
            && place.voters.len() <= fleet.max(place.quorum as usize) * 2
            && place.senders.len() <= fleet.saturating_mul(INCARNATIONS + 1);
        if !is_sound {
            return;
        }
        let is_new = match &self.member {
            None if self.may_join(generation) => true,
            Some(member)
                if is_member(member) && !member.is_leading() && place.term >= member.term =>
            {
                false
            }
            _ => return,
        };
        let mut member = Member::at(
            generation,
            place.quorum,
            (place.index, place.index_term),
            place.voters,
        );
        member.senders = place.senders.into_iter().collect();
        if is_new {
            self.join(robot, member);
        } else if let Some(present) = &mut self.member
            && place.index > present.applied
        {
            present.log = member.log;
            present.senders = member.senders;
            present.quorum = member.quorum;
            present.commit = place.index;
            present.applied = place.index;
            self.miss(robot);
        }
        let Some(member) = &mut self.member else {
            return;
        };
        member.follow(from, place.term);
        let answer = Body::Taken {
            term: member.term,
            through: member.commit,
            is_whole: true,
            applied: member.applied,
        };
        self.settle_proposed(robot);
        self.say(robot, Destination::Robot(from.robot), answer);
        self.propose(robot);
    }

    /// Hands out what is decided.
    pub(super) fn apply(&mut self, robot: &mut Robot<'_>) {
        let me = (robot.id(), self.incarnation.of(robot));
        let mut is_own = false;
        while let Some(member) = &mut self.member
            && member.applied < member.commit
            && let Some(entry) = member.log.get(member.applied + 1)
        {
            let index = member.applied + 1;
            member.applied = index;
            let What::Message {
                sender,
                number,
                content,
            } = &entry.what
            else {
                continue;
            };
            let (sender, number, content) = (*sender, *number, content.clone());
            remember(&mut member.senders, sender, number);
            let position = Some((member.generation, index));
            if self.position < position {
                self.position = position;
                self.hand_out(robot, sender, number, content);
            }
            if sender == me {
                is_own = true;
            }
        }
        if is_own {
            self.settle_proposed(robot);
            self.propose(robot);
        }
    }

    fn hand_out(
        &mut self,
        robot: &mut Robot<'_>,
        (from, incarnation): Sender,
        number: u32,
        content: starl_core::Payload,
    ) {
        let message = MessageNumber {
            number,
            incarnation,
        };
        let deliver = TransferEvent::Deliver { from, message };
        robot.report(self.port, BroadcastEvent::from(deliver));
        robot.deliver(from, self.port, content);
    }

    /// Others may have been handed messages that this robot will not be.
    pub(super) fn miss(&mut self, robot: &mut Robot<'_>) {
        robot.report(self.port, BroadcastEvent::Gap);
        self.gaps.push(Gap { from: None });
    }
}

/// Takes note of a sender's last message, and forgets those of its incarnations that spoke least.
pub(super) fn remember(senders: &mut BTreeMap<Sender, u32>, sender: Sender, number: u32) {
    senders.insert(sender, number);
    let robot = sender.0;
    let of_robot = |senders: &BTreeMap<Sender, u32>| -> Vec<(u32, u32)> {
        let range = senders.range((robot, 0)..=(robot, u32::MAX));
        range
            .map(|(&(_, incarnation), &last)| (last, incarnation))
            .collect()
    };
    let known = of_robot(senders);
    if known.len() > INCARNATIONS {
        let others = known.into_iter().filter(|known| known.1 != sender.1);
        if let Some((_, least)) = others.min() {
            senders.remove(&(robot, least));
        }
    }
}

impl Member {
    pub(super) fn is_leading(&self) -> bool {
        matches!(self.role, Role::Leading(_))
    }

    /// That it could not take what it was sent.
    fn lacking(&self) -> Body {
        Body::Taken {
            term: self.term,
            through: self.commit,
            is_whole: false,
            applied: self.applied,
        }
    }

    /// Takes entries that come after one. Gives the last that is the leader's; none where something is
    /// missing before.
    fn take(
        &mut self,
        previous: u64,
        previous_term: u32,
        entries: Vec<Entry>,
    ) -> Result<Option<u64>, ()> {
        let mut index = previous;
        let is_known = previous < self.commit && previous <= self.log.last();
        if !is_known && self.log.term(previous) != Some(previous_term) {
            return Ok(None);
        }
        for entry in entries {
            index += 1;
            if index <= self.log.base() {
                continue;
            }
            match self.log.get(index) {
                Some(known) if known.term == entry.term => continue,
                Some(_) if index <= self.commit => return Err(()),
                Some(_) => self.log.truncate(index - 1),
                None => {}
            }
            self.log.push(entry);
        }
        Ok(Some(index))
    }
}
