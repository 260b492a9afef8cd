//! Maps: values by their keys.

use crate::machine::types::{Keys, Parts};
use crate::machine::value::index::{Found, Index};
use crate::machine::value::list::{Block, Item, List, WORD};
use core::cmp::Ordering;
use serde::{Deserialize, Serialize};

/// Entries in ascending order of their keys, without repetitions: each is a key and then its value.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Map<T> {
    entries: List<T>,
    index: Index,
}

impl<T: Item> Map<T> {
    /// A map without entries, for keys and values of these layouts.
    pub fn empty(parts: &Parts) -> Map<T> {
        Map::new(&List::new(&parts.element), &List::new(&parts.value))
    }

    /// A map of these keys, which are in ascending order without repetitions, and the values at the same indices.
    pub fn new(keys: &List<T>, values: &List<T>) -> Map<T> {
        Map {
            entries: keys.zipped(values),
            index: Index::new(keys.widths()),
        }
    }

    /// How many entries there are.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// The size as if nothing were shared, bytes.
    pub fn bytes(&self) -> usize {
        8 * WORD + self.entries.bytes()
    }

    /// The size of the entries from `index` on, without what their objects hold, bytes.
    pub fn bytes_from(&self, index: usize) -> usize {
        self.entries.bytes_from(index)
    }

    /// A key and its value.
    pub fn get(&self, index: usize) -> Option<[Block<'_, T>; 2]> {
        self.entries.get(index).map(|entry| self.split(entry))
    }

    /// A key and then its value, as one block.
    pub fn entry(&self, index: usize) -> Option<Block<'_, T>> {
        self.entries.get(index)
    }

    /// Keys and values in order.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = [Block<'_, T>; 2]> {
        self.entries.iter().map(|entry| self.split(entry))
    }

    /// The keys, as a list of their own.
    pub fn keys(&self) -> List<T> {
        self.entries.parts((0, 0), self.index.key)
    }

    /// The values, as a list of their own.
    pub fn values(&self) -> List<T> {
        self.entries.parts(self.index.key, self.entries.widths())
    }

    /// The index of a key.
    pub fn find(&self, key: Block<'_, T>, parts: &Parts, types: &[Parts]) -> Option<usize> {
        let found = match (parts.keys, key.scalars, key.objects) {
            (Keys::Numbers, &[number], []) => self.index.find_number(&self.entries, number),
            (Keys::Texts, [], [text]) => self.index.find_text(&self.entries, text),
            _ => Found::Unknown,
        };
        match found {
            Found::At(at) => Some(at),
            Found::Nowhere => None,
            Found::Unknown => self.entries.search(key, &parts.element, types).ok(),
        }
    }

    /// The index that a key would have that is not there.
    pub fn place(&self, key: Block<'_, T>, parts: &Parts, types: &[Parts]) -> usize {
        let (Ok(place) | Err(place)) = self.entries.search(key, &parts.element, types);
        place
    }

    /// The index of a number, if it is found without a search.
    #[inline]
    pub fn find_number(&self, number: u64) -> Option<usize> {
        self.index.find_number(&self.entries, number).at()
    }

    /// The index of a text, if it is found without a search.
    #[inline]
    pub fn find_text(&self, text: &T) -> Option<usize> {
        self.index.find_text(&self.entries, text).at()
    }

    /// The value at an index, if it is scalars alone.
    #[inline]
    pub fn scalars_at(&self, index: usize) -> Option<&[u64]> {
        let (width, object_width) = self.index.key;
        let entry = self.entries.scalars_at(index as u64, object_width)?;
        entry.get(usize::from(width)..)
    }

    /// As [`Map::scalars_at`], to be changed.
    #[inline]
    pub fn scalars_at_mut(&mut self, index: usize) -> Option<&mut [u64]> {
        let (width, object_width) = self.index.key;
        let entry = self.entries.scalars_at_mut(index as u64, object_width)?;
        entry.get_mut(usize::from(width)..)
    }

    /// Replaces a value; false if there is no such entry or the value is wider.
    #[must_use]
    pub fn set(&mut self, index: usize, value: Block<'_, T>) -> bool {
        self.entries.set_end(index, value)
    }

    /// Inserts a key and its value before an entry or at the end; false if the index is greater or the block not as wide.
    #[must_use]
    pub fn insert(&mut self, index: usize, entry: Block<'_, T>) -> bool {
        self.index.forget();
        self.entries.insert(index, entry)
    }

    /// Removes an entry; false if there is none.
    pub fn remove(&mut self, index: usize) -> bool {
        self.index.forget();
        self.entries.remove(index)
    }

    /// The order of two maps of one type: by their keys, then by their values.
    pub fn compare(&self, other: &Map<T>, parts: &Parts, types: &[Parts]) -> Ordering {
        let half = |half: usize| {
            let layout = [&parts.element, &parts.value][half];
            let mut pairs = self.iter().zip(other.iter());
            pairs
                .find_map(|(left, right)| {
                    let order = left[half].compare(right[half], layout, types);
                    order.is_ne().then_some(order)
                })
                .unwrap_or_else(|| self.len().cmp(&other.len()))
        };
        half(0).then_with(|| half(1))
    }

    /// Whether the bits of all entries are the same.
    pub fn same(&self, other: &Map<T>) -> bool
    where
        T: PartialEq,
    {
        self.entries.same(&other.entries)
    }

    /// Whether keys are looked up by their hashes at present.
    #[cfg(test)]
    pub fn is_indexed(&self) -> bool {
        self.index.is_made()
    }

    /// A key and its value, from one block.
    pub fn split<'a>(&self, entry: Block<'a, T>) -> [Block<'a, T>; 2] {
        entry.split(self.index.key)
    }
}
