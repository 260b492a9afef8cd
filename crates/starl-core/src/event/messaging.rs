//! The events of Unicast, Broadcast and Geocast.

use crate::geometry::Area;
use crate::{Duration, RobotId};
use alloc::boxed::Box;
use alloc::vec::Vec;

words! {
    /// In which order a Broadcast hands messages out.
    Order {
        /// Each sender's in the order in which they were sent.
        Fifo = "fifo",
        /// A message is delivered after all messages that its sender had sent or received before it.
        Causal = "causal",
        /// The same order on all robots.
        Total = "total",
    }
}

words! {
    /// Why a robot gave up its group in total order.
    LeaveReason {
        /// Its state was corrupted.
        Corrupt = "corrupt",
        /// There is a later group.
        Obsolete = "obsolete",
        /// Too many of its members have failed.
        Lost = "lost",
    }
}

group! {
    /// Tells a sender's messages apart.
    #[derive(Copy, PartialOrd, Ord)]
    MessageNumber {
        /// The sender's number for it.
        number: u32,
        /// The sender's incarnation: another one each time it starts.
        incarnation: u32,
    }
}

events! {
    /// Outcomes of a message, for every primitive that sends messages.
    TransferEvent {
        /// The sender sends it again to a robot that has not acknowledged it.
        Retransmit = "retransmit" {
            /// Which message of this robot.
            message: MessageNumber,
            /// The receiver.
            to: RobotId,
        },
        /// All have acknowledged it, as the sender knows.
        Acknowledged = "acknowledged" {
            /// Which message of this robot.
            message: MessageNumber,
            /// The receiver; none where it went to all.
            to: Option<RobotId>,
        },
        /// The sender gives it up.
        Fail = "fail" {
            /// Which message of this robot.
            message: MessageNumber,
            /// Those that have not acknowledged it.
            to: Vec<RobotId>,
        },
        /// The receiver hands it to its program.
        Deliver = "deliver" {
            /// The sender.
            from: RobotId,
            /// Which of its messages.
            message: MessageNumber,
        },
    }
}

events! {
    /// Commands to a Unicast, and their results.
    UnicastEvent + #[doc = "An outcome of a message."] Transfer(TransferEvent) {
        /// The program sends a message.
        Send = "send" {
            /// Which message of this robot.
            message: MessageNumber,
            /// For so long it is sent again.
            retry_span: Duration,
            /// The receiver.
            to: RobotId,
        },
    }
}

events! {
    /// Commands to a Broadcast, and their results.
    BroadcastEvent + #[doc = "An outcome of a message."] Transfer(TransferEvent) {
        /// The program sends a message to all.
        Broadcast = "broadcast" {
            /// Which message of this robot.
            message: MessageNumber,
            /// For so long it is sent again.
            retry_span: Duration,
            /// The order that it is promised; none where it has none.
            order: Option<Order>,
        },
        /// A message arrived after one that it should precede. It is not delivered.
        Late = "late" {
            /// The sender.
            from: RobotId,
            /// Which of its messages.
            message: MessageNumber,
        },
        /// The robot stops waiting for a message that should precede another.
        PassOver = "pass_over" {
            /// The sender.
            from: RobotId,
            /// Which of its messages.
            message: MessageNumber,
        },
        /// In total order: the robot enters a group.
        Join = "join" {
            /// Counts the groups that there were.
            group: u32,
        },
        /// In total order: the robot knows that it is a voter of its group.
        Voter = "voter",
        /// In total order: the robot gives up its group.
        Leave = "leave" {
            /// Why.
            reason: LeaveReason,
        },
        /// In total order: the robot leads its group.
        Lead = "lead" {
            /// Counts the leaders.
            term: u32,
        },
        /// In total order: other robots may have delivered messages that this robot will not deliver.
        Gap = "gap",
        /// In total order: the robot has not heard of a majority for long.
        Unavailable = "unavailable",
        /// In total order: a majority is there again.
        Available = "available",
    }
}

events! {
    /// Commands to a Geocast, and their results.
    GeocastEvent + #[doc = "An outcome of a message."] Transfer(TransferEvent) {
        /// The program sends a message to all in an area.
        Geocast = "geocast" {
            /// Which message of this robot.
            message: MessageNumber,
            /// For so long it is sent again.
            retry_span: Duration,
            /// Where its receivers are.
            area: Box<Area>,
        },
        /// A message arrived at a robot outside its area. It is not delivered.
        Outside = "outside" {
            /// The sender.
            from: RobotId,
            /// Which of its messages.
            message: MessageNumber,
        },
    }
}
