//! The messages of this robot that some receiver has not acknowledged.
//!
//! Invariant: every message here has a receiver pending and a timer armed under its ticket. Tickets
//! rise, so within a stream their order is that of the numbers.

use super::{MessageId, Notice};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::{Payload, RobotId};

/// A message on its way.
#[derive(Clone, Debug)]
pub(super) struct Outgoing {
    pub message: MessageId,
    pub content: Payload,
    /// Who has not acknowledged it, in the order of their numbers.
    pub pending: Vec<RobotId>,
    /// How often it was repeated.
    pub attempt: u32,
    /// Whether an earlier message was still on its way to one of its receivers when it was last sent,
    /// so that in FIFO order the receiver may be holding it back.
    pub sent_behind: bool,
    /// How far it is.
    pub stage: Stage,
}

impl Outgoing {
    /// What the owner learns when it is sent again.
    pub fn repeated(&self) -> Notice {
        Notice::Repeated {
            message: self.message,
            to: self.pending.clone(),
        }
    }
}

/// How far a message is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stage {
    /// It is repeated until the retries are used up.
    Trying,
    /// They are used up, but an earlier message is still tried that may hold it back at a receiver.
    Waiting,
    /// It was sent a last time after that.
    LastTry,
}

/// All messages on their way, by ticket.
#[derive(Clone, Debug, Default)]
pub(super) struct Outbox {
    messages: BTreeMap<u32, Outgoing>,
    tickets: BTreeMap<MessageId, u32>,
    last_ticket: u32,
}

impl Outbox {
    pub fn len(&self) -> usize {
        self.messages.len()
    }

    pub fn contains(&self, message: MessageId) -> bool {
        self.tickets.contains_key(&message)
    }

    pub fn get(&self, ticket: u32) -> Option<&Outgoing> {
        self.messages.get(&ticket)
    }

    pub fn get_mut(&mut self, ticket: u32) -> Option<&mut Outgoing> {
        self.messages.get_mut(&ticket)
    }

    pub fn insert(&mut self, outgoing: Outgoing) -> u32 {
        self.last_ticket = self.last_ticket.wrapping_add(1);
        self.tickets.insert(outgoing.message, self.last_ticket);
        self.messages.insert(self.last_ticket, outgoing);
        self.last_ticket
    }

    pub fn remove(&mut self, ticket: u32) -> Option<Outgoing> {
        let outgoing = self.messages.remove(&ticket)?;
        self.tickets.remove(&outgoing.message);
        Some(outgoing)
    }

    pub fn pop_oldest(&mut self) -> Option<(u32, Outgoing)> {
        let ticket = *self.messages.first_key_value()?.0;
        self.remove(ticket).map(|outgoing| (ticket, outgoing))
    }

    /// Takes `by` off the receivers of a message; if it was the last, removes the message and returns
    /// its ticket.
    pub fn acknowledge(&mut self, message: MessageId, by: RobotId) -> Option<u32> {
        let ticket = *self.tickets.get(&message)?;
        let pending = &mut self.messages.get_mut(&ticket)?.pending;
        pending.remove(pending.binary_search(&by).ok()?);
        if !pending.is_empty() {
            return None;
        }
        self.remove(ticket);
        Some(ticket)
    }

    /// The number of the oldest message to all that is on its way to anyone; 1 if there is none.
    pub fn oldest_to_all(&self) -> u32 {
        self.oldest(|outgoing| outgoing.message.to.is_none())
    }

    /// The number of the oldest message on its way to `peer` among those addressed to `to`, which is
    /// `peer` or, for messages to all, nobody; 1 if there is none.
    pub fn oldest_to(&self, peer: RobotId, to: Option<RobotId>) -> u32 {
        self.oldest(|outgoing| {
            outgoing.message.to == to && outgoing.pending.binary_search(&peer).is_ok()
        })
    }

    /// The number of the oldest message to all that is on its way to `peer`.
    pub fn oldest_outstanding(&self, peer: RobotId) -> Option<u32> {
        let waits = |outgoing: &&Outgoing| {
            outgoing.message.to.is_none() && outgoing.pending.binary_search(&peer).is_ok()
        };
        let oldest = self.messages.values().find(waits)?;
        Some(oldest.message.number)
    }

    /// Whether an earlier message of the same stream is still tried for one of the same receivers.
    pub fn is_behind(&self, ticket: u32) -> bool {
        let Some(outgoing) = self.messages.get(&ticket) else {
            return false;
        };
        let mut earlier = self.messages.range(..ticket);
        earlier.any(|(_, other)| {
            other.stage == Stage::Trying
                && other.message.to == outgoing.message.to
                && other
                    .pending
                    .iter()
                    .any(|peer| outgoing.pending.binary_search(peer).is_ok())
        })
    }

    fn oldest(&self, of: impl Fn(&Outgoing) -> bool) -> u32 {
        self.messages
            .values()
            .find(|outgoing| of(outgoing))
            .map_or(1, |o| o.message.number)
    }
}
