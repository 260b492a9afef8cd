//! A memory's reaction to messages of others.

use super::compare::{self, Difference};
use super::packet::{Announcement, Content, Datagram, Part, Write};
use super::store::Merged;
use super::{LONGEST_NAME, SharedMemory, report};
use alloc::vec::Vec;
use starl_core::event::SharedMemoryEvent;
use starl_core::{Message, Robot, RobotId};

/// So often in a row a difference calls for haste while comparing changes nothing here: it may be one
/// that the network does not let pass.
const MOST_VAIN: u32 = 32;

impl SharedMemory {
    /// Handles a datagram. Unknown datagrams are ignored.
    pub(super) fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let from = message.from;
        let is_peer = robot.is_peer(from);
        let Some(datagram) = message.read::<Datagram<Content>>() else {
            return;
        };
        if !is_peer || !datagram.clock.is_valid() {
            return;
        }
        self.clock.observe(datagram.clock);
        match datagram.content {
            Content::Elements(writes) => self.merge(robot, writes),
            Content::Causal(writes) => {
                let writes = writes.into_iter().map(|(write, depends)| Write {
                    depends: Some(depends),
                    ..write
                });
                self.merge(robot, writes.collect());
            }
            Content::Announcement(theirs) => self.heard(robot, from, theirs),
            Content::Comparison(parts) => {
                self.gossip.is_answered_by(from);
                self.gossip.is_compared_by(from);
                self.compare(robot, from, &parts);
            }
            Content::Wanted(keys) => {
                self.gossip.is_answered_by(from);
                let known = keys.into_iter().filter(|&key| self.store.at(key).is_some());
                self.repairs.extend(known);
            }
        }
    }

    fn merge(&mut self, robot: &mut Robot<'_>, writes: Vec<Write>) {
        for write in writes {
            let is_ours = write.variable.len() <= LONGEST_NAME
                && write.value.len() <= self.options.longest_value
                && write.stamp.clock().is_valid();
            if is_ours {
                self.clock.observe(write.stamp.clock());
                if let Some(write) = self.hold(write, robot.now()) {
                    self.merge_one(robot, write);
                }
            }
        }
        for write in self.take_released() {
            self.merge_one(robot, write);
        }
    }

    fn merge_one(&mut self, robot: &mut Robot<'_>, write: Write) {
        let now = robot.now();
        let most = self.options.most_elements;
        let (key, merged) = self.store.merge(write, robot.id(), now, most);
        match merged {
            Merged::Applied => {
                self.note_change(robot);
                self.repairs.remove(&key);
                if let Some(element) = self.store.at(key) {
                    let written = report::written(element);
                    robot.report(self.port, SharedMemoryEvent::Update { written });
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
                    self.put(robot, key, address, value, |written| {
                        SharedMemoryEvent::WriteAgain { written }
                    });
                }
            }
            Merged::Older | Merged::Refused => {}
        }
    }

    /// Records another memory.
    fn heard(&mut self, robot: &mut Robot<'_>, from: RobotId, theirs: Announcement) {
        let is_equal = theirs.fingerprint == self.store.fingerprint()
            && theirs.elements == self.store.len() as u32;
        self.gossip.hear_unasked(theirs.unasked);
        if is_equal || theirs.compared.contains(&robot.id()) {
            self.gossip.is_answered_by(from);
        }
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
        self.send_wanted(robot, from, wanted);
    }
}
