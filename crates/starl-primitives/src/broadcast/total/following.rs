//! Entries that a member gets from its leader and delivers.
//!
//! Invariant: a decided entry is never replaced, nor dropped from the log before it is delivered. Entries that this
//! robot has acknowledged to a leader stay in its log as long as that robot leads. Messages are delivered in ascending
//! order of generation and index.

use super::early::Part;
use super::life::Life;
use super::packet::{Body, Entry, What};
use super::{Gap, Member, Role, Total};
use alloc::vec::Vec;
use starl_core::event::messaging::LeaveReason;
use starl_core::event::messaging::MessageNumber;
use starl_core::event::{BroadcastEvent, TransferEvent};
use starl_core::{Destination, Payload, Robot};

/// The continuation of a leader's log.
pub(super) struct Continuation {
    pub term: u32,
    pub round: u64,
    pub part: Part,
    pub commit: u64,
    pub floor: u64,
    pub is_beat: bool,
}

impl Total {
    /// Appends the continuation of the leader's log.
    pub(super) fn append(&mut self, robot: &mut Robot<'_>, from: Life, next: Continuation) {
        let Some(member) = &mut self.member else {
            return;
        };
        let latest = member.term.saturating_add(super::FURTHEST);
        if next.term > latest || next.term == member.term && member.is_leading() {
            return;
        }
        let to = Destination::Robot(from.robot);
        if next.term < member.term {
            // The leader has to hear of the later term, or it would never lead this robot again.
            let answer = member.taken(Vec::new());
            return self.say(robot, to, answer);
        }
        let had_leader = member.leader == Some(from);
        // Late duplicates are not a sign of life of the leader.
        let counter = Some((from, next.term));
        if next.term > member.term || next.round > member.round || member.counted_by != counter {
            member.follow(from, next.term);
            (member.round, member.counted_by) = (next.round, counter);
        } else if !had_leader {
            return;
        }
        let has_entries = !next.part.entries.is_empty();
        let has_news = has_entries || next.is_beat;
        let previous = next.part.previous;
        if member.take(next.part).is_err() {
            // Decided entries cannot differ, so the state is corrupt.
            return self.leave(robot, LeaveReason::Corrupt);
        }
        member.commit = member.commit.max(next.commit.min(member.agreed));
        self.apply(robot);
        let Some(member) = &mut self.member else {
            return;
        };
        member.log.drop_through(next.floor.min(member.applied));
        let lacks = member.early.gaps(member.through(), previous);
        let is_whole = lacks.is_empty();
        let answer = member.taken(lacks);
        if has_news || !is_whole {
            self.say(robot, to, answer);
        }
        if !had_leader {
            self.propose_anew(robot);
        } else if self.sent == 0 {
            self.propose(robot); // it may vote by now
        } else if has_entries && is_whole {
            self.watch_proposed(robot);
        }
    }

    /// The leader wants a sign of life.
    pub(super) fn called(&mut self, robot: &mut Robot<'_>, from: Life, (term, call): (u32, u64)) {
        let Some(member) = &mut self.member else {
            return;
        };
        if term == member.term && member.leader == Some(from) {
            member.call = member.call.max(call);
            let answer = member.taken(Vec::new());
            self.say(robot, Destination::Robot(from.robot), answer);
        }
    }

    /// Delivers the decided entries.
    pub(super) fn apply(&mut self, robot: &mut Robot<'_>) {
        let me = self.life(robot);
        let mut is_own = false;
        while let Some(member) = &mut self.member
            && member.applied < member.commit
            && let Some(entry) = member.log.get(member.applied + 1)
        {
            member.applied += 1;
            let is_let_in = matches!(&entry.what, What::Voters(voters) if voters.contains(&me))
                && member.roll.last(me).is_none();
            member.roll.advance(&entry.what);
            if is_let_in {
                robot.report(self.port, BroadcastEvent::Voter);
            }
            let What::Message {
                from,
                number,
                content,
            } = &entry.what
            else {
                continue;
            };
            let Some((sender, _)) = member.roll.of(*from) else {
                continue; // only a fault makes such an entry
            };
            let (number, content) = (*number, content.clone());
            is_own |= sender == me;
            let position = Some((member.generation, member.applied));
            if self.position < position {
                self.position = position;
                self.hand_out(robot, sender, number, content);
            }
        }
        if is_own {
            self.settle_proposed(robot);
            self.propose(robot);
        }
    }

