//! The messages of a stream that are on their way, and what each receiver has taken of them.
//!
//! Invariant: the first message that is kept waits for some receiver, if there is any. A receiver that never spoke
//! has no entry, and nothing is known to be taken by it.

use super::peers::{Peers, Rest};
use super::runs::Runs;
use alloc::boxed::Box;
use alloc::collections::{BTreeMap, VecDeque};
use alloc::vec::Vec;
use core::ops::Range;
use starl_core::{Payload, RobotId, Time};

/// A stream, from its sender's side.
#[derive(Clone, Debug)]
pub(super) struct Outgoing {
    /// The number of the first message that is kept.
    base: u32,
    messages: VecDeque<Message>,
    /// The receivers that have answered.
    pub receivers: Peers<Receiver>,
    /// The retransmissions to those that have not.
    pub strangers: Trying,
}

/// A message on its way.
#[derive(Clone, Debug)]
pub(super) struct Message {
    pub content: Box<[u8]>,
    pub sent: Time,
    /// How many receivers have not taken it.
    waiting: u32,
    /// The last robot that it is for: robots with greater numbers joined after it was sent.
    last: RobotId,
}

impl Message {
    /// Whether the robot belonged to the fleet when the message was sent.
    pub fn is_for(&self, robot: RobotId) -> bool {
        robot <= self.last
    }
}

/// The state of one receiver.
#[derive(Clone, Debug)]
pub(super) struct Receiver {
    /// The messages that it has taken.
    pub taken: Runs,
    /// The messages that it holds for an earlier one, by its last report. It may have forgotten
    /// them since.
    pub held: Runs,
    /// The token that it asks for; none once it has acknowledged messages.
    pub token: Option<u32>,
    /// When messages that it has not taken were last sent to it again.
    pub resent: BTreeMap<u32, Time>,
    pub trying: Trying,
}

/// The retransmissions to silent receivers.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Trying {
    /// The number of failed attempts.
    pub attempt: u32,
    /// When it is done next; none where that is a time-out after the first message that is missing.
    pub due: Option<Time>,
}

impl Default for Outgoing {
    fn default() -> Outgoing {
        Outgoing {
            base: 1,
            messages: VecDeque::new(),
            receivers: Peers::default(),
            strangers: Trying::default(),
        }
    }
}

impl Default for Receiver {
    fn default() -> Receiver {
        Receiver {
            taken: Runs::before(1),
            held: Runs::before(1),
            token: None,
            resent: BTreeMap::new(),
            trying: Trying::default(),
        }
    }
}

impl Rest for Receiver {
    /// The number of the next message.
    type Resting = u32;

    fn at_rest(&self) -> Option<u32> {
        let holds_none = self.held.next() == 1 && self.held.ahead().is_empty();
        let is_tried =
            self.trying.attempt > 0 || self.trying.due.is_some() || !self.resent.is_empty();
        let is_at_rest =
            holds_none && !is_tried && self.token.is_none() && self.taken.ahead().is_empty();
        is_at_rest.then(|| self.taken.next())
    }

    fn woken(next: u32) -> Receiver {
        Receiver {
            taken: Runs::before(next),
            ..Receiver::default()
        }
    }
}

impl Receiver {
    /// Whether it has the message, be it that it holds it.
    pub fn has(&self, number: u32) -> bool {
        self.taken.contains(number) || self.held.contains(number)
    }
}

/// The effect of a receiver's report.
#[derive(Debug, Default)]
pub(super) struct Credit {
    /// Messages that now all have taken.
    pub settled: Vec<u32>,
    /// The time at which the latest message was sent that the receiver is known to have.
    pub newest: Option<Time>,
}

impl Outgoing {
    /// The number of the first message that is still tried.
    pub fn base(&self) -> u32 {
        self.base
    }

    /// The number of the next message.
    pub fn next(&self) -> u32 {
        self.base.saturating_add(self.messages.len() as u32)
    }

    /// How many messages are kept.
    pub fn len(&self) -> usize {
        self.messages.len()
    }

    /// How many some receiver has not taken.
    pub fn outstanding(&self) -> usize {
        self.messages
            .iter()
            .filter(|message| message.waiting > 0)
            .count()
    }

    pub fn get(&self, number: u32) -> Option<&Message> {
        self.messages.get(number.checked_sub(self.base)? as usize)
    }

    /// Whether some receiver has not taken it and is still tried.
    pub fn is_outstanding(&self, number: u32) -> bool {
        self.get(number).is_some_and(|message| message.waiting > 0)
    }

