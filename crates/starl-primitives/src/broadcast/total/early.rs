//! Entries that came before those that they follow. They wait, so that the loss of one datagram does not
//! cost those after it.

use super::packet::Entry;
use alloc::collections::BTreeMap;
use alloc::vec::Vec;

/// They may take this much room, bytes; the farthest are dropped first.
const MOST_EARLY: usize = 1 << 18;

/// The number of gaps between them that one message reports.
const MOST_GAPS: usize = 16;

/// Part of the leader's log.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// The entry before these, and its term.
    pub previous: u64,
    pub previous_term: u32,
    pub entries: Vec<Entry>,
}

/// Parts of the log of one term's leader, by the entry before them.
#[derive(Clone, Debug, Default)]
pub(super) struct Early {
    parts: BTreeMap<u64, Part>,
    room: usize,
}

impl Early {
    pub fn hold(&mut self, part: Part) {
        let place = part.previous;
        let known = self.parts.get(&place).map_or(0, |p| p.entries.len());
        if part.entries.len() <= known {
            return;
        }
        self.room += room(&part);
        if let Some(shorter) = self.parts.insert(place, part) {
            self.room -= room(&shorter);
        }
        while self.room > MOST_EARLY
            && let Some((_, farthest)) = self.parts.pop_last()
        {
            self.room -= room(&farthest);
        }
    }

    /// The missing parts between the known prefix and a place: the first gaps.
    pub fn gaps(&self, known: u64, last: u64) -> Vec<(u64, u64)> {
        let mut gaps = Vec::new();
        let mut known = known;
        let places = self.parts.values();
        let places = places.map(|part| (part.previous, part.entries.len() as u64));
        for (previous, count) in places.chain([(last, 0)]) {
            if previous > known && gaps.len() < MOST_GAPS {
                gaps.push((known, previous));
            }
            known = known.max(previous.saturating_add(count));
        }
        gaps
    }

    /// A part that begins no later than here.
    pub fn take(&mut self, through: u64) -> Option<Part> {
        let first = self.parts.first_entry()?;
        let part = (*first.key() <= through).then(|| first.remove())?;
        self.room -= room(&part);
        Some(part)
    }
}

fn room(part: &Part) -> usize {
    part.entries.iter().map(Entry::room).sum()
}
