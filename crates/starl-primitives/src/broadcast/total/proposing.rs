//! A robot's own messages on their way into the log.
//!
//! Invariant: a message is proposed in one group only. It is settled when it has its place, and fails when
//! the group is given up or it has waited too long; even then it may have a place.

use super::packet::{Body, Generation, What};
use super::{CHUNK, Total, WINDOW};
use crate::Failure;
use crate::reliable::MessageId;
use alloc::vec::Vec;
use starl_core::event::messaging::{LeaveReason, MessageNumber};
use starl_core::event::{BroadcastEvent, TransferEvent};
use starl_core::{Destination, Payload, Robot};

/// The latest failures are kept up to this number.
const MOST_FAILURES: usize = 64;

/// About how much longer a message is among others in a datagram than its content, bytes.
const PROPOSAL: usize = 6;

/// After so many ticks without progress messages are proposed again; after twice as many each further time,
/// up to the last.
const FIRST_RETRY: u32 = 2;
const LAST_RETRY: u32 = 4;

/// A message that was proposed is missing in so many datagrams of new entries only if it was lost.
const LOST_AFTER: u32 = 3;

/// A message on its way.
#[derive(Clone, Debug)]
pub(super) struct Proposal {
    pub number: u32,
    pub content: Payload,
    /// The group in which it was proposed.
    pub bound: Option<Generation>,
    /// Ticks since it was broadcast.
    pub age: u32,
}

impl Total {
    /// Broadcasts; gives the message's name.
    pub fn broadcast(&mut self, robot: &mut Robot<'_>, content: Payload) -> MessageId {
        let message = self.next(robot);
        self.last = message.number;
        if self.proposals.len() >= self.options.most_outstanding.max(1) as usize {
            self.fail_where(robot, &mut |_, is_first| is_first);
        }
        self.proposals.push_back(Proposal {
            number: message.number,
            content,
            bound: None,
            age: 0,
        });
        self.arm(robot);
        self.propose(robot);
        message
    }

    /// Proposes everything again, to a leader that may have seen nothing of it.
    pub(super) fn propose_anew(&mut self, robot: &mut Robot<'_>) {
        (self.sent, self.waited, self.retry) = (0, 0, FIRST_RETRY);
        self.propose(robot);
    }

    /// More entries have come from the leader. If the oldest message is not among them for long, its
    /// datagram was lost.
    pub(super) fn watch_proposed(&mut self, robot: &mut Robot<'_>) {
        let me = robot.id();
        let oldest = self.proposals.front().map(|oldest| oldest.number);
        let (Some(oldest), Some(member)) = (oldest.filter(|n| *n <= self.sent), &self.member)
        else {
            return;
        };
        let (first, last) = (member.applied + 1, member.log.last());
        let mut entries = (first..=last).filter_map(|index| member.log.get(index));
        let has_place = entries.any(|entry| match &entry.what {
            What::Message { from, number, .. } => *from == me && *number >= oldest,
            _ => false,
        });
        self.passed = if has_place { 0 } else { self.passed + 1 };
        if self.passed >= LOST_AFTER {
            self.propose_anew(robot);
        }
    }

    /// Proposes what the leader was not sent yet: a datagram if none is on its way, and besides all that fill
    /// one, as far as the window goes.
    pub(super) fn propose(&mut self, robot: &mut Robot<'_>) {
        let Some(oldest) = self.proposals.front().map(|proposal| proposal.number) else {
            return;
        };
        let life = self.life(robot);
        let Some(member) = &self.member else { return };
        let Some(leader) = member.leader else { return };
        if !member.log.voters().contains(&life) {
            return; // it will be one soon
        }
        let generation = member.generation;
        if leader == life {
            let messages = self.take_unsent(generation, usize::MAX);
            return self.put_messages(robot, life, oldest, messages);
        }
        let is_sent = |proposal: &&Proposal| proposal.number <= self.sent;
        let size = |proposal: &Proposal| PROPOSAL + proposal.content.len();
        let mut way: usize = self.proposals.iter().take_while(is_sent).map(size).sum();
        let mut unsent: usize = self.proposals.iter().skip_while(is_sent).map(size).sum();
        if way == 0 {
            (self.waited, self.passed) = (0, 0);
        }
        while unsent > 0 && (way == 0 || unsent >= CHUNK && way < WINDOW) {
            let messages = self.take_unsent(generation, CHUNK);
            let taken = messages.iter().map(|(_, content)| PROPOSAL + content.len());
            let taken: usize = taken.sum();
            way += taken;
            unsent -= taken;
            let body = Body::Propose { oldest, messages };
            self.say(robot, Destination::Robot(leader.robot), body);
        }
    }

