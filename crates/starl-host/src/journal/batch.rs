//! Entries of several robots put together to one message of a trace.

use super::bytes::append;
use alloc::collections::BTreeSet;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use starl_core::{RobotId, Time};

/// The entries of some time span.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// Lists that the entries name, encoded, by their hashes.
    pub(super) lists: Vec<(u64, Vec<u8>)>,
    pub(super) entries: Vec<Noted>,
}

/// One entry.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Noted {
    /// When, by the host's clock.
    pub at: Time,
    /// On which robot.
    pub robot: RobotId,
    /// The entry, encoded.
    pub entry: Vec<u8>,
}

impl Batch {
    /// Makes the batch empty.
    pub fn clear(&mut self) {
        self.lists.clear();
        self.entries.clear();
    }

    /// Sorts the entries by time and robot; the sort is stable.
    pub fn sort(&mut self) {
        self.entries.sort_by_key(|entry| (entry.at, entry.robot));
    }

    /// The entries.
    pub fn entries(&self) -> &[Noted] {
        &self.entries
    }
}

/// A part of a message. A message is one or more of them, one after the other.
#[derive(Serialize, Deserialize)]
pub enum Frame<'a> {
    /// A list, before the first entry that names it.
    List {
        hash: u64,
        #[serde(serialize_with = "super::bytes::as_bytes")]
        list: &'a [u8],
    },
    /// An entry of a robot's journal.
    Entry {
        robot: RobotId,
        /// How long after the message's time it was made, nanoseconds.
        after: u64,
        #[serde(serialize_with = "super::bytes::as_bytes")]
        entry: &'a [u8],
    },
}

/// Makes the messages of one trace; writes each list only once.
#[derive(Clone, Debug, Default)]
pub struct Packer {
    written: BTreeSet<u64>,
}

impl Packer {
    /// The next message: the time of its first entry, and its content. `None` if the batch is empty. The
    /// batch must be [sorted](Batch::sort).
    pub fn pack(&mut self, batch: &Batch) -> Option<(Time, Vec<u8>)> {
        let start = batch.entries.first()?.at;
        let mut content = Vec::new();
        for (hash, list) in &batch.lists {
            if self.written.insert(*hash) {
                let hash = *hash;
                append(&Frame::List { hash, list }, &mut content);
            }
        }
        for Noted { at, robot, entry } in &batch.entries {
            let frame = Frame::Entry {
                robot: *robot,
                after: at.0 - start.0,
                entry,
            };
            append(&frame, &mut content);
        }
        Some((start, content))
    }
}
