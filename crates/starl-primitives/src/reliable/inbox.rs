//! A receiver's state of one stream of one sender: the current incarnation, and the messages taken of it.
//!
//! Lives are distinguished by a [`Handshake`].
//!
//! Invariant: each message of an incarnation is delivered at most once, and memory is bounded by the window: messages
//! further ahead are not accepted, so that their sender sends them again.

use super::Options;
use super::outgoing::Trying;
use super::peers::Rest;
use super::runs::Runs;
use crate::handshake::Handshake;
use alloc::collections::BTreeMap;
use smallvec::SmallVec;
use starl_core::{Payload, Time};

/// Messages to deliver, by number.
pub(super) type Arrived = SmallVec<[(u32, Payload); 1]>;

/// The state of one stream.
#[derive(Clone, Debug, Default)]
pub(super) struct Inbox {
    /// The accepted incarnation, and its accepted messages.
    pub lives: Handshake<Sequence>,
    /// The pending message to the sender.
    pub owed: Owed,
    /// When a sender that is not known is asked again which life it has.
    pub asking: Trying,
}

/// A receiver's pending message to a sender.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Owed {
    #[default]
    Nothing,
    /// An acknowledgement.
    Taken,
    /// Its token.
    Greeting,
}

impl Inbox {
    /// An incarnation answers a token: from now on it is heard, from the message `base` on. False if the
    /// token is not the present one.
    pub fn begin(&mut self, incarnation: u32, token: u32, base: u32) -> bool {
        let is_answer = self
            .lives
            .begin(incarnation, token, || Sequence::from(base));
        if is_answer {
            self.asking = Trying::default();
        }
        is_answer
    }

    /// Prepares the question that follows this one, if its answer does not come: the sender may not repeat a message
    /// before its time is over. Each asker has a token of its own, and so a time of its own.
    pub fn ask_again(&mut self, now: Time, token: u32, options: &Options) {
        let attempt = self.asking.attempt;
        self.asking.due = (attempt < options.retries).then(|| {
            let share = f64::from(token) / f64::from(u32::MAX);
            now + options.stretched(attempt, share)
        });
        self.asking.attempt = attempt.saturating_add(1);
    }

    /// When the sender has to be answered or asked; `last` is when it last was.
    pub fn due(&self, last: Option<Time>, now: Time, options: &Options) -> Option<Time> {
        match self.owed {
            Owed::Nothing => self.asking.due,
            Owed::Taken | Owed::Greeting => Some(options.answer_time(last, now)),
        }
    }
}

impl Rest for Inbox {
    /// The incarnation that is heard, and the number of its next message.
    type Resting = (u32, u32);

    fn at_rest(&self) -> Option<(u32, u32)> {
        let (incarnation, sequence) = self.lives.heard.as_ref()?;
        let owes_nothing = self.owed == Owed::Nothing && self.lives.asked().is_none();
        let has_no_gap = sequence.held.is_empty() && sequence.taken.ahead().is_empty();
        (owes_nothing && has_no_gap).then(|| (*incarnation, sequence.taken.next()))
    }

    fn woken((incarnation, next): (u32, u32)) -> Inbox {
        Inbox {
            lives: Handshake::hearing(incarnation, Sequence::from(next)),
            owed: Owed::Nothing,
            asking: Trying::default(),
        }
    }
}

/// Which messages of an incarnation have been taken.
#[derive(Clone, Debug)]
pub(super) struct Sequence {
    /// Those that were delivered or will never come.
    taken: Runs,
    /// Messages that wait for an earlier one.
    held: BTreeMap<u32, Payload>,
}

impl Sequence {
    /// Nothing before `base` will come.
    fn from(base: u32) -> Sequence {
        Sequence {
            taken: Runs::before(base),
            held: BTreeMap::new(),
        }
    }

    /// Accepts a message in the order of arrival.
    pub fn take(&mut self, number: u32, content: Payload, window: u32, arrived: &mut Arrived) {
        if self.has_room(number, window) && !self.taken.contains(number) {
            self.taken.insert(number);
            arrived.push((number, content));
        }
    }

    /// Accepts a message in its sender's order: it is held until all before it have arrived.
    pub fn hold(&mut self, number: u32, content: Payload, window: u32, arrived: &mut Arrived) {
        if self.has_room(number, window) && !self.taken.contains(number) {
            self.held.insert(number, content);
            self.release(arrived);
        }
    }

    /// Whether all before `next` were taken.
    pub fn has_all(&self, next: u32) -> bool {
        self.taken.next() >= next
    }

    fn has_room(&self, number: u32, window: u32) -> bool {
        number - self.taken.next().min(number) < window.max(1)
    }

    /// No message before `base` will arrive: releases the messages that waited for them.
    pub fn settle(&mut self, base: u32, arrived: &mut Arrived) {
        if base <= self.taken.next() {
            return;
        }
        let after = self.held.split_off(&base);
        arrived.extend(core::mem::replace(&mut self.held, after));
        self.taken.fill_to(base);
        self.release(arrived);
    }

    /// Delivers the messages that wait for no other.
    fn release(&mut self, arrived: &mut Arrived) {
        while let Some(first) = self.held.first_entry()
            && *first.key() == self.taken.next()
        {
            let (number, content) = first.remove_entry();
            arrived.push((number, content));
            self.taken.fill_to(number.saturating_add(1));
        }
    }

    /// The report to a sender: all messages before this number have been taken, and runs of later ones,
    /// by how many are missing before each and how many it has.
    pub fn report(&self, most_runs: usize) -> (u32, alloc::vec::Vec<(u32, u32)>) {
        let mut held = Runs::before(0);
        self.held.keys().for_each(|&number| held.insert(number));
        let runs = self.taken.ahead().iter().chain(held.ahead());
        let mut end = self.taken.next();
        let ahead = runs.take(most_runs).map(|run| {
            let skipped = run.start - end;
            end = run.end;
            (skipped, run.end - run.start)
        });
        (self.taken.next(), ahead.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether the first message of an incarnation is delivered.
    fn takes_first(sequence: Option<Sequence>, incarnation: u32) -> bool {
        // It answers the present token, if it is not heard already.
        let mut lives = Handshake::asking(3);
        lives.heard = sequence.map(|sequence| (7, sequence));
        let mut inbox = Inbox {
            lives,
            ..Inbox::default()
        };
        assert!(inbox.begin(incarnation, 3, 1));
        let mut arrived = Arrived::new();
        let sequence = inbox.lives.of(incarnation).expect("it is heard");
        sequence.hold(1, Payload::new(), 8, &mut arrived);
        !arrived.is_empty()
    }

    #[test]
    fn a_restart_of_either_side_undoes_that_messages_are_believed_to_be_taken() {
        // As a fault may have it.
        let wrong = Sequence::from(1_000_000);
        assert!(!takes_first(Some(wrong.clone()), 7));
        assert!(takes_first(Some(wrong), 8), "the sender has restarted");
        assert!(takes_first(None, 7), "the receiver has restarted");
    }
}
