//! A robot's own messages on their way into the log.
//!
//! Invariant: a message is proposed in one group only. It is settled when it has its place, and fails when
//! the group is given up or it has waited too long; then it may have a place all the same.

use super::packet::{Body, Generation};
use super::{CHUNK, Total};
use crate::Failure;
use crate::reliable::MessageId;
use alloc::vec::Vec;
use starl_core::event::messaging::MessageNumber;
use starl_core::event::{BroadcastEvent, TransferEvent};
use starl_core::{Destination, Payload, Robot};

/// Failures that nobody asks for are kept up to this number, the latest.
const MOST_FAILURES: usize = 64;

/// A message on its way.
#[derive(Clone, Debug)]
pub(super) struct Proposal {
    pub number: u32,
    pub content: Payload,
    /// The group in which it was proposed.
    pub bound: Option<Generation>,
    /// Ticks since it was sent.
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
        if self.in_flight.is_none() {
            self.propose(robot);
        }
        message
    }

    /// Sends the leader the oldest messages. The oldest comes first in each datagram, so that what the
    /// leader has not seen before it will not come.
    pub(super) fn propose(&mut self, robot: &mut Robot<'_>) {
        self.in_flight = None;
        let incarnation = self.incarnation.of(robot);
        let Some(member) = &self.member else { return };
        let Some(leader) = member.leader else { return };
        let generation = member.generation;
        let is_leader = leader.robot == robot.id();
        let (mut messages, mut size) = (Vec::new(), 0);
        for proposal in &mut self.proposals {
            if size >= CHUNK && !is_leader {
                break;
            }
            size += 8 + proposal.content.len();
            proposal.bound = Some(generation);
            self.in_flight = Some(proposal.number);
            messages.push((proposal.number, proposal.content.clone()));
        }
        if messages.is_empty() {
            return;
        }
        if is_leader {
            return self.put_messages(robot, (leader.robot, incarnation), messages);
        }
        let body = Body::Propose {
            incarnation,
            messages,
        };
        self.say(robot, Destination::Robot(leader.robot), body);
    }

    /// Takes off what has its place.
    pub(super) fn settle_proposed(&mut self, robot: &mut Robot<'_>) {
        let incarnation = self.incarnation.of(robot);
        let Some(member) = &self.member else { return };
        let generation = member.generation;
        let Some(&last) = member.senders.get(&(robot.id(), incarnation)) else {
            return;
        };
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
        let oldest = self.proposals.front();
        if oldest.is_some_and(|oldest| oldest.age % 2 == 0 || self.in_flight.is_none()) {
            self.propose(robot);
        }
    }

    /// What was proposed in a group that is given up may have a place there.
    pub(super) fn fail_bound(&mut self, robot: &mut Robot<'_>, generation: Generation) {
        self.in_flight = None;
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
