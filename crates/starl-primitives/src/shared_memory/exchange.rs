//! What memories tell each other, and when.
//!
//! A write goes to all in the datagrams of its activation. Robots announce what their memories amount to
//! ([`super::gossip`]); who has heard of another one when its own announcement is due goes on to
//! compare it with that robot ([`super::compare`]). What either lacks goes to all, since others may
//! lack it too.

use super::compare::{self, Difference};
use super::packet::{Announcement, Content, Datagram, FRAME_BYTES, KEY_BYTES, Part, Range, Write};
use super::store::{Address, Element, Merged};
use super::{GOSSIP_TIMER, LONGEST_NAME, REPAIR_TIMER, SharedMemory, report};
use alloc::borrow::ToOwned;
use alloc::vec::Vec;
use starl_core::{Destination, Duration, Message, Robot, RobotId};

/// Repairs go out in bursts of this many datagrams,
const REPAIR_BURST: usize = 4;

/// with this pause between: 480 kB/s at most with datagrams of the default length.
const REPAIR_PAUSE: Duration = Duration::from_millis(10);

/// So often in a row a difference calls for haste while comparing changes nothing here: it may be one
/// that the network does not let pass.
const MOST_VAIN: u32 = 32;

/// At most this many datagrams of a kind answer one, so that a comparison in up to five steps does not
/// grow into a flood; what they leave out is found in a later comparison.
const MOST_ANSWERS: usize = 2;

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
        let mut writes = writes.into_iter().peekable();
        while writes.peek().is_some() {
            let content = self.pack(&mut writes, Write::bytes);
            self.send(robot, Destination::All, Content::Elements(content));
        }
    }

    /// Announces the memory, if not enough others have announced the same; goes on to compare it with
    /// one that differs.
    pub(super) fn announce(&mut self, robot: &mut Robot<'_>) {
        let now = robot.now();
        self.store.refresh(now);
        if self.gossip.equal < self.options.redundancy.max(1) {
            let announcement = Announcement {
                fingerprint: self.store.fingerprint(),
                elements: self.store.len() as u32,
                settled: self.is_settled(robot),
            };
            self.send(robot, Destination::All, Content::Announcement(announcement));
            if let Some(peer) = self.gossip.differing {
                let whole = compare::describe(&self.store, Range::ALL);
                self.send_parts(robot, peer, whole.into_iter().collect());
            }
        }
        let after = self.gossip.next(&self.options, robot.random());
        robot.set_timer(self.timer(GOSSIP_TIMER), after);
    }

    /// Sends some of what others lack.
    pub(super) fn repair(&mut self, robot: &mut Robot<'_>) {
        let now = robot.now();
        self.repair_due = None;
        for _ in 0..REPAIR_BURST {
            let lacked = self.repairs.iter().filter_map(|&key| self.store.at(key));
            let lacked = lacked.filter(|element| element.is_valid());
            let mut lacked = lacked.map(write).peekable();
            if lacked.peek().is_none() {
                self.repairs.clear();
                return;
            }
            let writes = self.pack(&mut lacked, Write::bytes);
            for write in &writes {
                let key = address(write).key();
                self.repairs.remove(&key);
                if let Some(element) = self.store.at_mut(key) {
                    element.touched = now;
                }
            }
            self.send(robot, Destination::All, Content::Elements(writes));
        }
    }

    /// Arms the timers that should be armed and are not.
    pub(super) fn keep_time(&mut self, robot: &mut Robot<'_>) {
        let now = robot.now();
        if !self.gossip.begun {
            report::start(robot, self.port);
            self.hurry(robot);
        }
        let pending = |due| due <= now + REPAIR_PAUSE && due + REPAIR_PAUSE >= now;
        if !self.repairs.is_empty() && !self.repair_due.is_some_and(pending) {
            self.repair_due = Some(now + REPAIR_PAUSE);
            robot.set_timer(self.timer(REPAIR_TIMER), REPAIR_PAUSE);
        }
    }

    /// Takes a datagram. What is not one of ours is ignored.
    pub(super) fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let from = message.from;
        let is_peer = from != robot.id() && robot.fleet().binary_search(&from).is_ok();
        let Some(datagram) = message.read::<Datagram<Content>>() else {
            return;
        };
        if !is_peer || !datagram.clock.is_valid() {
            return;
        }
        self.clock.observe(datagram.clock);
        match datagram.content {
            Content::Elements(writes) => self.merge(robot, writes),
            Content::Announcement(theirs) => self.heard(robot, from, theirs),
            Content::Comparison(parts) => self.compare(robot, from, &parts),
            Content::Wanted(keys) => {
                let known = keys.into_iter().filter(|&key| self.store.at(key).is_some());
                self.repairs.extend(known);
            }
        }
    }

    /// Takes note that the memory changes now.
    pub(super) fn note_change(&mut self, robot: &mut Robot<'_>) {
        let now = robot.now();
        let was_quiet = now.since(self.changed) >= self.options.quiet();
        self.changed = now;
        self.gossip.vain = 0;
        if was_quiet && self.gossip.is_slow(&self.options) {
            self.hurry(robot);
        }
    }

    fn merge(&mut self, robot: &mut Robot<'_>, writes: Vec<Write>) {
        let now = robot.now();
        for write in writes {
            let is_ours = write.variable.len() <= LONGEST_NAME
                && write.value.len() <= self.options.longest_value
                && write.stamp.clock().is_valid();
            if is_ours {
                self.merge_one(robot, element(write, now));
            }
        }
    }

    fn merge_one(&mut self, robot: &mut Robot<'_>, element: Element) {
        let now = robot.now();
        let key = element.address.key();
        let stamp = element.stamp;
        self.clock.observe(stamp.clock());
        match self
            .store
            .merge(element, robot.id(), self.options.most_elements)
        {
            Merged::Applied => {
                self.note_change(robot);
                self.repairs.remove(&key);
                if let Some(element) = self.store.at(key) {
                    report::element(robot, self.port, "update", element);
                }
            }
            Merged::Known => {
                self.repairs.remove(&key);
                if let Some(element) = self.store.at_mut(key) {
                    element.touched = now;
                }
            }
            Merged::FromEarlierLife => {
                if let Some(present) = self.store.at(key) {
                    let (address, value) = (present.address.clone(), present.value.clone());
                    self.put(robot, key, address, value, "write_again");
                }
            }
            Merged::Older | Merged::Refused => {}
        }
    }

    /// Takes note of another memory.
    fn heard(&mut self, robot: &mut Robot<'_>, from: RobotId, theirs: Announcement) {
        let is_equal = theirs.fingerprint == self.store.fingerprint()
            && theirs.elements == self.store.len() as u32;
        if is_equal {
            self.gossip.equal = self.gossip.equal.saturating_add(1);
            return;
        }
        self.gossip.differing = Some(from);
        // Otherwise a write may be on its way.
        let is_lasting = theirs.settled && self.is_settled(robot);
        if is_lasting && self.gossip.is_slow(&self.options) && self.gossip.vain < MOST_VAIN {
            self.gossip.vain += 1;
            self.hurry(robot);
        }
    }

    fn compare(&mut self, robot: &mut Robot<'_>, from: RobotId, parts: &[Part]) {
        let settled = robot.now() - self.options.settling();
        let Difference {
            parts,
            newer,
            wanted,
        } = compare::compare(&self.store, parts, settled);
        self.repairs.extend(newer);
        self.send_parts(robot, from, parts);
        let mut wanted = wanted.into_iter().peekable();
        for _ in 0..MOST_ANSWERS {
            if wanted.peek().is_some() {
                let keys = self.pack(&mut wanted, |_| KEY_BYTES);
                self.send(robot, Destination::Robot(from), Content::Wanted(keys));
            }
        }
    }

    fn send_parts(&self, robot: &mut Robot<'_>, to: RobotId, parts: Vec<Part>) {
        let mut parts = parts.into_iter().peekable();
        for _ in 0..MOST_ANSWERS {
            if parts.peek().is_some() {
                let packed = self.pack(&mut parts, Part::bytes);
                self.send(robot, Destination::Robot(to), Content::Comparison(packed));
            }
        }
    }

    /// Compares memories soon.
    fn hurry(&mut self, robot: &mut Robot<'_>) {
        let after = self.gossip.begin(&self.options, robot.random());
        robot.set_timer(self.timer(GOSSIP_TIMER), after);
    }

    /// Whether nothing has changed for so long that no write should be on its way.
    fn is_settled(&self, robot: &Robot<'_>) -> bool {
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
    }
}

fn address(write: &Write) -> Address {
    Address {
        variable: write.variable.as_str().into(),
        owner: write.single_writer.then_some(write.stamp.writer),
    }
}

fn element(write: Write, now: starl_core::Time) -> Element {
    Element {
        address: address(&write),
        stamp: write.stamp,
        value: write.value,
        mine: false,
        touched: now,
    }
}
