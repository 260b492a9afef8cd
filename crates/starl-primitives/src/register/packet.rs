//! What robots say to each other about registers.

use super::tag::Tag;
use alloc::string::String;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use starl_core::{Payload, RobotId};

/// One datagram.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Datagram {
    /// Drawn when the sender started.
    pub incarnation: u32,
    /// The life in which the sender answers; 0 if it does not yet.
    pub life: u64,
    /// The latest lives that the sender knows of, those after the first.
    pub lives: Vec<(RobotId, u64)>,
    pub content: Content,
}

/// What it says.
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
    },
    /// To one that has said the number of its new life: copies.
    State { id: QuestionId, page: Page },
    /// Show me your copy; without its value, if only its tag counts.
    Query {
        id: QuestionId,
        register: String,
        is_read: bool,
    },
    /// Here it is.
    Value {
        id: QuestionId,
        tag: Option<Tag>,
        value: Payload,
    },
    /// Store this, unless you have a later one.
    Store { id: QuestionId, entry: Entry },
    /// Done.
    Stored { id: QuestionId },
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

/// Names a question among all that its robot ever asks.
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
    pub entries: Vec<Entry>,
    /// Whether there are no more.
    pub is_last: bool,
}

/// A copy of a register.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Entry {
    pub register: String,
    pub tag: Tag,
    pub value: Payload,
}

impl Entry {
    /// So many bytes it takes at most, by the varints' greatest lengths.
    pub fn bytes(&self) -> usize {
        5 + self.register.len() + TAG_BYTES + 5 + self.value.len()
    }
}

/// A tag's, at most.
pub(super) const TAG_BYTES: usize = 10 + 5 + 5;
