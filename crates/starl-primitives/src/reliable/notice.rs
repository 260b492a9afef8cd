//! The notices of the protocol to its owner.

use alloc::vec::Vec;
use smallvec::SmallVec;
use starl_core::event::messaging::MessageNumber;
use starl_core::{Payload, RobotId};

/// Names a message of this robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct MessageId {
    /// The sender's incarnation: another one each time it starts.
    pub incarnation: u32,
    /// The receiver; none where it went to all.
    pub to: Option<RobotId>,
    /// Counts from 1 what this incarnation sent to `to`.
    pub number: u32,
}

impl MessageId {
    /// Its form in events.
    pub(crate) fn numbered(self) -> MessageNumber {
        MessageNumber {
            number: self.number,
            incarnation: self.incarnation,
        }
    }
}

/// A message that reached this robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrival {
    /// Its sender.
    pub from: RobotId,
    /// The sender's incarnation.
    pub incarnation: u32,
    /// Whether it went to all, and not to this robot alone.
    pub to_all: bool,
    /// The sender's number for it: see [`MessageId`].
    pub number: u32,
    /// The sender's bytes.
    pub content: Payload,
}

impl Arrival {
    /// Its form in events: its sender and number.
    pub(crate) fn numbered(&self) -> (RobotId, MessageNumber) {
        let message = MessageNumber {
            number: self.number,
            incarnation: self.incarnation,
        };
        (self.from, message)
    }
}

/// A notice of the protocol to its owner.
#[derive(Clone, Debug, PartialEq)]
pub enum Notice {
    /// A message reached this robot.
    Arrived(Arrival),
    /// A robot that was asked has said which of its messages to all are settled.
    Settled {
        /// The robot.
        from: RobotId,
        /// The incarnation that it has now.
        incarnation: u32,
        /// Messages of that incarnation with lower numbers have arrived or never will.
        before: u32,
        /// The number that its next message would have had then.
        next: u32,
        /// That of the question.
        ticket: u32,
    },
    /// A message of this robot was sent again to each of these receivers.
    Repeated {
        /// Which message.
        message: MessageId,
        /// Its receivers that have not acknowledged it.
        to: Vec<RobotId>,
    },
    /// All receivers have acknowledged a message of this robot.
    Acknowledged(MessageId),
    /// These receivers did not acknowledge a message of this robot within the retries. They may still
    /// have received it, if only the acknowledgements were lost.
    Failed {
        /// Which message.
        message: MessageId,
        /// Its receivers that were not heard of, in the order of their numbers.
        unreached: Vec<RobotId>,
    },
}

/// Simultaneous notices; usually none or one.
pub type Notices = SmallVec<[Notice; 1]>;
