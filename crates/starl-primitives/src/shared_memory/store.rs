//! One robot's copy of the memory.
//!
//! Each element is a last-writer-wins register (Shapiro, Preguiça, Baquero, Zawirski 2011, "A
//! comprehensive study of Convergent and Commutative Replicated Data Types"). Stamp, then value, is a
//! total order on writes, so merging is commutative, associative and idempotent whatever the elements
//! contain, and copies that have seen the same writes are equal, even those that began as garbage.
//! Elements are sorted by 64-bit keys, the hashes of their addresses. Every range of keys has a
//! fingerprint, the sum of the hashes of its elements, by which copies are compared.

use super::packet::{Dependency, Write};
use super::stamp::Stamp;
use alloc::collections::BTreeMap;
use alloc::sync::Arc;
use alloc::vec::Vec;
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
    fn is(&self, variable: &str, owner: Option<RobotId>) -> bool {
        self.owner == owner && *self.variable == *variable
    }
}

/// Where an address lies in the memory.
pub(super) fn key(variable: &str, owner: Option<RobotId>) -> u64 {
    let mut digest = Digest::default();
    digest.bytes(variable.as_bytes());
    digest.word(owner.map_or(0, |owner| u64::from(owner.0) + 1));
    hash_key(digest.value(), &[])
}

/// The element at an address, under the key of the address.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Element {
    pub key: u64,
    pub address: Address,
    pub stamp: Stamp,
    pub value: Payload,
    /// Its dependencies; none for a variable that is not causal.
    pub depends: Option<Vec<Dependency>>,
    /// Whether this robot wrote it since it started.
    pub mine: bool,
    /// When it last changed or was last seen on its way to all, by the robot's own clock.
    pub touched: Time,
}

impl Element {
    /// The hash of address, stamp and value for fingerprints.
    pub fn hash(&self) -> u64 {
        let mut digest = Digest::default();
        digest.word(self.key);
        digest.word(self.stamp.time.0);
        digest.word(u64::from(self.stamp.count) << 32 | u64::from(self.stamp.writer.0));
        digest.word(self.stamp.incarnation.into());
        digest.bytes(&self.value);
        hash_key(digest.value(), &[])
    }

    /// Whether writes can have produced it: its stamp is possible, and it is by its owner. Only a
    /// corruption leaves other elements behind; they are neither sent nor kept for long.
    pub fn is_valid(&self) -> bool {
        let writer = self.stamp.writer;
        self.stamp.clock().is_valid() && self.address.owner.is_none_or(|owner| owner == writer)
    }

    /// Whether this robot wrote it since it started.
    pub fn is_mine(&self, me: RobotId) -> bool {
        self.mine && self.stamp.writer == me && self.is_valid()
    }
}

/// The result of merging an element.
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
    /// The memory is full.
    Refused,
}

/// The copy.
#[derive(Clone, Debug, Default)]
pub(super) struct Store {
    elements: BTreeMap<u64, Element>,
    /// The elements of arrays, by owner.
    arrays: BTreeMap<Arc<str>, BTreeMap<RobotId, u64>>,
    /// The fingerprint of all.
    fingerprint: u64,
}

impl Store {
    pub fn len(&self) -> usize {
        self.elements.len()
    }

    pub fn get(&self, variable: &str, owner: Option<RobotId>) -> Option<&Element> {
        let element = self.elements.get(&key(variable, owner))?;
        element.address.is(variable, owner).then_some(element)
    }

    pub fn at(&self, key: u64) -> Option<&Element> {
        self.elements.get(&key)
    }

    pub fn at_mut(&mut self, key: u64) -> Option<&mut Element> {
        self.elements.get_mut(&key)
    }

    /// The elements of an array, in the order of their owners.
    pub fn array(&self, variable: &str) -> impl Iterator<Item = (RobotId, &Element)> {
        let array = self.arrays.get_key_value(variable);
        array.into_iter().flat_map(|(variable, keys)| {
            keys.iter().filter_map(|(&owner, key)| {
                let element = self.elements.get(key)?;
                let address = &element.address;
                let is_same =
                    Arc::ptr_eq(&address.variable, variable) || address.variable == *variable;
                (is_same && address.owner == Some(owner)).then_some((owner, element))
            })
        })
    }

