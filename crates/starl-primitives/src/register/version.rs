//! The content of a register at one time.

use super::tag::Tag;
use alloc::collections::BTreeMap;
use serde::{Deserialize, Serialize};
use starl_core::{Payload, RobotId};

/// The content of a register at one time.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) struct Version {
    /// The tag of its write; for a claimed register the ballot.
    pub tag: Tag,
    /// None where nothing was written.
    pub value: Option<Payload>,
    /// The ballot of each robot's latest claimed write among those that have led to this.
    pub writers: BTreeMap<RobotId, Tag>,
}

impl Version {
    /// The result of a plain write.
    pub fn written(tag: Tag, value: Payload) -> Version {
        Version {
            tag,
            value: Some(value),
            writers: BTreeMap::new(),
        }
    }

    /// The greatest size in bytes, with varints of the greatest length.
    pub fn bytes(&self) -> usize {
        let value = self.value.as_ref().map_or(0, |value| value.len());
        Tag::BYTES + 6 + value + 5 + self.writers.len() * (5 + Tag::BYTES)
    }

    /// Whether writes can have led to it.
    pub fn is_valid(&self) -> bool {
        self.tag.is_valid() && self.writers.values().all(|tag| tag.is_valid())
    }
}
