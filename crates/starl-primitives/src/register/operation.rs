//! An operation that is under way.

use super::tag::Tag;
use super::version::Version;
use alloc::boxed::Box;
use alloc::collections::{BTreeMap, BTreeSet};
use starl_core::{Payload, RobotId, Time};

/// The operation.
#[derive(Clone, Debug)]
pub(super) struct Operation {
    pub register: Box<str>,
    pub kind: Kind,
    pub phase: Phase,
    /// The robots that have answered in this phase.
    pub answers: BTreeMap<RobotId, Answer>,
    /// The robots that have refused in this phase, because they have promised another ballot.
    pub refused: BTreeSet<RobotId>,
    /// The greatest ballot or tag that was heard of.
    pub greatest: Option<Tag>,
    /// The latest copy that was found; in the last phase the copy to store.
    pub latest: Option<Version>,
    /// When it began, by the robot's own clock.
    pub begun: Time,
    /// How often this phase's question was asked.
    pub repetitions: u32,
    /// How often it was refused.
    pub rounds: u32,
    /// Whether it is refused and waits before it asks under a greater ballot.
    pub is_backing_off: bool,
    /// The greatest ballot that was abandoned before.
    pub let_go: Option<Tag>,
    /// Whether no majority seems to answer.
    pub is_stuck: bool,
}

/// The kind of operation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Read,
    Write(Payload),
    /// To read a register and have it promised.
    Claim,
    /// To write what was claimed.
    Update {
        /// Under which ballot it is written.
        ballot: Tag,
        /// Whether it has taken effect, as was found after it was refused; none while it is not.
        found: Option<bool>,
    },
}

/// A participant's answer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Answer {
    /// In which of its lives.
    pub life: u64,
    /// The tag that it showed.
    pub tag: Option<Tag>,
    /// Whether nothing greater is promised.
    pub is_firm: bool,
}

/// The parts of operations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Phase {
    /// A majority is asked for its copies.
    Query,
    /// A majority is asked for its copies, and to promise a ballot.
    Claim(Tag),
    /// A majority must store a copy.
    Store,
}

impl Operation {
    /// Records a participant's copy.
    pub fn found(&mut self, version: Option<Version>) {
        if version > self.latest {
            self.latest = version;
        }
    }

    /// Records a ballot or tag, so that the next ballot is greater.
    pub fn heard(&mut self, tag: Option<Tag>) {
        // One that no writes can have led to would leave no greater ones.
        self.greatest = self.greatest.max(tag.filter(|tag| tag.is_valid()));
    }

    /// Whether all that have answered have the latest copy, and have promised nothing since.
    pub fn is_unanimous(&self) -> bool {
        let latest = self.latest.as_ref().map(|version| version.tag);
        let mut answers = self.answers.values();
        answers.all(|answer| answer.is_firm && answer.tag == latest)
    }

    /// Changes to another phase.
    pub fn enter(&mut self, phase: Phase) {
        self.phase = phase;
        self.answers.clear();
        self.refused.clear();
        self.is_backing_off = false;
        self.repetitions = 0;
    }

    /// Restarts the query for the current value, under a ballot.
    pub fn claim(&mut self, ballot: Tag) {
        self.latest = None;
        self.enter(Phase::Claim(ballot));
    }
}
