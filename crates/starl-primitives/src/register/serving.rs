//! What a participant answers, and how copies and lives become known.
//!
//! Invariant: only a participant that is up answers, and what it has acknowledged it has.

use super::entering::Standing;
use super::packet::{Content, Datagram, Entry};
use super::{LONGEST_NAME, Register};
use alloc::vec::Vec;
use starl_core::{Destination, Robot, RobotId};

impl Register {
    /// Answers a question about a copy.
    pub(super) fn serve(&mut self, robot: &mut Robot<'_>, from: RobotId, content: Content) {
        if !self.is_up() {
            return;
        }
        let answer = match content {
            Content::Query {
                id,
                register,
                is_read,
            } => {
                let copy = self.replica.get(&register);
                let tag = copy.map(|(tag, _)| *tag);
                let value = copy.filter(|_| is_read).map(|(_, value)| value.clone());
                let value = value.unwrap_or_default();
                Content::Value { id, tag, value }
            }
            Content::Store { id, entry } => {
                self.merge(robot, &entry);
                let copy = self.replica.get(&entry.register);
                if copy.is_none_or(|(tag, _)| *tag < entry.tag) {
                    return; // There is no room for it, or no write can have led to it.
                }
                Content::Stored { id }
            }
            _ => return,
        };
        self.send(robot, Destination::Robot(from), answer);
    }

    /// Takes in a copy.
    pub(super) fn merge(&mut self, robot: &mut Robot<'_>, entry: &Entry) {
        let is_ours = entry.tag.is_valid()
            && entry.register.len() <= LONGEST_NAME
            && entry.value.len() <= self.options.longest_value;
        if is_ours && self.replica.merge(entry, self.options.most_registers) {
            self.note_change(robot);
        }
    }

    /// Takes note of the lives that a datagram tells of.
    pub(super) fn learn_lives(
        &mut self,
        robot: &mut Robot<'_>,
        from: RobotId,
        datagram: &Datagram,
    ) {
        let own = [(from, datagram.life)];
        for &(who, life) in datagram.lives.iter().chain(&own) {
            if self.is_member(robot, who) {
                self.lives.learn(who, life);
            }
        }
        // A life of this robot's that never came to answer, or a corruption, has gone further.
        let latest = self.lives.of(robot.id());
        if let Standing::Up(life) = &mut self.standing
            && *life < latest
        {
            *life = latest;
            let numbers: Vec<u32> = self.operations.keys().copied().collect();
            for number in numbers {
                self.answer_own(robot, number);
            }
        }
    }
}
