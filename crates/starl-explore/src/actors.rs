//! Actors by number: an actor is a robot's state with its mailbox, the datagrams that are on their way to it
//! (Agha 1986, Actors).
//!
//! The possible events of a robot depend on its actor alone. They change the actor, and put its messages into the
//! mailboxes of others. So the events are computed once for each actor, and a state of the fleet is one number for each
//! robot (collapse compression: Holzmann 1997, State compression in SPIN).

use crate::bounds::{Bounds, Clocks};
use crate::code::{Code, Flying};
use crate::robots::Outcome;
use crate::table::{Rows, Table};

/// All actors that were seen.
#[derive(Clone)]
pub(crate) struct Actors {
    pub bounds: Bounds,
    /// Rows of state and mailbox.
    rows: Rows,
    /// Datagrams in ascending order, as [`Flying`].
    mailboxes: Table,
    /// By actor: a bit for each datagram in its mailbox; several may share one.
    marks: Vec<u32>,
    /// By actor; only the requested ones.
    pub prospects: Vec<Option<Prospects>>,
    pub moves: Vec<Move>,
    /// Rows of actor and datagram.
    posted: Rows,
    /// The actors after these were sent.
    after_post: Vec<u32>,
}

/// The steps that are possible for an actor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Prospects {
    /// Where its moves are.
    pub begin: u32,
    pub end: u32,
    /// The actor after a tick of its clock; none if the clock cannot tick now.
    pub ticked: Option<u32>,
}

/// Something that can happen to an actor by itself.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Move {
    pub code: Code,
    /// The actor after it.
    pub next: u32,
    /// The events of this step that checkers are shown.
    pub batch: u32,
    /// The range of the numbers of its sent messages.
    pub sent: (u32, u32),
}

impl Actors {
    pub fn new(bounds: Bounds) -> Actors {
        Actors {
            bounds,
            rows: Rows::new(2, 0),
            mailboxes: Table::default(),
            marks: Vec::new(),
            prospects: Vec::new(),
            moves: Vec::new(),
            posted: Rows::new(2, 0),
            after_post: Vec::new(),
        }
    }

    /// The number of a robot's state with this mailbox.
    pub fn number(&mut self, local: u32, mailbox: &[u32]) -> u32 {
        let (number_of_mailbox, _) = self.mailboxes.insert(mailbox);
        let (number, is_new) = self.rows.insert(&[local, number_of_mailbox], &[]);
        if is_new {
            self.prospects.push(None);
            let marks = mailbox
                .iter()
                .map(|&word| 1 << (Flying(word).number() % 32));
            self.marks.push(marks.fold(0, |all, mark| all | mark));
        }
        number
    }

    /// The state of an actor's robot.
    pub fn local(&self, actor: u32) -> u32 {
        self.rows.row(actor)[0]
    }

    /// The datagrams that are on their way to an actor.
    pub fn mailbox(&self, actor: u32) -> &[u32] {
        self.mailboxes.row(self.rows.row(actor)[1])
    }

    /// A bit for each datagram in the mailboxes of these actors; several may share one.
    pub fn marks(&self, actors: &[u32]) -> u32 {
        let marks = actors.iter().map(|&actor| self.marks[actor as usize]);
        marks.fold(0, |all, marks| all | marks)
    }

    /// An actor to which a datagram was sent.
    pub fn post(&mut self, actor: u32, datagram: u32) -> u32 {
        let (number, is_new) = self.posted.insert(&[actor, datagram], &[]);
        if !is_new {
            return self.after_post[number as usize];
        }
        let mut mailbox = self.mailbox(actor).to_vec();
        if self.bounds.any_copies {
            // A copy that was sent later may arrive whenever one that was sent earlier may.
            mailbox.retain(|&word| Flying(word).number() != datagram);
        }
        let Flying(word) = Flying::new(datagram);
        mailbox.insert(mailbox.partition_point(|&other| other < word), word);
        let after = self.number(self.local(actor), &mailbox);
        self.after_post.push(after);
        after
    }

    /// The moves of an actor.
    pub fn moves(&self, prospects: Prospects) -> &[Move] {
        &self.moves[prospects.begin as usize..prospects.end as usize]
    }

    /// Adds a move of an actor, which has this mailbox after it.
    pub fn add(&mut self, code: Code, outcome: &Outcome, mailbox: &[u32]) {
        let next = self.number(outcome.local, mailbox);
        self.moves.push(Move {
            code,
            next,
            batch: outcome.batch,
            sent: outcome.sent,
        });
    }

    /// An actor's mailbox a tick later, without the datagrams that are too old by then.
    pub fn older(&self, actor: u32) -> Vec<u32> {
        let mailbox = self.mailbox(actor);
        let Clocks::Ticking {
            skew: 0,
            delay: Some(delay),
            ..
        } = self.bounds.clocks
        else {
            return mailbox.to_vec();
        };
        let older = mailbox.iter();
        let mut older: Vec<u32> = older
            .filter_map(|&word| Some(Flying(word).age(delay)?.0))
            .collect();
        older.sort_unstable();
        older
    }

    /// Memory in use, bytes.
    pub fn bytes(&self) -> usize {
        self.rows.bytes()
            + self.mailboxes.bytes()
            + self.marks.capacity() * size_of::<u32>()
            + self.posted.bytes()
            + self.after_post.capacity() * size_of::<u32>()
            + self.prospects.capacity() * size_of::<Option<Prospects>>()
            + self.moves.capacity() * size_of::<Move>()
    }
}
