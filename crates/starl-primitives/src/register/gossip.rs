//! How copies that missed a write are repaired: robots announce a hash of their copies, rarely while nothing changes,
//! and compare the copies if they differ (the rhythm is that of [`crate::shared_memory`], the Trickle algorithm; the
//! comparison is by lists, since registers are few).
//!
//! Operations do not need this. It lets [`Register::known`] show written values, also on robots that are not
//! participants.

use super::packet::{Content, Entry};
use super::tag::Tag;
use super::{Alarm, Register};
use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;
use starl_core::{Destination, Duration, Robot, RobotId};

/// Around a list in a datagram, bytes at most; names may take the rest.
const FRAME_BYTES: usize = 60;

/// A robot that hears this many copies equal to its own announced in an interval does not announce its own.
const REDUNDANCY: u32 = 2;

/// The rhythm.
#[derive(Clone, Debug, Default)]
pub(super) struct Gossip {
    pub interval: Duration,
    /// Whether the timer was ever armed. It is rearmed whenever it fires.
    pub begun: bool,
    /// How many equal copies were announced in this interval.
    pub equal: u32,
    /// Whether copies were compared in this interval.
    pub compared: bool,
    /// From which register on they are compared next.
    pub after: Option<String>,
}

impl Register {
    /// Arms the timers that should be armed and are not.
    pub(super) fn keep_time(&mut self, robot: &mut Robot<'_>) {
        self.enter(robot);
        if !self.gossip.begun {
            self.gossip.begun = true;
            self.begin_interval(robot, self.options.intervals().0);
        }
    }

    /// Records that a copy changes now.
    pub(super) fn note_change(&mut self, robot: &mut Robot<'_>) {
        let (shortest, _) = self.options.intervals();
        if self.gossip.interval > shortest {
            self.begin_interval(robot, shortest);
        }
    }

    fn begin_interval(&mut self, robot: &mut Robot<'_>, interval: Duration) {
        self.gossip.interval = interval;
        self.gossip.equal = 0;
        self.gossip.compared = false;
        let after = interval.seconds() * robot.random().between(0.5, 1.0);
        let after = Duration::from_seconds_f64(after);
        robot.set_timer(self.timer(Alarm::Gossip), after);
    }

    /// Announces the copies, if not enough others have announced the same.
    pub(super) fn announce(&mut self, robot: &mut Robot<'_>) {
        self.set_right(robot);
        if self.gossip.equal < REDUNDANCY {
            let announcement = Content::Announcement(self.replica.fingerprint());
            self.send(robot, Destination::All, announcement);
        }
        let (shortest, longest) = self.options.intervals();
        let next = self.gossip.interval.min(longest) * 2;
        self.begin_interval(robot, next.max(shortest).min(longest));
    }

    /// Handles another robot's announcement of its copies.
    pub(super) fn gossip(&mut self, robot: &mut Robot<'_>, from: RobotId, content: Content) {
        match content {
            Content::Announcement(theirs) if theirs == self.replica.fingerprint() => {
                self.gossip.equal = self.gossip.equal.saturating_add(1);
            }
            Content::Announcement(_) => self.compare_with(robot, from),
            Content::Comparison { after, last, tags } => {
                self.compare(robot, from, after.as_deref(), last.as_deref(), tags);
            }
            Content::Entries(entries) => {
                for entry in &entries {
                    self.merge(robot, entry);
                }
            }
            Content::Wanted(names) => {
                self.send_entries(robot, from, &names);
            }
            _ => {}
        }
    }

    /// Shows another robot the tags of copies, one datagram of them at a time.
    fn compare_with(&mut self, robot: &mut Robot<'_>, peer: RobotId) {
        if self.gossip.compared {
            return;
        }
        self.gossip.compared = true;
        let after = self.gossip.after.take();
        let (tags, last) = self.replica.tags_after(after.as_deref(), self.room());
        self.gossip.after = last.clone();
        let comparison = Content::Comparison { after, last, tags };
        self.send(robot, Destination::Robot(peer), comparison);
    }

    /// Sends what another robot lacks, and asks for what this one lacks.
    fn compare(
        &mut self,
        robot: &mut Robot<'_>,
        from: RobotId,
        after: Option<&str>,
        last: Option<&str>,
        tags: Vec<(String, Tag)>,
    ) {
        let theirs: BTreeMap<String, Tag> = tags.into_iter().collect();
        let mut room = self.room();
        let mut wanted = Vec::new();
        for (name, tag) in &theirs {
            let own = self.replica.get(name).map(|version| version.tag);
            let bytes = name.len() + Tag::BYTES;
            if own < Some(*tag) && tag.is_valid() && bytes <= room {
                room -= bytes;
                wanted.push(name.clone());
            }
        }
        let is_newer = |name: &&str| {
            let own = self.replica.get(name).map(|version| version.tag);
            own > theirs.get(*name).copied()
        };
        let newer = self.replica.names_between(after, last).filter(is_newer);
        let newer: Vec<String> = newer.map(String::from).collect();
        self.send_entries(robot, from, &newer);
        if !wanted.is_empty() {
            self.send(robot, Destination::Robot(from), Content::Wanted(wanted));
        }
    }

    /// Sends copies, as many as one datagram takes but at least one.
    fn send_entries(&mut self, robot: &mut Robot<'_>, to: RobotId, names: &[String]) {
        let mut room = self.room();
        let mut entries: Vec<Entry> = Vec::new();
        for entry in names.iter().filter_map(|name| self.replica.entry(name)) {
            if entry.bytes() > room && !entries.is_empty() {
                break;
            }
            room = room.saturating_sub(entry.bytes());
            entries.push(entry);
        }
        if !entries.is_empty() {
            self.send(robot, Destination::Robot(to), Content::Entries(entries));
        }
    }

    fn room(&self) -> usize {
        self.options.longest_datagram.saturating_sub(FRAME_BYTES)
    }

    /// Corrects a state that only a corruption can cause.
    fn set_right(&mut self, robot: &mut Robot<'_>) {
        self.replica.refresh();
        let (fleet, participants) = (robot.fleet(), self.participants.as_ref());
        self.lives.refresh(|who| match participants {
            Some(participants) => participants.contains(&who),
            None => fleet.binary_search(&who).is_ok(),
        });
        let numbers: Vec<u32> = self.operations.keys().copied().collect();
        for number in numbers {
            let latest = self.operations.get(&number).and_then(|o| o.latest.as_ref());
            if latest.is_some_and(|version| !version.is_valid()) {
                self.begin_again(robot, number);
            }
        }
    }
}
