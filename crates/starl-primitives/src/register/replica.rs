//! One robot's copies of the registers, and its promises about them.
//!
//! Invariant: the tag of a copy and the promised ballot only grow. Copies of equal tags hold equal values, unless a
//! corruption changed one; then the greater value is kept, by all alike.

use super::packet::{Entry, Page, PageEntry};
use super::tag::Tag;
use super::version::Version;
use alloc::borrow::ToOwned;
use alloc::boxed::Box;
use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;
use core::ops::Bound;
use serde::{Deserialize, Serialize};
use starl_core::Digest;
use starl_core::random::hash_key;

/// The copies, by name.
#[derive(Clone, Debug, Default)]
pub(super) struct Replica {
    copies: BTreeMap<Box<str>, Copy>,
    /// Whether there is one that has changed since it was saved.
    has_changed: bool,
}

/// One register's.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Copy {
    /// Nothing is stored under a lower ballot.
    pub promised: Option<Tag>,
    pub version: Option<Version>,
    #[serde(skip)]
    has_changed: bool,
}

impl Replica {
    pub fn get(&self, register: &str) -> Option<&Version> {
        self.copies.get(register)?.version.as_ref()
    }

    /// The promise about a register.
    pub fn promised(&self, register: &str) -> Option<Tag> {
        self.copies.get(register)?.promised
    }

    /// Merges a copy unless the present one is later or there is no room; returns whether anything changed.
    pub fn merge(&mut self, entry: &Entry, most: usize) -> bool {
        let Some(copy) = self.copy_mut(&entry.register, most) else {
            return false;
        };
        let is_later = copy.version.as_ref() < Some(&entry.version);
        if is_later {
            copy.version = Some(entry.version.clone());
            copy.has_changed = true;
            self.has_changed = true;
        }
        is_later
    }

    /// Promises a ballot, if no greater one is promised; whether this is promised now.
    pub fn promise(&mut self, register: &str, ballot: Tag, most: usize) -> bool {
        let Some(copy) = self.copy_mut(register, most) else {
            return false;
        };
        if copy.promised < Some(ballot) {
            copy.promised = Some(ballot);
            copy.has_changed = true;
            self.has_changed = true;
            return true;
        }
        copy.promised == Some(ballot)
    }

    /// None if it is a new one and there is no room.
    fn copy_mut(&mut self, register: &str, most: usize) -> Option<&mut Copy> {
        if !self.copies.contains_key(register) && self.copies.len() < most {
            self.copies.insert(register.into(), Copy::default());
        }
        self.copies.get_mut(register)
    }

    /// Takes up a copy from storage.
    pub fn restore(&mut self, register: &str, copy: Copy) {
        self.copies.insert(register.into(), copy);
    }

    /// Shows each copy that has changed since it was shown last.
    pub fn save_changed(&mut self, mut save: impl FnMut(&str, &Copy)) {
        if core::mem::take(&mut self.has_changed) {
            for (register, copy) in &mut self.copies {
                if core::mem::take(&mut copy.has_changed) {
                    save(register, copy);
                }
            }
        }
    }

    /// A copy, to be sent.
    pub fn entry(&self, register: &str) -> Option<Entry> {
        Some(Entry {
            register: register.to_owned(),
            version: self.get(register)?.clone(),
        })
    }

    /// The copies after a register with their promises, as many as fit into `room` bytes, but at least one.
    pub fn page(&self, after: Option<String>, room: usize) -> Page {
        let mut entries = Vec::new();
        let mut room = room;
        let mut is_last = true;
        for (name, copy) in self.after(after.as_deref()) {
            let entry = PageEntry {
                register: name.to_owned(),
                promised: copy.promised,
                version: copy.version.clone(),
            };
            let bytes = entry.bytes();
            if bytes > room && !entries.is_empty() {
                is_last = false;
                break;
            }
            room = room.saturating_sub(bytes);
            entries.push(entry);
        }
        Page {
            after,
            entries,
            is_last,
        }
    }

    /// The tags of the registers after one, as many as fit; and the last of them, none if there are no more.
    pub fn tags_after(
        &self,
        after: Option<&str>,
        room: usize,
    ) -> (Vec<(String, Tag)>, Option<String>) {
        let mut tags: Vec<(String, Tag)> = Vec::new();
        let mut room = room;
        for name in self.names_after(after) {
            let Some(version) = self.get(name) else {
                break;
            };
            let bytes = 5 + name.len() + Tag::BYTES;
            if bytes > room
                && let Some((last, _)) = tags.last()
            {
                let last = last.clone();
                return (tags, Some(last));
            }
            room = room.saturating_sub(bytes);
            tags.push((name.to_owned(), version.tag));
        }
        (tags, None)
    }

    /// The names after one up to another.
    pub fn names_between<'a>(
        &'a self,
        after: Option<&str>,
        last: Option<&'a str>,
    ) -> impl Iterator<Item = &'a str> {
        self.names_after(after)
            .take_while(move |&name| last.is_none_or(|last| name <= last))
    }

    /// Of the registers of which there is a copy.
    fn names_after(&self, after: Option<&str>) -> impl Iterator<Item = &str> {
        let later = self.after(after);
        later.filter_map(|(name, copy)| copy.version.is_some().then_some(name))
    }

    fn after(&self, after: Option<&str>) -> impl Iterator<Item = (&str, &Copy)> {
        let from = after.map_or(Bound::Unbounded, Bound::Excluded);
        let later = self.copies.range::<str, _>((from, Bound::Unbounded));
        later.map(|(name, copy)| (&**name, copy))
    }

    /// A hash of all copies.
    pub fn fingerprint(&self) -> u64 {
        let copies = self.copies.iter();
        let copies = copies.filter_map(|(name, copy)| Some((name, copy.version.as_ref()?)));
        copies.fold(0, |sum, (name, version)| {
            let mut digest = Digest::default();
            digest.bytes(name.as_bytes());
            add_tag(&mut digest, version.tag);
            digest.bytes(version.value.as_deref().unwrap_or_default());
            for (writer, tag) in &version.writers {
                digest.word(writer.0.into());
                add_tag(&mut digest, *tag);
            }
            sum.wrapping_add(hash_key(digest.value(), &[]))
        })
    }

    /// Forgets what no writes can have led to.
    pub fn refresh(&mut self) {
        self.copies.retain(|_, copy| {
            copy.promised = copy.promised.filter(|ballot| ballot.is_valid());
            copy.version = copy.version.take().filter(Version::is_valid);
            copy.promised.is_some() || copy.version.is_some()
        });
    }

    /// To be overwritten.
    pub fn all_mut(&mut self) -> impl Iterator<Item = &mut Copy> {
        self.copies.values_mut()
    }
}

fn add_tag(digest: &mut Digest, tag: Tag) {
    digest.word(tag.count);
    digest.word(u64::from(tag.writer.0) << 32 | u64::from(tag.incarnation));
}