    /// Adds a message for this number of receivers, of which `last` has the greatest number; returns its number.
    pub fn push(&mut self, content: Payload, sent: Time, waiting: u32, last: RobotId) -> u32 {
        let number = self.next();
        self.messages.push_back(Message {
            content: content.into_boxed_slice(),
            sent,
            waiting,
            last,
        });
        self.drop_settled();
        number
    }

    /// The first message, which waits for someone.
    pub fn first(&self) -> Option<(u32, &Message)> {
        Some((self.base, self.messages.front()?))
    }

    /// Gives the first message up. True if it was on its way to someone.
    pub fn pop(&mut self) -> bool {
        let Some(message) = self.messages.pop_front() else {
            return false;
        };
        self.base += 1;
        self.drop_settled();
        message.waiting > 0
    }

    /// The messages that a receiver lacks, of those that it has room for.
    pub fn missing<'a>(
        &'a self,
        receiver: &'a Receiver,
        window: u32,
    ) -> impl Iterator<Item = u32> + 'a {
        let room = receiver.taken.next().max(self.base);
        let end = self.next().min(room.saturating_add(window.max(1)));
        let waits = |number: &u32| !receiver.has(*number) && self.is_outstanding(*number);
        (room..end).filter(waits)
    }

    /// The first message that a receiver has not taken, though it may hold it.
    pub fn first_pending(&self, receiver: &Receiver) -> Option<u32> {
        let first = receiver.taken.next().max(self.base);
        (first..self.next()).find(|&n| !receiver.taken.contains(n) && self.is_outstanding(n))
    }

    /// When a message was last sent to a receiver.
    pub fn last_sent(&self, receiver: &Receiver, number: u32) -> Option<Time> {
        let again = receiver.resent.get(&number).copied();
        again.or_else(|| Some(self.get(number)?.sent))
    }

    /// A receiver says that it has taken all before a number and `ahead` besides; `are_taken` is false where
    /// it only holds those.
    pub fn credit(
        &mut self,
        from: RobotId,
        before: u32,
        ahead: &[Range<u32>],
        are_taken: bool,
    ) -> Credit {
        let mut credit = Credit::default();
        let mut receiver = self.receivers.take(from).unwrap_or_default();
        let next = self.next();
        let (mut taken, mut held) = (Vec::new(), Runs::before(1));
        let first = receiver.taken.next().max(self.base);
        taken.extend((first..before.min(next)).filter(|n| !receiver.taken.contains(*n)));
        let sent = |run: &Range<u32>| run.start.max(first)..run.end.min(next);
        for number in ahead.iter().flat_map(sent) {
            if receiver.taken.contains(number) {
                continue;
            }
            match are_taken {
                true => taken.push(number),
                false => held.insert(number),
            }
            if !receiver.has(number) {
                credit.newest = credit.newest.max(self.last_sent(&receiver, number));
            }
        }
        for &number in &taken {
            credit.newest = credit.newest.max(self.last_sent(&receiver, number));
            receiver.taken.insert(number);
            receiver.resent.remove(&number);
            let place = (number - self.base) as usize;
            if let Some(message) = self.messages.get_mut(place)
                && message.is_for(from)
            {
                message.waiting = message.waiting.saturating_sub(1);
                if message.waiting == 0 {
                    credit.settled.push(number);
                }
            }
        }
        receiver.taken.fill_to(before.min(next).max(self.base));
        receiver.held = held;
        receiver.token = None;
        self.receivers.put(from, receiver);
        self.drop_settled();
        credit
    }

    fn drop_settled(&mut self) {
        while self.messages.front().is_some_and(|m| m.waiting == 0) {
            self.messages.pop_front();
            self.base += 1;
        }
        if self.messages.is_empty() {
            self.strangers = Trying::default();
            self.receivers.change_busy(|receiver| {
                receiver.trying = Trying::default();
                receiver.resent.clear();
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_robot_that_joins_takes_no_message_in_place_of_another() {
        let mut outgoing = Outgoing::default();
        let early = outgoing.push(Payload::default(), Time::ZERO, 2, RobotId(2));
        outgoing.credit(RobotId(1), early + 1, &[], true);
        // Robot 3 joined after the message was sent, and receives it before robot 2 does.
        let credit = outgoing.credit(RobotId(3), early + 1, &[], true);
        assert!(credit.settled.is_empty());
        assert!(outgoing.is_outstanding(early));
        let later = outgoing.push(Payload::default(), Time::ZERO, 3, RobotId(3));
        outgoing.credit(RobotId(1), later + 1, &[], true);
        outgoing.credit(RobotId(3), later + 1, &[], true);
        let credit = outgoing.credit(RobotId(2), later + 1, &[], true);
        assert_eq!(credit.settled, [early, later]);
        assert_eq!(outgoing.len(), 0);
    }
}
