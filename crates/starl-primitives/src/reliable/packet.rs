//! What the protocol sends.

use serde::{Deserialize, Serialize};

/// One datagram; `C` holds the content, borrowed when it is sent and owned when it arrived.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Packet<C> {
    /// A message.
    Data {
        /// Which message.
        key: Key,
        /// How far back the oldest message lies that the sender still tries to get through on this
        /// stream: nothing earlier will come, or come again.
        oldest_back: u32,
        /// The user's bytes.
        content: C,
    },
    /// The receiver has taken the message.
    Acknowledge(Key),
    /// Which messages to all may still come?
    Ask {
        /// For the answer.
        ticket: u32,
    },
    /// Of the sender's present incarnation, messages to all before this number will not come to the
    /// robot that asked, or not again.
    Oldest {
        /// The sender's.
        incarnation: u32,
        /// The number.
        number: u32,
        /// The number that its next message to all will have.
        next: u32,
        /// That of the question.
        ticket: u32,
    },
}

/// Names a message between one sender and one receiver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Key {
    /// The sender's: a new one each time it starts.
    pub incarnation: u32,
    /// Which of the sender's streams.
    pub stream: Stream,
    /// Counts the messages of the stream from 1.
    pub number: u32,
}

/// A sender numbers what it sends to all apart from what it sends to each robot, so that every
/// receiver sees numbers without gaps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Stream {
    /// To all.
    Multicast,
    /// To one robot.
    Direct,
}
