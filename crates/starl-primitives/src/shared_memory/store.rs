//! One robot's copy of the memory.
//!
//! Each element is a last-writer-wins register (Shapiro, Preguiça, Baquero, Zawirski 2011, "A
//! comprehensive study of Convergent and Commutative Replicated Data Types"). What is kept of two
//! writes is a total order on stamp, then value: merging is commutative, associative and idempotent
//! whatever the elements hold, so copies that have seen the same writes are equal, even those that
//! began as garbage. Elements lie in the order of 64-bit keys, hashes of their addresses, and every range
//! of keys has a fingerprint, the sum of the hashes of its elements, by which copies are compared.

use super::stamp::Stamp;
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::sync::Arc;
use core::cmp::Ordering;
use core::ops::RangeInclusive;
use starl_core::random::hash_key;
use starl_core::{Digest, Payload, RobotId, Time};

/// Names a multi-writer variable or an element of a single-writer array. Both may carry the same name.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Address {
    pub variable: Arc<str>,
    /// The one robot that writes it; none for a multi-writer variable.
    pub owner: Option<RobotId>,
}

impl Address {
    pub fn key(&self) -> u64 {
        key(&self.variable, self.owner)
    }
}

/// Where an address lies in the memory.
pub(super) fn key(variable: &str, owner: Option<RobotId>) -> u64 {
    let mut digest = Digest::default();
    digest.bytes(variable.as_bytes());
    digest.word(owner.map_or(0, |owner| u64::from(owner.0) + 1));
    hash_key(digest.value(), &[])
}

/// What an address holds.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Element {
    pub address: Address,
    pub stamp: Stamp,
    pub value: Payload,
    /// Whether this robot wrote it since it started.
    pub mine: bool,
    /// When it last changed or was last seen on its way to all, by the robot's own clock.
    pub touched: Time,
}

impl Element {
    /// Stands for address, stamp and value in fingerprints.
    pub fn hash(&self) -> u64 {
        let mut digest = Digest::default();
        digest.word(self.address.key());
        digest.word(self.stamp.time.0);
        digest.word(u64::from(self.stamp.count) << 32 | u64::from(self.stamp.writer.0));
        digest.bytes(&self.value);
        hash_key(digest.value(), &[])
    }

    /// Whether it can have come about by writes: its stamp is one that clocks of ours give, and it is by
    /// its owner. Only a corruption leaves others behind; they are neither sent nor kept for long.
    pub fn is_valid(&self) -> bool {
        let writer = self.stamp.writer;
        self.stamp.clock().is_valid() && self.address.owner.is_none_or(|owner| owner == writer)
    }

    /// Whether this robot wrote it since it started.
    pub fn is_mine(&self, me: RobotId) -> bool {
        self.mine && self.stamp.writer == me && self.is_valid()
    }
}

/// What became of an element that was merged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Merged {
    /// It is what the memory now holds.
    Applied,
    /// The memory held it already.
    Known,
    /// The memory holds a later write.
    Older,
    /// It would win over what this robot wrote since it started, but is by this robot itself, so it is
    /// an earlier write, from before it started. The memory is as before.
    FromEarlierLife,
    /// There is no room for it.
    Refused,
}

/// The copy.
#[derive(Clone, Debug, Default)]
pub(super) struct Store {
    elements: BTreeMap<u64, Element>,
    owners: BTreeMap<Arc<str>, BTreeSet<RobotId>>,
    /// The fingerprint of all.
    fingerprint: u64,
}

impl Store {
    pub fn len(&self) -> usize {
        self.elements.len()
    }

    pub fn get(&self, variable: &str, owner: Option<RobotId>) -> Option<&Element> {
        let element = self.elements.get(&key(variable, owner))?;
        let address = &element.address;
        (*address.variable == *variable && address.owner == owner).then_some(element)
    }

    pub fn at(&self, key: u64) -> Option<&Element> {
        self.elements.get(&key)
    }

    pub fn at_mut(&mut self, key: u64) -> Option<&mut Element> {
        self.elements.get_mut(&key)
    }

    /// Who has written an element of the array, in the order of their numbers.
    pub fn owners(&self, variable: &str) -> impl Iterator<Item = RobotId> + '_ {
        self.owners.get(variable).into_iter().flatten().copied()
    }

    /// All elements, to be overwritten.
    pub fn all_mut(&mut self) -> impl Iterator<Item = &mut Element> {
        self.elements.values_mut()
    }

    /// The elements with keys in a range.
    pub fn range(&self, keys: RangeInclusive<u64>) -> impl Iterator<Item = (u64, &Element)> {
        self.elements
            .range(keys)
            .map(|(&key, element)| (key, element))
    }

    /// The fingerprint of all elements.
    pub fn fingerprint(&self) -> u64 {
        self.fingerprint
    }

    /// Computes afresh what follows from the elements, and sets right what only a corruption leaves
    /// behind: elements that are not valid, or were touched in the future.
    pub fn refresh(&mut self, now: Time) {
        self.elements.retain(|_, element| element.is_valid());
        for element in self.elements.values_mut() {
            element.touched = element.touched.min(now);
        }
        self.fingerprint = fingerprint(self.elements.values());
    }

    /// The fingerprint of all elements, to be overwritten.
    pub fn fingerprint_mut(&mut self) -> &mut u64 {
        &mut self.fingerprint
    }

    /// Takes in an element that came from another robot.
    pub fn merge(&mut self, element: Element, me: RobotId, most: usize) -> Merged {
        let key = element.address.key();
        if let Some(present) = self.elements.get(&key) {
            // Two addresses with the same key: the lesser is kept, on all robots alike.
            match element.address.cmp(&present.address) {
                Ordering::Greater => return Merged::Refused,
                Ordering::Equal if present.is_valid() => {
                    match (element.stamp, &element.value).cmp(&(present.stamp, &present.value)) {
                        Ordering::Less => return Merged::Older,
                        Ordering::Equal => return Merged::Known,
                        Ordering::Greater => {}
                    }
                    if element.stamp.writer == me && present.is_mine(me) {
                        return Merged::FromEarlierLife;
                    }
                }
                _ => {}
            }
        } else if self.elements.len() >= most {
            return Merged::Refused;
        }
        self.put(key, element);
        Merged::Applied
    }

    /// Sets an element, whatever was there.
    pub fn put(&mut self, key: u64, element: Element) {
        self.fingerprint = self.fingerprint.wrapping_add(element.hash());
        if let Some(owner) = element.address.owner {
            let variable = &element.address.variable;
            match self.owners.get_mut(variable) {
                Some(owners) => {
                    owners.insert(owner);
                }
                None => {
                    let owners = BTreeSet::from([owner]);
                    self.owners.insert(variable.clone(), owners);
                }
            }
        }
        if let Some(before) = self.elements.insert(key, element) {
            self.fingerprint = self.fingerprint.wrapping_sub(before.hash());
        }
    }
}

/// The sum of the elements' hashes.
pub(super) fn fingerprint<'a>(elements: impl Iterator<Item = &'a Element>) -> u64 {
    elements.fold(0, |sum, element| sum.wrapping_add(element.hash()))
}