    fn hand_out(&mut self, robot: &mut Robot<'_>, sender: Life, number: u32, content: Payload) {
        let from = sender.robot;
        let message = MessageNumber {
            number,
            incarnation: sender.incarnation(),
        };
        let deliver = TransferEvent::Deliver { from, message };
        robot.report(self.port, BroadcastEvent::from(deliver));
        robot.deliver(from, self.port, content);
    }

    /// Records that others may have delivered messages that this robot will not deliver.
    pub(super) fn miss(&mut self, robot: &mut Robot<'_>) {
        robot.report(self.port, BroadcastEvent::Gap);
        self.gaps.push(Gap { from: None });
    }
}

impl Member {
    pub(super) fn is_leading(&self) -> bool {
        matches!(self.role, Role::Leading(_))
    }

    /// The log is that of its term's leader up to here.
    pub(super) fn through(&self) -> u64 {
        self.agreed.max(self.commit)
    }

    /// Its report to the leader.
    pub(super) fn taken(&self, lacks: Vec<(u64, u64)>) -> Body {
        Body::Taken {
            term: self.term,
            round: self.round,
            through: self.through(),
            lacks,
            applied: self.applied,
            call: self.call,
        }
    }

    /// Takes part of its leader's log, and what has waited for that.
    fn take(&mut self, part: Part) -> Result<(), ()> {
        let is_known = part.previous <= self.through().min(self.log.last());
        match is_known || self.log.term(part.previous) == Some(part.previous_term) {
            true => self.append(part)?,
            false => self.early.hold(part),
        }
        while let Some(part) = self.early.take(self.through().min(self.log.last())) {
            self.append(part)?;
        }
        Ok(())
    }

    /// Takes entries, of which the one before is the leader's.
    fn append(&mut self, part: Part) -> Result<(), ()> {
        let mut index = part.previous;
        for entry in part.entries {
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
        self.agreed = self.agreed.max(index);
        Ok(())
    }
}

impl Entry {
    /// About how long it is in a datagram, bytes.
    pub fn size(&self) -> usize {
        match &self.what {
            What::Start => 4,
            What::Voters(voters) => 4 + 14 * voters.len(),
            What::Message { content, .. } => 10 + content.len(),
        }
    }

    /// Its approximate size in memory, bytes.
    pub fn room(&self) -> usize {
        64 + self.size()
    }
}

#[cfg(test)]
mod tests {
    use super::super::packet::{Generation, Question};
    use super::super::snapshots::Place;
    use super::*;
    use crate::alone::alone;
    use crate::reliable::Options;
    use starl_core::{Effect, Event, Port, RobotId};

    /// The only life of a robot.
    fn life(robot: u32) -> Life {
        Life::of_test(RobotId(robot), 1)
    }

    /// The messages of robot 1 with numbers up to this one, as its log begins.
    fn messages(last: u32) -> Part {
        let message = |number| Entry {
            term: 1,
            what: What::Message {
                from: RobotId(1),
                number,
                content: Payload::new(),
            },
        };
        Part {
            previous: 0,
            previous_term: 0,
            entries: (1..=last).map(message).collect(),
        }
    }

    /// The continuation that robot 1 sends as the leader, in this round.
    fn continuation(round: u64, part: Part) -> Continuation {
        Continuation {
            term: 1,
            round,
            commit: part.entries.len() as u64,
            part,
            floor: 0,
            is_beat: true,
        }
    }

