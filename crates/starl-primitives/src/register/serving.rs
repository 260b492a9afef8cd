//! A participant's answers, and the spread of copies and lives.
//!
//! Invariant: only a participant that is up answers, and it has everything that it has acknowledged.

use super::entering::Standing;
use super::packet::{Content, Datagram, Entry, PageEntry};
use super::tag::Tag;
use super::version::Version;
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
                let version = self.replica.get(&register).map(|version| match is_read {
                    true => version.clone(),
                    false => Version {
                        tag: version.tag,
                        ..Version::default()
                    },
                });
                Content::Value {
                    id,
                    claimed: None,
                    promised: self.replica.promised(&register),
                    version,
                }
            }
            Content::Claim {
                id,
                register,
                ballot,
            } => match self.promise(&register, ballot) {
                Ok(promised) => Content::Value {
                    id,
                    claimed: Some(ballot),
                    promised,
                    version: self.replica.get(&register).cloned(),
                },
                Err(promised) => match promised {
                    Some(promised) => Content::Refused {
                        id,
                        tag: ballot,
                        promised,
                    },
                    None => return, // There is no room for it, or no robot can have claimed it.
                },
            },
            Content::Store { id, entry } => {
                let tag = entry.version.tag;
                match self.store(robot, &entry) {
                    Ok(()) => Content::Stored { id, tag },
                    Err(Some(promised)) => Content::Refused { id, tag, promised },
                    Err(None) => return, // There is no room for it, or no write can have led to it.
                }
            }
            _ => return,
        };
        self.send(robot, Destination::Robot(from), answer);
    }

    /// Promises a ballot and returns the earlier promise. Otherwise returns the greater promised ballot, if that is the
    /// reason.
    pub(super) fn promise(
        &mut self,
        register: &str,
        ballot: Tag,
    ) -> Result<Option<Tag>, Option<Tag>> {
        let before = self.replica.promised(register);
        let is_ours = ballot.is_valid() && register.len() <= LONGEST_NAME;
        let most = self.options.most_registers;
        match is_ours && self.replica.promise(register, ballot, most) {
            true => Ok(before),
            false => Err(before.filter(|before| *before > ballot)),
        }
    }

    /// Stores a copy, so that it can be acknowledged. Otherwise returns the promised ballot, if that is the reason.
    pub(super) fn store(
        &mut self,
        robot: &mut Robot<'_>,
        entry: &Entry,
    ) -> Result<(), Option<Tag>> {
        let (register, tag) = (&entry.register, entry.version.tag);
        if let Some(promised) = self.replica.promised(register)
            && promised > tag
        {
            return Err(Some(promised));
        }
        self.merge(robot, entry);
        let stored = self.replica.get(register);
        match stored.is_some_and(|version| version.tag >= tag) {
            true => Ok(()),
            false => Err(None),
        }
    }

    /// Merges the copies and promises of another participant.
    pub(super) fn take_over(&mut self, robot: &mut Robot<'_>, entry: PageEntry) {
        let PageEntry {
            register,
            promised,
            version,
        } = entry;
        if let Some(promised) = promised {
            // A greater one may have come from another participant.
            let _ = self.promise(&register, promised);
        }
        if let Some(version) = version {
            self.merge(robot, &Entry { register, version });
        }
    }

    /// Merges a copy.
    pub(super) fn merge(&mut self, robot: &mut Robot<'_>, entry: &Entry) {
        let length = entry.version.value.as_ref().map_or(0, |value| value.len());
        let is_ours = entry.version.is_valid()
            && entry.register.len() <= LONGEST_NAME
            && length <= self.options.longest_value;
        if is_ours && self.replica.merge(entry, self.options.most_registers) {
            self.note_change(robot);
        }
    }

    /// Learns the lives in a datagram.
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
        // An earlier incarnation of this robot that never answered, or a corruption, has a greater number.
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
