//! One robot's copies of the registers.
//!
//! Invariant: the tag of a copy only rises. Copies of equal tags hold equal values, unless a corruption
//! changed one; then the greater value is kept, by all alike.

use super::packet::{Entry, Page, TAG_BYTES};
use super::tag::Tag;
use alloc::borrow::ToOwned;
use alloc::boxed::Box;
use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;
use core::ops::Bound;
use starl_core::random::hash_key;
use starl_core::{Digest, Payload};

/// The copies, by name.
#[derive(Clone, Debug, Default)]
pub(super) struct Replica(BTreeMap<Box<str>, (Tag, Payload)>);

impl Replica {
    pub fn get(&self, register: &str) -> Option<&(Tag, Payload)> {
        self.0.get(register)
    }

    /// Takes in a copy unless the present one is later or there is no room; whether it changed anything.
    pub fn merge(&mut self, entry: &Entry, most: usize) -> bool {
        if let Some(present) = self.0.get_mut(&*entry.register) {
            let is_later = (entry.tag, &entry.value) > (present.0, &present.1);
            if is_later {
                *present = (entry.tag, entry.value.clone());
            }
            return is_later;
        }
        let has_room = self.0.len() < most;
        if has_room {
            let content = (entry.tag, entry.value.clone());
            self.0.insert((*entry.register).into(), content);
        }
        has_room
    }

    /// A copy, to be sent.
    pub fn entry(&self, register: &str) -> Option<Entry> {
        let (tag, value) = self.get(register)?;
        Some(Entry {
            register: register.to_owned(),
            tag: *tag,
            value: value.clone(),
        })
    }

    /// As many copies after a register as fit so many bytes, but at least one.
    pub fn page(&self, after: Option<String>, room: usize) -> Page {
        let mut entries = Vec::new();
        let mut room = room;
        let mut is_last = true;
        let later = self.names_after(after.as_deref());
        for entry in later.filter_map(|name| self.entry(name)) {
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

    /// The tags of the registers after one, as many as fit so many bytes; and the last of them, none if
    /// there are no more.
    pub fn tags_after(
        &self,
        after: Option<&str>,
        room: usize,
    ) -> (Vec<(String, Tag)>, Option<String>) {
        let mut tags: Vec<(String, Tag)> = Vec::new();
        let mut room = room;
        for name in self.names_after(after) {
            let Some((tag, _)) = self.get(name) else {
                break;
            };
            let bytes = 5 + name.len() + TAG_BYTES;
            if bytes > room
                && let Some((last, _)) = tags.last()
            {
                let last = last.clone();
                return (tags, Some(last));
            }
            room = room.saturating_sub(bytes);
            tags.push((name.to_owned(), *tag));
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

    fn names_after(&self, after: Option<&str>) -> impl Iterator<Item = &str> {
        let from = after.map_or(Bound::Unbounded, Bound::Excluded);
        let later = self.0.range::<str, _>((from, Bound::Unbounded));
        later.map(|(name, _)| &**name)
    }

    /// Stands for all copies.
    pub fn fingerprint(&self) -> u64 {
        self.0.iter().fold(0, |sum, (name, (tag, value))| {
            let mut digest = Digest::default();
            digest.bytes(name.as_bytes());
            digest.word(tag.count);
            digest.word(u64::from(tag.writer.0) << 32 | u64::from(tag.incarnation));
            digest.bytes(value);
            sum.wrapping_add(hash_key(digest.value(), &[]))
        })
    }

    /// Forgets copies that no writes can have led to.
    pub fn refresh(&mut self) {
        self.0.retain(|_, (tag, _)| tag.is_valid());
    }

    /// To be overwritten.
    pub fn all_mut(&mut self) -> impl Iterator<Item = &mut (Tag, Payload)> {
        self.0.values_mut()
    }
}
