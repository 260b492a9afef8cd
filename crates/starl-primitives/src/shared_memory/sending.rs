//! The messages of a memory to others, and their times.
//!
//! A write goes to all in the datagrams of its activation. Robots announce the fingerprints of their
//! memories ([`super::gossip`]). A robot that has heard of a different one when its own announcement is
//! due compares its memory with that robot's ([`super::compare`]). The missing elements of either go to
//! all, because others may lack them too.

use super::compare;
use super::gossip::FARTHEST;
use super::packet::{Announcement, Content, Datagram, FRAME_BYTES, KEY_BYTES, Part, Range, Write};
use super::store::Element;
use super::{Alarm, SharedMemory};
use alloc::borrow::ToOwned;
use alloc::vec::Vec;
use starl_core::event::SharedMemoryEvent;
use starl_core::{Destination, Duration, Robot, RobotId};

/// Repairs go out in bursts of this many datagrams,
const REPAIR_BURST: usize = 4;

/// with this pause between: 480 kB/s at most with datagrams of the default length.
const REPAIR_PAUSE: Duration = Duration::from_millis(10);

/// At most this many datagrams of a kind answer one, so that a comparison in up to five steps does not
/// grow into a flood; what they leave out is found in a later comparison.
const MOST_ANSWERS: usize = 2;

/// The number of elements that go out unasked with an announcement.
const UNASKED: usize = 64;

impl SharedMemory {
    /// Sends what this robot has written.
    pub(super) fn flush(&mut self, robot: &mut Robot<'_>) {
        if self.unsent.is_empty() {
            return;
        }
        let written = core::mem::take(&mut self.unsent);
        let written = written.iter().filter_map(|&key| self.store.at(key));
        let written = written.filter(|element| element.is_mine(robot.id()));
        let writes: Vec<Write> = written.map(write).collect();
        let (causal, plain): (Vec<Write>, Vec<Write>) = writes
            .into_iter()
            .partition(|write| write.depends.is_some());
        for writes in [plain, causal] {
            let mut writes = writes.into_iter().peekable();
            while writes.peek().is_some() {
                let packed = self.pack(&mut writes, Write::bytes);
                self.send_writes(robot, packed);
            }
        }
    }

    /// Sends elements to all. Those of causal variables go by themselves.
    fn send_writes(&self, robot: &mut Robot<'_>, writes: Vec<Write>) {
        let (mut plain, mut causal) = (Vec::new(), Vec::new());
        for mut write in writes {
            match write.depends.take() {
                Some(depends) => causal.push((write, depends)),
                None => plain.push(write),
            }
        }
        if !plain.is_empty() {
            self.send(robot, Destination::All, Content::Elements(plain));
        }
        if !causal.is_empty() {
            self.send(robot, Destination::All, Content::Causal(causal));
        }
    }

    /// Announces the memory, unless enough others have announced the same; starts the comparison with one that differs.
    pub(super) fn announce(&mut self, robot: &mut Robot<'_>) {
        let now = robot.now();
        self.store.refresh(now);
        let differing = self.gossip.differing.take();
        let differing = differing.filter(|peer| robot.fleet().binary_search(peer).is_ok());
        if self.gossip.equal < self.options.redundancy.max(1) || self.gossip.unasked > 0 {
            if let Some(peer) = differing {
                self.gossip.compare_with(peer);
            }
            let announcement = Announcement {
                fingerprint: self.store.fingerprint(),
                elements: self.store.len() as u32,
                settled: self.is_settled(robot),
                unasked: self.gossip.unasked,
                compared: core::mem::take(&mut self.gossip.compared),
            };
            self.send(robot, Destination::All, Content::Announcement(announcement));
            if let Some(peer) = differing {
                let whole = compare::describe(&self.store, Range::ALL);
                self.send_parts(robot, peer, whole.into_iter().collect());
            }
            self.send_unasked();
        }
        let after = match self.ask(robot) {
            true => self.gossip.begin(&self.options, robot.random()),
            false => self.gossip.next(&self.options, robot.random()),
        };
        robot.set_timer(self.timer(Alarm::Gossip), after);
    }

    /// If some robots cannot compare their memories, the next elements go to all.
    fn send_unasked(&mut self) {
        if self.gossip.unasked == 0 {
            return;
        }
        self.gossip.unasked = self.gossip.unasked.min(FARTHEST) - 1;
        let first = self.gossip.next;
        let rest = self.store.range(first..=u64::MAX);
        let others = self.store.range(0..=first.saturating_sub(1));
        let keys = rest.chain(others).map(|(key, _)| key).take(UNASKED);
        let keys: Vec<u64> = keys.collect();
        if let Some(last) = keys.last() {
            self.gossip.next = last.wrapping_add(1);
        }
        self.repairs.extend(keys);
    }

