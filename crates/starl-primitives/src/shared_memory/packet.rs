//! The messages between memories.

use super::stamp::{HybridClock, Stamp};
use alloc::string::String;
use alloc::vec::Vec;
use core::ops::RangeInclusive;
use serde::{Deserialize, Serialize};
use starl_core::{Payload, RobotId};

/// One datagram.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Datagram<C> {
    /// The reading of the sender's clock.
    pub clock: HybridClock,
    pub content: C,
}

/// The content.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Content {
    /// To all: elements to merge.
    Elements(Vec<Write>),
    /// To all: what the sender's memory amounts to.
    Announcement(Announcement),
    /// To one: parts of the sender's memory, to be compared.
    Comparison(Vec<Part>),
    /// To one: send me what you have under these keys.
    Wanted(Vec<u64>),
    /// To all: elements of causal variables to merge, with their dependencies.
    Causal(Vec<(Write, Vec<Dependency>)>),
}

/// A whole memory in short.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Announcement {
    /// Of all elements.
    pub fingerprint: u64,
    /// How many there are.
    pub elements: u32,
    /// Whether nothing has changed for a while.
    pub settled: bool,
    /// See [`super::gossip::Gossip::unasked`].
    pub unasked: u8,
    /// Robots whose comparisons have arrived since the last announcement.
    pub compared: Vec<RobotId>,
}

/// An element on its way. An element of a single-writer array belongs to its writer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Write {
    pub variable: String,
    pub single_writer: bool,
    pub stamp: Stamp,
    pub value: Payload,
    /// Its dependencies; none for a variable that is not causal.
    #[serde(skip)]
    pub depends: Option<Vec<Dependency>>,
}

/// A write that another one may depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Dependency {
    pub key: u64,
    pub stamp: Stamp,
}

/// A range of keys and what the sender has there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Part {
    /// The fingerprints of the range's sixteen parts.
    Split(Range, [u64; 16]),
    /// All elements in it.
    Listed(Range, Vec<Item>),
}

/// An element without its content.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Item {
    pub key: u64,
    pub stamp: Stamp,
    /// Of the whole element.
    pub hash: u32,
}

/// The keys that begin with `depth` hexadecimal digits, `prefix`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Range {
    depth: u8,
    prefix: u64,
}

/// At this depth a range is a single key.
const DEEPEST: u8 = 16;

impl Range {
    /// All keys.
    pub const ALL: Range = Range {
        depth: 0,
        prefix: 0,
    };

    /// Its keys; none where there is no such range.
    pub fn keys(self) -> Option<RangeInclusive<u64>> {
        if self.depth > DEEPEST {
            return None;
        }
        let rest = 64 - 4 * u32::from(self.depth);
        let first = self.prefix.checked_shl(rest).unwrap_or(0);
        let last = first | u64::MAX.checked_shr(64 - rest).unwrap_or(0);
        let fits = first.checked_shr(rest).unwrap_or(0) == self.prefix;
        fits.then_some(first..=last)
    }

    /// Its sixteen parts; none where it has none.
    pub fn parts(self) -> Option<[Range; 16]> {
        if self.depth >= DEEPEST {
            return None;
        }
        self.keys()?;
        Some(core::array::from_fn(|digit| Range {
            depth: self.depth + 1,
            prefix: self.prefix << 4 | digit as u64,
        }))
    }
}

// The most bytes that postcard takes for a datagram's parts, by the varints' greatest lengths: 10 for
// 64 bits, 5 for 32 bits.

const STAMP_BYTES: usize = 10 + 5 + 5 + 5;

/// Around lists: clock, variant, length.
pub(super) const FRAME_BYTES: usize = 10 + 5 + 1 + 5;

/// One key of [`Content::Wanted`].
pub(super) const KEY_BYTES: usize = 10;

impl Part {
    /// At most.
    pub fn bytes(&self) -> usize {
        let range = 1 + 1 + 10;
        match self {
            Part::Split(..) => range + 16 * 10,
            Part::Listed(_, items) => range + 5 + items.len() * (10 + STAMP_BYTES + 5),
        }
    }
}

impl Write {
    /// At most.
    pub fn bytes(&self) -> usize {
        let depends = self.depends.as_ref().map_or(0, Vec::len);
        let depends = 5 + depends * (KEY_BYTES + STAMP_BYTES);
        5 + self.variable.len() + 1 + STAMP_BYTES + 5 + self.value.len() + depends
    }
}
