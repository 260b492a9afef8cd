//! A read or a write that is under way.

use super::tag::Tag;
use alloc::boxed::Box;
use alloc::collections::BTreeMap;
use starl_core::{Payload, RobotId, Time};

/// What is being done.
#[derive(Clone, Debug)]
pub(super) struct Operation {
    pub register: Box<str>,
    /// What is to be written; none for a read.
    pub written: Option<Payload>,
    pub phase: Phase,
    /// Who has answered in this phase: in which life, and the tag that it showed.
    pub answers: BTreeMap<RobotId, (u64, Option<Tag>)>,
    /// The latest copy that was found; in the second phase what is to be stored.
    pub latest: Option<(Tag, Payload)>,
    /// When it began, by the robot's own clock.
    pub begun: Time,
    /// How often this phase's question was asked.
    pub repetitions: u32,
    /// Whether no majority seems to answer.
    pub is_stuck: bool,
}

/// The two halves of every operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Phase {
    /// A majority is asked for its copies.
    Query,
    /// A majority is to store one.
    Store,
}

impl Operation {
    /// Takes note of what a participant has.
    pub fn found(&mut self, tag: Option<Tag>, value: Payload) {
        let Some(tag) = tag else { return };
        let is_later = match &self.latest {
            Some((latest, known)) => (tag, &value) > (*latest, known),
            None => true,
        };
        if is_later {
            self.latest = Some((tag, value));
        }
    }

    /// Whether all that have answered have the latest copy.
    pub fn is_unanimous(&self) -> bool {
        let latest = self.latest.as_ref().map(|(tag, _)| *tag);
        self.answers.values().all(|&(_, tag)| tag == latest)
    }
}
