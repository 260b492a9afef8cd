//! Finds the differences of two memories, by the fingerprints of smaller and smaller ranges of keys (the search of
//! Merkle trees, here over fingerprints that are computed when asked for; Meyer 2022, "Range-Based Set
//! Reconciliation").
//!
//! Each robot answers a part with the subparts in which its own memory differs, down to lists. It answers a list with
//! its newer elements, sent to all, and with the keys for which it lacks the newest. No state is kept between the
//! steps: any step may be lost, repeated or reordered.

use super::packet::{Item, Part, Range};
use super::store::{Element, Store, fingerprint};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use core::ops::RangeInclusive;
use starl_core::Time;

/// A range with this many elements is listed rather than split.
const LONGEST_LIST: usize = 16;

/// At most this many parts are compared at a time, more than a datagram of ours holds: each may take a walk
/// through the whole memory.
const MOST_PARTS: usize = 128;

/// The conclusion from another robot's parts.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Difference {
    /// Where the memories differ, for the other to look at.
    pub parts: Vec<Part>,
    /// The elements that the other lacks.
    pub newer: Vec<u64>,
    /// The elements that this robot lacks.
    pub wanted: Vec<u64>,
}

/// The description of a range of a memory: a list if it is short, otherwise fingerprints.
pub(super) fn describe(store: &Store, range: Range) -> Option<Part> {
    let keys = range.keys()?;
    let is_short = store.range(keys.clone()).nth(LONGEST_LIST).is_none();
    let split = range.parts().filter(|_| !is_short);
    let Some(parts) = split else {
        let items = store.range(keys).take(LONGEST_LIST);
        let items = items.map(|(key, element)| item(key, element));
        return Some(Part::Listed(range, items.collect()));
    };
    Some(Part::Split(range, parts.map(|part| sum(store, part))))
}

/// Compares parts of another memory with this one. Elements that this one got since `settled` may
/// already be in transit to the other and do not count as newer.
pub(super) fn compare(store: &Store, parts: &[Part], settled: Time) -> Difference {
    let mut difference = Difference::default();
    for part in parts.iter().take(MOST_PARTS) {
        match part {
            Part::Split(range, sums) => {
                let parts = range.parts().into_iter().flatten();
                for (part, &theirs) in parts.zip(sums) {
                    if sum(store, part) != theirs {
                        difference.parts.extend(describe(store, part));
                    }
                }
            }
            Part::Listed(range, items) => {
                if let Some(keys) = range.keys() {
                    compare_list(store, keys, items, &mut difference, |element| {
                        element.touched <= settled
                    });
                }
            }
        }
    }
    difference
}

fn compare_list(
    store: &Store,
    keys: RangeInclusive<u64>,
    items: &[Item],
    difference: &mut Difference,
    is_settled: impl Fn(&Element) -> bool,
) {
    let theirs: BTreeMap<u64, &Item> = items.iter().map(|item| (item.key, item)).collect();
    for (&key, theirs) in &theirs {
        let ours = store.at(key).map(|element| item(key, element));
        let lacks = ours.is_none_or(|ours| {
            ours.stamp < theirs.stamp || ours.stamp == theirs.stamp && ours.hash != theirs.hash
        });
        if lacks {
            difference.wanted.push(key);
        }
    }
    for (key, element) in store.range(keys) {
        let ours = item(key, element);
        let lacks = theirs.get(&key).is_none_or(|theirs| {
            theirs.stamp < ours.stamp || ours.stamp == theirs.stamp && ours.hash != theirs.hash
        });
        if lacks && is_settled(element) {
            difference.newer.push(key);
        }
    }
}

fn item(key: u64, element: &Element) -> Item {
    Item {
        key,
        stamp: element.stamp,
        hash: element.hash() as u32,
    }
}

fn sum(store: &Store, range: Range) -> u64 {
    range.keys().map_or(0, |keys| {
        fingerprint(store.range(keys).map(|(_, element)| element))
    })
}