    /// The next messages that were not sent to the leader, up to about this size.
    fn take_unsent(&mut self, generation: Generation, most: usize) -> Vec<(u32, Payload)> {
        let (mut messages, mut size) = (Vec::new(), 0);
        let sent = self.sent;
        let unsent = self.proposals.iter_mut();
        for proposal in unsent.skip_while(|proposal| proposal.number <= sent) {
            if size >= most {
                break;
            }
            size += PROPOSAL + proposal.content.len();
            proposal.bound = Some(generation);
            self.sent = proposal.number;
            messages.push((proposal.number, proposal.content.clone()));
        }
        messages
    }

    /// Takes off what has its place.
    pub(super) fn settle_proposed(&mut self, robot: &mut Robot<'_>) {
        let life = self.life(robot);
        let incarnation = life.incarnation();
        let Some(member) = &self.member else { return };
        let generation = member.generation;
        let Some(last) = member.roll.last(life) else {
            return;
        };
        if last > self.last {
            // It has sent no such message: the group goes by what a fault has made up.
            return self.leave(robot, LeaveReason::Corrupt);
        }
        (self.waited, self.retry) = (0, FIRST_RETRY);
        while let Some(first) = self.proposals.front()
            && first.number <= last
            && first.bound == Some(generation)
        {
            let number = first.number;
            self.proposals.pop_front();
            let acknowledged = TransferEvent::Acknowledged {
                message: MessageNumber {
                    number,
                    incarnation,
                },
                to: None,
            };
            robot.report(self.port, BroadcastEvent::from(acknowledged));
        }
    }

    /// A tick of those on their way: they are proposed again, and fail in the end.
    pub(super) fn propose_again(&mut self, robot: &mut Robot<'_>) {
        let span = self.options.failure_bound().seconds();
        let longest = (span / self.tick().seconds()) as u32;
        for proposal in &mut self.proposals {
            proposal.age = proposal.age.saturating_add(1);
        }
        self.fail_where(robot, &mut |proposal, _| proposal.age > longest);
        self.waited = self.waited.saturating_add(1);
        if self.waited >= self.retry && !self.proposals.is_empty() {
            let retry = self.retry.saturating_mul(2).clamp(FIRST_RETRY, LAST_RETRY);
            self.propose_anew(robot);
            self.retry = retry;
        }
    }

    /// Messages proposed in a group that is given up may have a place there.
    pub(super) fn fail_bound(&mut self, robot: &mut Robot<'_>, generation: Generation) {
        self.sent = 0;
        self.fail_where(robot, &mut |proposal, _| proposal.bound == Some(generation));
    }

    fn fail_where(
        &mut self,
        robot: &mut Robot<'_>,
        fails: &mut dyn FnMut(&Proposal, bool) -> bool,
    ) {
        let incarnation = self.incarnation.of(robot);
        let mut failed = Vec::new();
        let mut is_first = true;
        self.proposals.retain(|proposal| {
            let fails = fails(proposal, is_first);
            is_first = false;
            if fails {
                failed.push(proposal.number);
            }
            !fails
        });
        for number in failed {
            let fail = TransferEvent::Fail {
                message: MessageNumber {
                    number,
                    incarnation,
                },
                to: Vec::new(),
            };
            robot.report(self.port, BroadcastEvent::from(fail));
            if self.failures.len() == MOST_FAILURES {
                self.failures.pop_front();
            }
            self.failures.push_back(Failure {
                message: MessageId {
                    incarnation,
                    to: None,
                    number,
                },
                unreached: Vec::new(),
            });
        }
    }
}
