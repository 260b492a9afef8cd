//! The facts that it takes to compare states, apart from their rows: the datagrams in transit, and the remaining bounds.
//!
//! It is a copy, so that states can be compared while others are expanded and more actors are found.

use crate::actors::Actors;
use crate::bounds::Left;
use crate::code::Flying;
use crate::table::Rows;

/// Mailboxes by actor, and the remaining bounds by head.
#[derive(Clone, Default)]
pub(crate) struct Facts {
    words: Vec<u32>,
    /// By mailbox: where it ends in `words`.
    ends: Vec<usize>,
    /// By actor: the number of its mailbox.
    mailboxes: Vec<u32>,
    /// By actor: a bit for each datagram in its mailbox; several may share one.
    marks: Vec<u32>,
    left: Vec<Left>,
}

impl Facts {
    /// Copies what was found since the last call.
    pub fn catch_up(&mut self, actors: &Actors, heads: &Rows) {
        for mailbox in self.ends.len() as u32..actors.mailboxes() {
            self.words.extend_from_slice(actors.words(mailbox));
            self.ends.push(self.words.len());
        }
        for actor in self.mailboxes.len() as u32..actors.len() {
            self.mailboxes.push(actors.number_of_mailbox(actor));
            let mailbox = actors.mailbox(actor).iter();
            let marks = mailbox.map(|&word| 1 << (Flying(word).number() % 32));
            self.marks.push(marks.fold(0, |all, mark| all | mark));
        }
        for head in self.left.len() as u32..heads.len() {
            self.left.push(Left::read(&heads.row(head)[1..]));
        }
    }

    /// The datagrams that are on their way to an actor.
    pub fn mailbox(&self, actor: u32) -> &[u32] {
        let mailbox = self.mailboxes[actor as usize] as usize;
        let begin = mailbox.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.words[begin..self.ends[mailbox]]
    }

    /// A bit for each datagram in the mailboxes of these actors; several may share one.
    pub fn marks(&self, actors: &[u32]) -> u32 {
        let marks = actors.iter().map(|&actor| self.marks[actor as usize]);
        marks.fold(0, |all, marks| all | marks)
    }

    /// The remaining bounds.
    pub fn left(&self, head: u32) -> Left {
        self.left[head as usize]
    }

    /// Memory in use, bytes.
    pub fn bytes(&self) -> usize {
        (self.words.capacity() + self.mailboxes.capacity() + self.marks.capacity())
            * size_of::<u32>()
            + self.ends.capacity() * size_of::<usize>()
            + self.left.capacity() * size_of::<Left>()
    }
}
