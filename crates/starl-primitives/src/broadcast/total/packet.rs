//! The messages by which robots agree on an order.

use super::life::{Life, LifeName};
use alloc::boxed::Box;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use starl_core::{Payload, RobotId};

/// Names a group, that is a log. Robots only go from lesser ones to greater ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) struct Generation {
    pub counter: u32,
    pub founder: Life,
}

/// An entry of the log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Entry {
    /// The term of the leader that put it there.
    pub term: u32,
    pub what: What,
}

/// The content of an entry.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum What {
    /// A leader begins.
    Start,
    /// From here on these vote, at most one life of each robot, in their order.
    Voters(Vec<Life>),
    /// A message of this robot's life that votes here.
    Message {
        from: RobotId,
        number: u32,
        content: Payload,
    },
}

/// A datagram.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Said {
    /// The sender's life.
    pub life: LifeName,
    /// Its group.
    pub generation: Option<Generation>,
    pub body: Body,
}

/// Names one asking of one life: only what answers it is known to have been said after it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Question {
    pub asker: LifeName,
    pub number: u32,
}

/// The content of a message.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Body {
    /// The sender is up.
    Hello {
        /// The greatest group in which it has taken or may have to take messages.
        bound_to: Option<Generation>,
        /// The [`Body::Ask`] that this answers, of a group that is not the sender's.
        answer: Option<Question>,
    },
    /// These lives, which are in no group, found one.
    Found {
        generation: Generation,
        /// The number of members that are needed to decide.
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
        question: Question,
        /// The term that the sender of this is in.
        term: u32,
        is_granted: bool,
    },
    /// The leader's log continues like this.
    Append {
        term: u32,
        /// Counts the rounds of this leader.
        round: u64,
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
        /// The last round of that term's leader that it has heard; 0 if it has heard none.
        round: u64,
        /// The log is the leader's up to here.
        through: u64,
        /// After that it lacks these parts: what comes after the first, up to the second.
        lacks: Vec<(u64, u64)>,
        /// It has delivered messages up to here.
        applied: u64,
        /// The last call of that term's leader that it has heard; 0 if it has heard none.
        call: u64,
    },
    /// The leader wants a sign of life, which is a [`Body::Taken`] with this call.
    Call { to: LifeName, term: u32, call: u64 },
    /// The state that a life needs to continue from some place in the log.
    Snapshot {
        to: LifeName,
        /// A call as well.
        call: u64,
        quorum: u32,
        term: u32,
        /// The place: all up to here is decided.
        index: u64,
        index_term: u32,
        /// The leader has no entries up to here to send.
        base: u64,
        /// The voters, and the last message of each.
        roll: Vec<(Life, u32)>,
    },
    /// A message to robots that may not hear its sender: all that hear this pass it on.
    Relay {
        from: RobotId,
        to: Vec<RobotId>,
        said: Box<Said>,
    },
    /// The leader does not hear the robots for which this is.
    Unheard,
    /// Messages to be put into the log, in the order of their numbers.
    Propose {
        /// The number of the oldest message that still waits for its place.
        oldest: u32,
        messages: Vec<(u32, Payload)>,
    },
}
