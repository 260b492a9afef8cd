//! The records of one element of a shared memory: its writes, and the values that robots show.

use starl_core::event::storing::Written;
use starl_core::{RobotId, Time};
use std::collections::BTreeMap;

/// Orders the writes of an element, as the trace gives it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Stamp {
    pub time: Time,
    pub count: u32,
    pub writer: RobotId,
    /// In which of the writer's lives.
    pub incarnation: u32,
}

impl Stamp {
    pub fn of(written: &Written) -> Stamp {
        Stamp {
            time: written.time,
            count: written.count,
            writer: written.writer,
            incarnation: written.incarnation,
        }
    }
}

/// The write that a robot shows.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shown {
    /// This write, since then.
    Write(Stamp, Time),
    /// Its memory was overwritten, and it has said nothing since.
    Unknown,
}

impl Shown {
    /// Whether it shows this write or a later one, or this is unknown.
    pub fn may_be_at_least(self, stamp: Stamp) -> bool {
        match self {
            Shown::Write(shown, _) => shown >= stamp,
            Shown::Unknown => true,
        }
    }
}

/// An element.
#[derive(Clone, Debug, Default)]
pub(super) struct Element {
    /// The value of each write, as a hash, and when it was written, from `oldest` on.
    written: BTreeMap<Stamp, (i64, Time)>,
    /// Earlier writes are forgotten: everyone has shown later ones.
    oldest: Option<Stamp>,
    pub shown: BTreeMap<RobotId, Shown>,
}

impl Element {
    /// Records a write.
    pub fn write(&mut self, stamp: Stamp, value: i64, at: Time) {
        self.written.insert(stamp, (value, at));
    }

    /// When it was written; none where that is forgotten.
    pub fn written_at(&self, stamp: Stamp) -> Option<Time> {
        self.written.get(&stamp).map(|&(_, at)| at)
    }

    /// Whether this was written; where that is forgotten, it counts as so.
    pub fn was_written(&self, stamp: Stamp, value: i64) -> bool {
        let known = self.written.get(&stamp);
        self.oldest.is_some_and(|oldest| stamp < oldest)
            || known.is_some_and(|&(known, _)| known == value)
    }

    /// Whether another value was written with this stamp.
    pub fn has_other(&self, stamp: Stamp, value: i64) -> bool {
        let known = self.written.get(&stamp);
        known.is_some_and(|&(known, _)| known != value)
    }

    /// Records the write that a robot shows from now on; returns the later write that it showed before, if any.
    pub fn show(&mut self, robot: RobotId, stamp: Stamp, now: Time) -> Option<Stamp> {
        match self.shown.insert(robot, Shown::Write(stamp, now)) {
            Some(Shown::Write(before, _)) if before > stamp => Some(before),
            _ => None,
        }
    }

    /// The latest write that anyone shows.
    pub fn latest(&self) -> Option<Stamp> {
        let shown = self.shown.values().filter_map(|shown| match shown {
            Shown::Write(stamp, _) => Some(*stamp),
            Shown::Unknown => None,
        });
        shown.max()
    }

    /// Everyone shows this write or a later one.
    pub fn forget_before(&mut self, stamp: Stamp) {
        self.written = self.written.split_off(&stamp);
        self.oldest = self.oldest.max(Some(stamp));
    }
}