    /// Sends some elements that others lack.
    pub(super) fn repair(&mut self, robot: &mut Robot<'_>) {
        let now = robot.now();
        self.repair_due = None;
        for _ in 0..REPAIR_BURST {
            let lacked = self.repairs.iter().filter_map(|&key| self.store.at(key));
            let lacked = lacked.filter(|element| element.is_valid());
            let mut lacked = lacked
                .map(|element| (element.key, write(element)))
                .peekable();
            if lacked.peek().is_none() {
                self.repairs.clear();
                return;
            }
            let writes = self.pack(&mut lacked, |(_, write)| write.bytes());
            let (keys, writes): (Vec<u64>, Vec<Write>) = writes.into_iter().unzip();
            for key in keys {
                self.repairs.remove(&key);
                if let Some(element) = self.store.at_mut(key) {
                    element.touched = now;
                }
            }
            self.send_writes(robot, writes);
        }
    }

    /// Arms the timers that should be armed and are not.
    pub(super) fn keep_time(&mut self, robot: &mut Robot<'_>) {
        let now = robot.now();
        if !self.gossip.begun {
            robot.report(self.port, SharedMemoryEvent::Start);
            self.hurry(robot);
        }
        let pending = |due| due <= now + REPAIR_PAUSE && due + REPAIR_PAUSE >= now;
        if !self.repairs.is_empty() && !self.repair_due.is_some_and(pending) {
            self.repair_due = Some(now + REPAIR_PAUSE);
            robot.set_timer(self.timer(Alarm::Repair), REPAIR_PAUSE);
        }
    }

    /// Records that the memory changes now.
    pub(super) fn note_change(&mut self, robot: &mut Robot<'_>) {
        let now = robot.now();
        let was_quiet = now.since(self.changed) >= self.options.quiet();
        self.changed = now;
        self.gossip.vain = 0;
        if was_quiet && self.gossip.is_slow(&self.options) {
            self.hurry(robot);
        }
    }

    /// Shows another robot parts of this memory.
    pub(super) fn send_parts(&self, robot: &mut Robot<'_>, to: RobotId, parts: Vec<Part>) {
        let mut parts = parts.into_iter().peekable();
        for _ in 0..MOST_ANSWERS {
            if parts.peek().is_some() {
                let packed = self.pack(&mut parts, Part::bytes);
                self.send(robot, Destination::Robot(to), Content::Comparison(packed));
            }
        }
    }

    /// Asks another robot for its elements under these keys.
    pub(super) fn send_wanted(&self, robot: &mut Robot<'_>, to: RobotId, keys: Vec<u64>) {
        let mut keys = keys.into_iter().peekable();
        for _ in 0..MOST_ANSWERS {
            if keys.peek().is_some() {
                let packed = self.pack(&mut keys, |_| KEY_BYTES);
                self.send(robot, Destination::Robot(to), Content::Wanted(packed));
            }
        }
    }

    /// Compares memories soon.
    pub(super) fn hurry(&mut self, robot: &mut Robot<'_>) {
        let after = self.gossip.begin(&self.options, robot.random());
        robot.set_timer(self.timer(Alarm::Gossip), after);
    }

    /// Whether the last change is so long ago that no write should be in transit.
    pub(super) fn is_settled(&self, robot: &Robot<'_>) -> bool {
        self.changed <= robot.now() - self.options.settling()
    }

    /// As many as one datagram takes, but at least one.
    fn pack<T>(
        &self,
        things: &mut core::iter::Peekable<impl Iterator<Item = T>>,
        bytes: impl Fn(&T) -> usize,
    ) -> Vec<T> {
        let mut room = self.options.longest_datagram.saturating_sub(FRAME_BYTES);
        let mut packed = Vec::new();
        while let Some(next) = things.next_if(|next| packed.is_empty() || bytes(next) <= room) {
            room = room.saturating_sub(bytes(&next));
            packed.push(next);
        }
        packed
    }

    fn send(&self, robot: &mut Robot<'_>, to: Destination, content: Content) {
        let clock = self.clock.show(robot.now());
        robot.transmit(to, self.port, &Datagram { clock, content });
    }
}

fn write(element: &Element) -> Write {
    Write {
        variable: (*element.address.variable).to_owned(),
        single_writer: element.address.owner.is_some(),
        stamp: element.stamp,
        value: element.value.clone(),
        depends: element.depends.clone(),
    }
}
