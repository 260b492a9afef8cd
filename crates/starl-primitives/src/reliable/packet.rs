//! The datagrams of the protocol.

use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use starl_core::RobotId;

/// One datagram; `C` holds contents, borrowed when they are sent and owned when they have arrived.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Packet<C> {
    /// Messages of a stream, or none where it only says how far the stream is.
    Data {
        /// The sender's incarnation.
        incarnation: u32,
        stream: Stream,
        /// That of the [`Packet::Greet`] which this answers.
        token: Option<u32>,
        /// No message before this one will come, or come again.
        base: u32,
        /// The number of the next message that will be sent.
        next: u32,
        /// Robots among these that have all messages need not answer.
        known: Vec<RobotId>,
        /// The messages, each with its number. They come last, so that the end of a datagram shows its message.
        messages: Vec<(u32, C)>,
    },
    /// The receiver does not know the sender's present incarnation: it asks for [`Packet::Data`] with this
    /// token.
    Greet { stream: Stream, token: u32 },
    /// The messages that the receiver has taken.
    Taken {
        /// The sender's incarnation.
        incarnation: u32,
        stream: Stream,
        /// All messages before this one.
        before: u32,
        /// Runs of later ones: how many are missing before the run, and how many are in it.
        ahead: Vec<(u32, u32)>,
    },
}

/// A sender numbers its messages to all separately from those to each robot, so that every receiver sees numbers
/// without gaps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) enum Stream {
    /// To all.
    Multicast,
    /// To one robot.
    Direct,
}
