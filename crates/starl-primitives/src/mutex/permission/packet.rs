//! The messages between robots about permissions.

use super::super::Resources;
use super::super::common::RequestId;
use serde::{Deserialize, Serialize};

/// A message.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Packet {
    /// The sender wants all of these resources.
    Request(Wish),
    /// As far as the sender of this is concerned, the receiver may have what it asked for.
    Permit {
        /// Its request.
        id: RequestId,
        /// And which attempt of it.
        attempt: u32,
    },
}

/// A robot's request.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Wish {
    pub id: RequestId,
    /// Counts how often permissions were requested again. The sender of an answer to an earlier
    /// attempt may have forgotten it.
    pub attempt: u32,
    /// The Lamport time of the first request: earlier requests are granted first.
    pub clock: u64,
    pub resources: Resources,
}
