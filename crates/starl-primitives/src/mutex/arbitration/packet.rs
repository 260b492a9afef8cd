//! The messages between robots and arbiters.

use super::super::Resources;
use super::super::common::RequestId;
use crate::founders::Founders;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use starl_core::RobotId;

/// A message.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Packet {
    /// To an arbiter: the sender wants these resources, or wants to keep them.
    Request(Wish),
    /// To several arbiters: the same.
    Repeat {
        wish: Wish,
        /// The attempts of the arbiters with which it is not the first.
        attempts: Vec<(RobotId, u32)>,
        /// The arbiters that the sender has heard lately.
        heard: Vec<RobotId>,
    },
    /// To a robot: as far as this arbiter is concerned, it may have what it asked for.
    Grant {
        id: RequestId,
        attempt: u32,
        /// The round of asking since which the grant lasts.
        round: u32,
        /// The arbiter's clock (Lamport's): later requests are to be later by it.
        clock: u64,
        /// The grant's number, greater than all before it that were for one of its resources.
        number: u64,
    },
    /// To a robot: it has to wait. With leases only where the arbiter grants nothing, or ranks the request last.
    Wait {
        id: RequestId,
        attempt: u32,
        clock: u64,
        behind: Behind,
    },
    /// To a robot: does it still need what it asked for?
    Inquire {
        id: RequestId,
        attempt: u32,
        /// An earlier request wants one of the resources: the robot must yield unless it has entered.
        must_yield: bool,
    },
    /// To an arbiter: of what was granted only this is still needed.
    Release {
        id: RequestId,
        left: Resources,
        /// The number of what was held; 0 if nothing was, and without leases.
        number: u64,
    },
    /// To a robot: its request counts as older than another that it has made.
    Outdated { id: RequestId },
    /// To all: an arbiter that remembers nothing asks what it had granted.
    Recall {
        nonce: u32,
        list: u32,
        /// The life of the sender.
        incarnation: u32,
    },
    /// The answer.
    Recalled {
        nonce: u32,
        list: u32,
        /// The resources that the sender holds by the arbiter's grant.
        holds: Option<Wish>,
        /// The greatest number that the sender knows of as an arbiter.
        number: u64,
        /// Whether the sender remembers what it granted.
        remembers: bool,
        /// In which of its lives.
        incarnation: u32,
        /// Those with which the fleet began, if the arbiter is one of them.
        founders: Founders,
    },
}

/// A robot's request.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Wish {
    pub id: RequestId,
    /// Counts the attempts with this arbiter: a grant to an earlier attempt is returned.
    pub attempt: u32,
    /// Counts repetitions.
    pub round: u32,
    /// The Lamport time of the first request: earlier requests are granted first.
    pub clock: u64,
    /// The least number of the grant.
    pub number: u64,
    /// Whether the robot holds the resources, by this number.
    pub is_entered: bool,
    /// Whether it has heard the arbiter lately, so that it knows of a grant.
    pub hears: bool,
    /// A hash of the list of participants.
    pub list: u32,
    pub resources: Resources,
}

/// The robot or arbiter that a request waits for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Behind {
    /// This robot holds or requests one of the resources, or must report the arbiter's earlier grants.
    Robot(RobotId),
    /// The arbiter knows other participants.
    OtherList,
}
