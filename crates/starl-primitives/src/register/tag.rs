//! The order of a register's writes.

use serde::{Deserialize, Serialize};
use starl_core::RobotId;

/// Counts go no further: no fleet writes that often, so a greater one comes from a corruption.
const GREATEST: u64 = 1 << 62;

/// Orders the writes of a register: the greatest is the latest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Tag {
    /// One more than the greatest that the writer found.
    pub count: u64,
    /// The writer.
    pub writer: RobotId,
    /// In which of its lives, so that no tag is used twice.
    pub incarnation: u32,
}

impl Default for Tag {
    /// Less than that of any write.
    fn default() -> Tag {
        Tag {
            count: 0,
            writer: RobotId(0),
            incarnation: 0,
        }
    }
}

impl Tag {
    /// Its greatest size in bytes, with varints of the greatest length.
    pub(super) const BYTES: usize = 10 + 5 + 5;

    /// Whether writes can have led to it.
    pub(super) fn is_valid(self) -> bool {
        self.count <= GREATEST
    }

    /// A tag that is greater by this count.
    pub(super) fn later_by(mut self, counts: u32) -> Tag {
        self.count = (self.count + u64::from(counts)).min(GREATEST);
        self
    }

    /// A greater one than those that were found, the greatest of which is given.
    pub(super) fn after(found: Option<Tag>, writer: RobotId, incarnation: u32) -> Tag {
        let found = found.map_or(0, |tag| tag.count);
        Tag {
            count: (found + 1).min(GREATEST),
            writer,
            incarnation,
        }
    }
}