    fn generation() -> Generation {
        Generation {
            counter: 1,
            founder: life(1),
        }
    }

    /// Robot 0 in a group of three.
    fn member(robot: &mut Robot<'_>) -> Total {
        let mut total = Total::new(Port::named("news"), Options::default());
        let voters = Vec::from([total.life(robot), life(1), life(2)]);
        total.founded(robot, generation(), 2, voters);
        total
    }

    /// How many messages a robot delivers.
    fn delivered(effects: &[Effect]) -> usize {
        let is_delivery = |effect: &&Effect| match effect {
            Effect::Record(Event::Primitive { event, .. }) => event.name() == "deliver",
            _ => false,
        };
        effects.iter().filter(is_delivery).count()
    }

    #[test]
    fn a_late_datagram_of_the_leader_is_no_sign_that_it_lives() {
        alone(|robot| {
            let mut total = member(robot);
            total.append(robot, life(1), continuation(7, messages(2)));
            total.member.as_mut().expect("a group").silence = 5;
            let silence = |total: &Total| total.member.as_ref().map(|member| member.silence);
            total.append(robot, life(1), continuation(7, messages(2)));
            total.append(robot, life(1), continuation(6, messages(1)));
            assert_eq!(silence(&total), Some(5));
            total.append(robot, life(1), continuation(8, messages(3)));
            assert_eq!(silence(&total), Some(0));
        });
    }

    #[test]
    fn a_late_datagram_of_the_leader_is_no_sign_that_it_lives_after_a_refused_vote() {
        alone(|robot| {
            let mut total = member(robot);
            total.append(robot, life(1), continuation(7, messages(2)));
            total.ask(robot, true);
            let question = Question {
                asker: total.life(robot).name,
                number: total.ask_number,
            };
            // Robot 2 has heard the leader a moment ago.
            total.answered(robot, life(2), question, (1, false));
            total.append(robot, life(1), continuation(6, messages(1)));
            let leader = |total: &Total| total.member.as_ref().and_then(|member| member.leader);
            assert_eq!(leader(&total), None);
            total.append(robot, life(1), continuation(8, messages(3)));
            assert_eq!(leader(&total), Some(life(1)));
        });
    }

    #[test]
    fn a_leader_of_the_term_that_a_corruption_left_is_heard_from_its_first_round() {
        alone(|robot| {
            let mut total = member(robot);
            total.append(robot, life(1), continuation(500, messages(2)));
            total.member.as_mut().expect("a group").term = 2;
            let next = Continuation {
                term: 2,
                ..continuation(1, messages(2))
            };
            total.append(robot, life(2), next);
            let leader = total.member.as_ref().and_then(|member| member.leader);
            assert_eq!(leader, Some(life(2)));
        });
    }

    #[test]
    fn a_robot_that_returns_to_its_group_delivers_nothing_twice() {
        let effects = alone(|robot| {
            let mut total = member(robot);
            total.append(robot, life(1), continuation(1, messages(3)));
            // After a fault it returns as another life, to a leader that has delivered less so far.
            total.leave(robot, LeaveReason::Corrupt);
            let me = total.life(robot);
            let place = Place {
                to: me.name,
                call: 1,
                quorum: 2,
                term: 2,
                index: 1,
                index_term: 1,
                base: 0,
                roll: Vec::from([(me, 0), (life(1), 1), (life(2), 0)]),
            };
            total.go_on(robot, life(2), generation(), place);
            let mut part = messages(4);
            part.entries.remove(0);
            (part.previous, part.previous_term) = (1, 1);
            let next = Continuation {
                term: 2,
                commit: 4,
                ..continuation(1, part)
            };
            total.append(robot, life(2), next);
            assert_eq!(total.member.as_ref().map(|member| member.applied), Some(4));
        });
        assert_eq!(delivered(&effects), 4);
    }
}
