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
use alloc::boxed::Box;
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
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
    /// What has come ahead of others; none while nothing has, as is usual.
    ahead: Option<Box<Ahead>>,
}

/// What has come of a stream while something before it is missing. One of the two is in use: the first
/// where messages are taken as they come, the second in FIFO order.
#[derive(Clone, Debug, Default)]
struct Ahead {
    /// First and last numbers of the runs of messages taken after a gap, in order, not touching.
    runs: Vec<(u32, u32)>,
    /// Messages that wait for an earlier one.
    held: BTreeMap<u32, Payload>,
}

impl Default for Sequence {
    fn default() -> Sequence {
        Sequence {
            next: 1,
            ahead: None,
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
        let held = self.ahead.as_ref().map_or(0, |ahead| ahead.held.len());
        if number == self.next {
            taken.arrived.push((number, content));
            self.next = number.saturating_add(1);
        } else if !taken.again && held < most_gaps as usize {
            let ahead = self.ahead.get_or_insert_default();
            ahead.held.insert(number, content);
        }
        self.release(&mut taken, |number, next| {
            number == next || number <= oldest
        });
        self.next = self.next.max(oldest);
        taken
    }

    /// Nothing before `oldest` will come: releases what was held for it.
    pub fn settle(&mut self, oldest: u32) -> Taken {
        let mut taken = Taken::default();
        self.skip_to(oldest);
        self.release(&mut taken, |number, next| number <= next);
        taken
    }

    /// Hands out the first of the messages held as long as its number and the one that comes next say
    /// that it waits for nothing.
    fn release(&mut self, taken: &mut Taken, is_ready: impl Fn(u32, u32) -> bool) {
        let Some(ahead) = &mut self.ahead else { return };
        while let Some(first) = ahead.held.first_entry() {
            let number = *first.key();
            if !is_ready(number, self.next) {
                break;
            }
            taken.arrived.push((number, first.remove()));
            self.next = self.next.max(number.saturating_add(1));
        }
        self.tidy();
    }

    fn contains(&self, number: u32) -> bool {
        let mut runs = self.ahead.iter().flat_map(|ahead| &ahead.runs);
        number < self.next || runs.any(|&(first, last)| first <= number && number <= last)
    }

    /// Marks a message that is not contained yet; false if that would need too much memory.
    fn insert(&mut self, number: u32, most_runs: usize) -> bool {
        if number == self.next {
            self.skip_to(number.saturating_add(1));
            return true;
        }
        let runs = &mut self.ahead.get_or_insert_default().runs;
        let at = runs.partition_point(|&(_, last)| last < number);
        let extends_left = at > 0 && runs[at - 1].1 + 1 == number;
        let extends_right = runs.get(at).is_some_and(|run| run.0 - 1 == number);
        let fits = extends_left || extends_right || runs.len() < most_runs;
        match (extends_left, extends_right) {
            (true, true) => {
                runs[at - 1].1 = runs[at].1;
                runs.remove(at);
            }
            (true, false) => runs[at - 1].1 = number,
            (false, true) => runs[at].0 = number,
            (false, false) if fits => runs.insert(at, (number, number)),
            (false, false) => {}
        }
        self.tidy();
        fits
    }

    /// Counts everything before `oldest` as taken.
    fn skip_to(&mut self, oldest: u32) {
        self.next = self.next.max(oldest);
        let Some(ahead) = &mut self.ahead else { return };
        while let Some(&(first, last)) = ahead.runs.first() {
            if first > self.next {
                break;
            }
            self.next = self.next.max(last.saturating_add(1));
            ahead.runs.remove(0);
        }
        self.tidy();
    }

    /// Gives the memory back that is not needed any more.
    fn tidy(&mut self) {
        self.ahead
            .take_if(|ahead| ahead.runs.is_empty() && ahead.held.is_empty());
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