    /// The address of these names.
    pub fn address(&self, variable: &str, owner: Option<RobotId>) -> Address {
        let known = self.arrays.get_key_value(variable);
        let variable = known.map_or_else(|| Arc::from(variable), |(known, _)| known.clone());
        Address { variable, owner }
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

    /// Recomputes the values derived from the elements, and removes remains of a corruption: elements
    /// that are invalid, were touched in the future, or depend on values that are not shown.
    pub fn refresh(&mut self, now: Time) {
        self.elements.retain(|_, element| element.is_valid());
        let mut has_causal = false;
        for element in self.elements.values_mut() {
            element.touched = element.touched.min(now);
            has_causal |= element.depends.is_some();
        }
        if has_causal {
            self.drop_uncovered();
        }
        self.fingerprint = fingerprint(self.elements.values());
    }

    /// Forgets dependencies that are not covered by what is shown.
    fn drop_uncovered(&mut self) {
        let causal = self.elements.iter();
        let causal = causal.filter(|(_, element)| element.depends.is_some());
        let shown: BTreeMap<u64, Stamp> = causal.map(|(&key, e)| (key, e.stamp)).collect();
        for depends in self.elements.values_mut().flat_map(|e| &mut e.depends) {
            depends.retain(|needed| {
                let shown = shown.get(&needed.key);
                shown.is_some_and(|&stamp| stamp >= needed.stamp)
            });
        }
    }

    /// The fingerprint of all elements, to be overwritten.
    pub fn fingerprint_mut(&mut self) -> &mut u64 {
        &mut self.fingerprint
    }

    /// Merges a write from another robot; returns the key.
    pub fn merge(&mut self, write: Write, me: RobotId, now: Time, most: usize) -> (u64, Merged) {
        let owner = write.single_writer.then_some(write.stamp.writer);
        let key = key(&write.variable, owner);
        if let Some(present) = self.elements.get(&key) {
            let merged = compare(present, &write, owner, me);
            if merged != Merged::Applied {
                return (key, merged);
            }
        } else if self.elements.len() >= most {
            return (key, Merged::Refused);
        }
        self.put(Element {
            key,
            address: self.address(&write.variable, owner),
            stamp: write.stamp,
            value: write.value,
            depends: write.depends,
            mine: false,
            touched: now,
        });
        (key, Merged::Applied)
    }

    /// Sets an element, replacing any other.
    pub fn put(&mut self, element: Element) {
        self.fingerprint = self.fingerprint.wrapping_add(element.hash());
        let key = element.key;
        let address = element.address.clone();
        if let Some(before) = self.elements.insert(key, element) {
            self.fingerprint = self.fingerprint.wrapping_sub(before.hash());
            if before.address == address {
                return;
            }
        }
        if let Some(owner) = address.owner {
            let array = self.arrays.entry(address.variable).or_default();
            array.insert(owner, key);
        }
    }
}

/// The decision about a write where there is an element with its key.
fn compare(present: &Element, write: &Write, owner: Option<RobotId>, me: RobotId) -> Merged {
    if !present.address.is(&write.variable, owner) {
        // Two addresses with the same key: the lesser is kept, on all robots alike.
        let Address {
            variable,
            owner: other,
        } = &present.address;
        let is_less = (&*write.variable, owner) < (&**variable, *other);
        return if is_less {
            Merged::Applied
        } else {
            Merged::Refused
        };
    }
    if !present.is_valid() {
        return Merged::Applied;
    }
    match (write.stamp, &write.value).cmp(&(present.stamp, &present.value)) {
        Ordering::Less => Merged::Older,
        Ordering::Equal => Merged::Known,
        Ordering::Greater if write.stamp.writer == me && present.is_mine(me) => {
            Merged::FromEarlierLife
        }
        Ordering::Greater => Merged::Applied,
    }
}

/// The sum of the elements' hashes.
pub(super) fn fingerprint<'a>(elements: impl Iterator<Item = &'a Element>) -> u64 {
    elements.fold(0, |sum, element| sum.wrapping_add(element.hash()))
}
