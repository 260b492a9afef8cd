//! What robots say to each other about where they are.

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
    /// What the sender answers to others, to show that it was alive after they asked for it.
    pub heard: BTreeMap<RobotId, u32>,
    /// What others are to answer, where it is not the sender's incarnation: numbers drawn for lives of theirs that are new
    /// to the sender.
    pub asks: BTreeMap<RobotId, u32>,
    /// From whom the sender needs to hear before it can pass.
    pub missing: Vec<RobotId>,
    /// Whether it has said the same before.
    pub again: bool,
}
