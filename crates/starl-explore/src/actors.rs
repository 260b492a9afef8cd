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

/// Where the actors begin in the row of a state: its head stands before them.
pub(crate) const HEAD: usize = 1;

/// All actors that were seen.
#[derive(Clone)]
pub(crate) struct Actors {
    pub bounds: Bounds,
    /// Rows of state and mailbox.
    rows: Rows,
    /// Datagrams in ascending order, as [`Flying`].
    mailboxes: Table,
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
        }
        number
    }

    /// The state of an actor's robot.
    pub fn local(&self, actor: u32) -> u32 {
        self.rows.row(actor)[0]
    }

    /// The datagrams that are on their way to an actor.
    pub fn mailbox(&self, actor: u32) -> &[u32] {
        self.words(self.number_of_mailbox(actor))
    }

    /// How many actors there are.
    pub fn len(&self) -> u32 {
        self.rows.len()
    }

    /// How many different mailboxes there are.
    pub fn mailboxes(&self) -> u32 {
        self.mailboxes.len()
    }

    /// The number of an actor's mailbox.
    pub fn number_of_mailbox(&self, actor: u32) -> u32 {
        self.rows.row(actor)[1]
    }

    /// The datagrams in a mailbox.
    pub fn words(&self, mailbox: u32) -> &[u32] {
        self.mailboxes.row(mailbox)
    }

    /// Writes what states that are compared have in common: the state of the checkers and those of the robots.
    pub fn write_group(&self, watch: u32, row: &[u32], group: &mut Vec<u32>) {
        group.clear();
        group.push(watch);
        group.extend(row[HEAD..].iter().map(|&actor| self.local(actor)));
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
            + self.posted.bytes()
            + self.after_post.capacity() * size_of::<u32>()
            + self.prospects.capacity() * size_of::<Option<Prospects>>()
            + self.moves.capacity() * size_of::<Move>()
    }
}
