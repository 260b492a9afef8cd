//! What robots say to each other to agree on an order.

use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use starl_core::{Payload, RobotId};

/// A robot from the moment at which it remembers nothing of the group to the next such moment: another
/// one after each start, and whenever it gives a group up. It is a member of at most one group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) struct Life {
    pub robot: RobotId,
    pub number: u32,
}

/// Names a group, that is a log. Robots only go from lesser ones to greater ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) struct Generation {
    pub counter: u32,
    pub founder: Life,
}

/// Names who numbers messages: a robot and its incarnation, as records have it.
pub(super) type Sender = (RobotId, u32);

/// An entry of the log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Entry {
    /// The term of the leader that put it there.
    pub term: u32,
    pub what: What,
}

/// What an entry says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum What {
    /// A leader begins.
    Start,
    /// From here on these vote.
    Voters(Vec<Life>),
    /// A message.
    Message {
        sender: Sender,
        number: u32,
        content: Payload,
    },
}

/// A datagram.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Said {
    /// The sender's life.
    pub life: u32,
    /// Its group.
    pub generation: Option<Generation>,
    pub body: Body,
}

/// What is said.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Body {
    /// The sender is up.
    Hello {
        /// The greatest group in which it has taken or may have to take messages.
        bound_to: Option<Generation>,
        /// The number of the [`Body::Ask`] that this answers, of a group that is not the sender's.
        answer: Option<u32>,
    },
    /// These lives, which are in no group, found one.
    Found {
        generation: Generation,
        /// So many are needed to decide.
        quorum: u32,
        voters: Vec<Life>,
    },
    /// The sender wants to lead.
    Ask {
        /// Counts its asking.
        number: u32,
        /// It only wants to know whether it would be elected.
        trial: bool,
        /// The term in which it would lead.
        term: u32,
        /// The end of its log.
        last_term: u32,
        last: u64,
    },
    /// The answer to that.
    Vote {
        number: u32,
        /// The term that the sender of this is in.
        term: u32,
        is_granted: bool,
    },
    /// The leader's log goes on like this.
    Append {
        term: u32,
        /// The entry before these.
        previous: u64,
        previous_term: u32,
        entries: Vec<Entry>,
        /// The log is decided up to here.
        commit: u64,
        /// Entries up to here need not be kept.
        floor: u64,
        /// An answer is wanted even if there is nothing new.
        is_beat: bool,
    },
    /// The answer to that.
    Taken {
        term: u32,
        /// The log is the leader's up to here.
        through: u64,
        /// Whether it could take what it was sent; if not, it lacks what comes after `through`.
        is_whole: bool,
        /// It has handed out messages up to here.
        applied: u64,
    },
    /// What a robot has to know to go on from some place in the log.
    Snapshot {
        quorum: u32,
        term: u32,
        /// The place: all up to here is decided.
        index: u64,
        index_term: u32,
        voters: Vec<Life>,
        /// The last message of each sender.
        senders: Vec<(Sender, u32)>,
    },
    /// Messages to be put into the log, the oldest on its way first.
    Propose {
        incarnation: u32,
        messages: Vec<(u32, Payload)>,
    },
}
