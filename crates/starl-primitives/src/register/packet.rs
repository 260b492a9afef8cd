//! The messages between robots about registers.

use super::tag::Tag;
use super::version::Version;
use crate::founders::Founders;
use alloc::string::String;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use starl_core::RobotId;

/// One datagram.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Datagram {
    /// Drawn when the sender started.
    pub incarnation: u32,
    /// The life in which the sender answers; 0 if it does not yet.
    pub life: u64,
    /// The latest lives known to the sender, except first ones.
    pub lives: Vec<(RobotId, u64)>,
    pub content: Content,
}

/// The content.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Content {
    /// The sender has just started. In the first stage it asks for the number of its last life; in the
    /// second it says that of its new one, and asks for the copies after a register.
    Hello {
        id: QuestionId,
        life: Option<u64>,
        after: Option<String>,
    },
    /// To one that has just started: the last life of yours that I know of, 0 for none; and whether I
    /// answer others.
    Told {
        id: QuestionId,
        life: u64,
        is_up: bool,
        /// Whether I have heard a robot that is up, lately.
        hears_up: bool,
        /// Those with which the fleet began, if you are one of them.
        founders: Founders,
    },
    /// To one that has said the number of its new life: copies.
    State { id: QuestionId, page: Page },
    /// Show me your copy; without its value, if only its tag counts.
    Query {
        id: QuestionId,
        register: String,
        is_read: bool,
    },
    /// Show me your copy, and from now on refuse to store anything under a lower ballot.
    Claim {
        id: QuestionId,
        register: String,
        ballot: Tag,
    },
    /// Here it is, and the greatest ballot that was promised before. `claimed` is what is promised now, if
    /// that was asked for.
    Value {
        id: QuestionId,
        claimed: Option<Tag>,
        promised: Option<Tag>,
        version: Option<Version>,
    },
    /// Store this, unless you have a later one or have promised not to.
    Store { id: QuestionId, entry: Entry },
    /// The value with this tag is stored.
    Stored { id: QuestionId, tag: Tag },
    /// The value with this tag is not stored, or this ballot not promised, because a greater one
    /// is.
    Refused {
        id: QuestionId,
        tag: Tag,
        promised: Tag,
    },
    /// To all: what the sender's copies amount to.
    Announcement(u64),
    /// To one: the tags of the sender's copies of the registers after one up to another.
    Comparison {
        after: Option<String>,
        last: Option<String>,
        tags: Vec<(String, Tag)>,
    },
    /// Copies to merge.
    Entries(Vec<Entry>),
    /// Send me your copies of these.
    Wanted(Vec<String>),
}

/// Identifies a question among all questions of its robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct QuestionId {
    /// Drawn when the robot started.
    pub incarnation: u32,
    /// The operation's; for one that has just started, how many stages it has begun.
    pub number: u32,
}

/// Copies in the order of their names.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Page {
    /// Those after this register.
    pub after: Option<String>,
    pub entries: Vec<PageEntry>,
    /// Whether there are no more.
    pub is_last: bool,
}

/// A copy of a register.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Entry {
    pub register: String,
    pub version: Version,
}

/// A copy and a promise, for one that has just started.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct PageEntry {
    pub register: String,
    pub promised: Option<Tag>,
    pub version: Option<Version>,
}

impl Entry {
    /// The greatest size in bytes, with varints of the greatest length.
    pub fn bytes(&self) -> usize {
        5 + self.register.len() + self.version.bytes()
    }
}

impl PageEntry {
    /// As [`Entry::bytes`].
    pub fn bytes(&self) -> usize {
        let version = self.version.as_ref().map_or(0, Version::bytes);
        5 + self.register.len() + 2 + Tag::BYTES + version
    }
}
