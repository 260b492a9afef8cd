//! The log: entries by index, from 1, of which the oldest have been dropped.
//!
//! Invariant: `configurations` are those of the entries that are kept, in order, after the one in force
//! before them; there is always one.

use super::MOST_BYTES;
use super::life::Life;
use super::packet::{Entry, What};
use alloc::collections::VecDeque;
use alloc::vec::Vec;

#[derive(Clone, Debug)]
pub(super) struct Log {
    /// Entries up to here have been dropped.
    base: u64,
    base_term: u32,
    entries: VecDeque<Entry>,
    /// About how much room they take.
    bytes: usize,
    /// The voters from each index on.
    configurations: VecDeque<(u64, Vec<Life>)>,
}

impl Log {
    /// A log that continues after `base`, with these voters.
    pub fn after(base: u64, base_term: u32, voters: Vec<Life>) -> Log {
        Log {
            base,
            base_term,
            entries: VecDeque::new(),
            bytes: 0,
            configurations: VecDeque::from([(base, voters)]),
        }
    }

    /// Up to where entries have been dropped.
    pub fn base(&self) -> u64 {
        self.base
    }

    /// The index of the last entry.
    pub fn last(&self) -> u64 {
        self.base + self.entries.len() as u64
    }

    /// About how much room the entries take, bytes.
    pub fn bytes(&self) -> usize {
        self.bytes
    }

    /// Whether it is too long to be kept for absent robots.
    pub fn is_long(&self) -> bool {
        self.bytes >= MOST_BYTES
    }

    pub fn get(&self, index: u64) -> Option<&Entry> {
        let place = index.checked_sub(self.base)?.checked_sub(1)?;
        self.entries.get(usize::try_from(place).ok()?)
    }

    /// About how long the entries after one up to another one are in datagrams, bytes.
    pub fn size_between(&self, after: u64, last: u64) -> usize {
        let entries = (after.max(self.base) + 1..=last).map_while(|index| self.get(index));
        entries.map(Entry::size).sum()
    }

    /// The term of an entry, that of the last which was dropped included.
    pub fn term(&self, index: u64) -> Option<u32> {
        match index == self.base {
            true => Some(self.base_term),
            false => self.get(index).map(|entry| entry.term),
        }
    }

    /// The term of the last entry.
    pub fn last_term(&self) -> u32 {
        let last = self.entries.back();
        last.map_or(self.base_term, |entry| entry.term)
    }

    pub fn push(&mut self, entry: Entry) {
        if let What::Voters(voters) = &entry.what {
            let index = self.last() + 1;
            self.configurations.push_back((index, voters.clone()));
        }
        self.bytes += entry.room();
        self.entries.push_back(entry);
    }

    /// Drops entries after this one.
    pub fn truncate(&mut self, last: u64) {
        let kept = last.saturating_sub(self.base);
        while self.entries.len() as u64 > kept
            && let Some(entry) = self.entries.pop_back()
        {
            self.bytes -= entry.room();
        }
        while self.configurations.len() > 1
            && self.configurations.back().is_some_and(|(at, _)| *at > last)
        {
            self.configurations.pop_back();
        }
    }

    /// Drops entries up to this one.
    pub fn drop_through(&mut self, index: u64) {
        while self.base < index
            && let Some(entry) = self.entries.pop_front()
        {
            self.base += 1;
            self.base_term = entry.term;
            self.bytes -= entry.room();
        }
        while self.configurations.len() > 1
            && let Some((at, _)) = self.configurations.get(1)
            && *at <= self.base
        {
            self.configurations.pop_front();
        }
    }

    /// The voters, by the last entry that defines them.
    pub fn voters(&self) -> &[Life] {
        let last = self.configurations.back();
        last.map_or(&[], |(_, voters)| voters)
    }

    /// The index of the entry that lists them.
    pub fn voters_since(&self) -> u64 {
        self.configurations.back().map_or(0, |(at, _)| *at)
    }

    /// The voters by the entries up to this one.
    pub fn voters_at(&self, index: u64) -> &[Life] {
        let mut all = self.configurations.iter().rev();
        let found = all.find(|(at, _)| *at <= index.max(self.base));
        found.map_or(&[], |(_, voters)| voters)
    }
}
