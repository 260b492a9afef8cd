//! What a receiver remembers of one sender, to take each message once and in order if so wished.
//!
//! Invariant: a message is handed out at most once, and the memory is bounded whatever arrives: a
//! message that would need more is not taken, so that its sender tries it again. Nothing is forgotten
//! that could make a duplicate look new, unless its sender has restarted [`LIVES`] times since.
//!
//! Incarnations have no order: a clock that starts over with the robot would make one look older than
//! those before it and silence the robot. So the last few are kept side by side, and a late message of
//! an earlier one, never taken before, is taken.

use super::packet::Stream;
use alloc::collections::BTreeMap;
use smallvec::SmallVec;
use starl_core::Payload;

/// The incarnations of a sender that are remembered.
const LIVES: usize = 4;

/// Messages to hand out or to acknowledge, by number.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Taken {
    /// To be handed out, in this order; each is to be acknowledged.
    pub arrived: SmallVec<[(u32, Payload); 1]>,
    /// Whether the message was taken before and is to be acknowledged again.
    pub again: bool,
}

/// What is known of one sender: its incarnations, that of which we heard last at the end.
#[derive(Clone, Debug, Default)]
pub(super) struct Inbox(SmallVec<[Life; 1]>);

/// What came from one incarnation.
#[derive(Clone, Debug)]
struct Life {
    incarnation: u32,
    multicast: Sequence,
    direct: Sequence,
}

impl Inbox {
    /// The messages of a stream of one incarnation.
    pub fn sequence(&mut self, incarnation: u32, stream: Stream) -> &mut Sequence {
        let lives = &mut self.0;
        let life = match lives
            .iter()
            .position(|life| life.incarnation == incarnation)
        {
            Some(at) => lives.remove(at),
            None => Life {
                incarnation,
                multicast: Sequence::default(),
                direct: Sequence::default(),
            },
        };
        if lives.len() == LIVES {
            lives.remove(0);
        }
        lives.push(life);
        let last = lives.len() - 1;
        match stream {
            Stream::Multicast => &mut lives[last].multicast,
            Stream::Direct => &mut lives[last].direct,
        }
    }
}

/// Which messages of a stream have been taken.
#[derive(Clone, Debug)]
pub(super) struct Sequence {
    /// All earlier messages have been taken or will never come.
    next: u32,
    /// First and last numbers of the runs of messages taken after a gap, in order, not touching.
    runs: SmallVec<[(u32, u32); 1]>,
    /// In FIFO order, messages that wait for an earlier one.
    held: BTreeMap<u32, Payload>,
}

impl Default for Sequence {
    fn default() -> Sequence {
        Sequence {
            next: 1,
            runs: SmallVec::new(),
            held: BTreeMap::new(),
        }
    }
}

impl Sequence {
    /// Takes a message as it comes. `oldest` is the earliest that the sender still tries.
    pub fn take(&mut self, number: u32, oldest: u32, content: Payload, most_gaps: u32) -> Taken {
        self.skip_to(oldest);
        let mut taken = Taken::default();
        if self.contains(number) {
            taken.again = true;
        } else if self.insert(number, most_gaps as usize) {
            taken.arrived.push((number, content));
        }
        taken
    }

    /// Takes a message in its sender's order: it is held until all before it have come or, as
    /// `oldest` says, never will.
    pub fn take_in_order(
        &mut self,
        number: u32,
        oldest: u32,
        content: Payload,
        most_gaps: u32,
    ) -> Taken {
        let mut taken = Taken {
            again: number < self.next,
            ..Taken::default()
        };
        if !taken.again && (number == self.next || self.held.len() < most_gaps as usize) {
            self.held.insert(number, content);
        }
        while let Some(first) = self.held.first_entry() {
            let number = *first.key();
            if number != self.next && number > oldest {
                break;
            }
            taken.arrived.push((number, first.remove()));
            self.next = number.saturating_add(1);
        }
        self.next = self.next.max(oldest);
        taken
    }

    /// Nothing before `oldest` will come: releases what was held for it.
    pub fn settle(&mut self, oldest: u32) -> Taken {
        let mut taken = Taken::default();
        self.skip_to(oldest);
        while let Some(first) = self.held.first_entry() {
            let number = *first.key();
            if number > self.next {
                break;
            }
            taken.arrived.push((number, first.remove()));
            self.next = self.next.max(number.saturating_add(1));
        }
        taken
    }

    fn contains(&self, number: u32) -> bool {
        number < self.next
            || self
                .runs
                .iter()
                .any(|&(first, last)| first <= number && number <= last)
    }

    /// Marks a message that is not contained yet; false if that would need too much memory.
    fn insert(&mut self, number: u32, most_runs: usize) -> bool {
        let at = self.runs.partition_point(|&(_, last)| last < number);
        let extends_left = at > 0 && self.runs[at - 1].1 + 1 == number;
        let extends_right = self.runs.get(at).is_some_and(|run| run.0 - 1 == number);
        match (extends_left, extends_right) {
            (true, true) => {
                self.runs[at - 1].1 = self.runs[at].1;
                self.runs.remove(at);
            }
            (true, false) => self.runs[at - 1].1 = number,
            (false, true) => self.runs[at].0 = number,
            (false, false) if number == self.next => self.next = number.saturating_add(1),
            (false, false) if self.runs.len() < most_runs => self.runs.insert(at, (number, number)),
            (false, false) => return false,
        }
        self.skip_to(self.next);
        true
    }

    /// Counts everything before `oldest` as taken.
    fn skip_to(&mut self, oldest: u32) {
        self.next = self.next.max(oldest);
        while let Some(&(first, last)) = self.runs.first() {
            if first > self.next {
                break;
            }
            self.next = self.next.max(last.saturating_add(1));
            self.runs.remove(0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether the first message of an incarnation is handed out.
    fn takes_first(inbox: &mut Inbox, incarnation: u32) -> bool {
        let sequence = inbox.sequence(incarnation, Stream::Multicast);
        let taken = sequence.take_in_order(1, 1, Payload::new(), 8);
        assert_eq!(taken.again, taken.arrived.is_empty());
        !taken.arrived.is_empty()
    }

    #[test]
    fn a_restart_of_either_side_undoes_that_messages_are_believed_to_be_taken() {
        let mut inbox = Inbox::default();
        // As a fault may have it.
        inbox.sequence(7, Stream::Multicast).next = 1_000_000;
        assert!(!takes_first(&mut inbox, 7));
        assert!(takes_first(&mut inbox, 8), "the sender has restarted");
        let mut inbox = Inbox::default();
        assert!(takes_first(&mut inbox, 7), "the receiver has restarted");
    }
}
