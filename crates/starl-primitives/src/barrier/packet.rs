//! The messages between robots about their generations.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use starl_core::RobotId;

/// The one message: how far its sender is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Packet {
    /// The sender's life.
    pub incarnation: u32,
    /// The generation that it waits for, or will wait for next.
    pub generation: u64,
    pub waits: bool,
    /// Whether that number is certain.
    pub knows: bool,
    /// The sender's answers to others, to show that it was alive after they asked.
    pub heard: BTreeMap<RobotId, u32>,
    /// The numbers that others must answer, if they differ from the sender's incarnation: drawn for lives of theirs
    /// that are new to the sender.
    pub asks: BTreeMap<RobotId, u32>,
    /// The robots from which the sender needs a message before it can pass.
    pub missing: Vec<RobotId>,
    /// Whether it has said the same before.
    pub again: bool,
}
