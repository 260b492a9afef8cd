//! A hash index of the keys of a map, so that looking up does not depend on how many there are.
//!
//! A map stays a row of entries in ascending order of their keys, which is what it means: how it is compared, recorded and
//! run over. The index does not belong to its value. It is made when a map has been asked as often as it has keys without
//! getting new ones, and forgotten when it gets or loses one. Open addressing with linear probing (Knuth, "The Art of
//! Computer Programming", volume 3, section 6.4). Keys that hash to one place are searched by bisection after [`LONGEST`]
//! of them, so that no keys make it slower than that.
//!
//! Programs mostly look a text up by the same object that is the key. Such a text is found by its address in memory, without
//! being read. Results do not depend on addresses, since an index that an address leads to is checked.

use crate::machine::value::list::{Block, Item, List};
use alloc::boxed::Box;
use alloc::vec;
use core::num::NonZeroUsize;
use core::sync::atomic::{AtomicU16, AtomicU32, Ordering};
use once_cell::race::OnceBox;
use serde::{Deserialize, Serialize};

/// Fewer keys are found as fast by bisection.
const FEWEST: usize = 8;

/// The most places that are looked at for a key.
const LONGEST: usize = 16;

/// The index of one map.
#[derive(Default, Serialize, Deserialize)]
#[serde(from = "(u8, u8)", into = "(u8, u8)")]
pub struct Index {
    /// How many scalars and objects a key has.
    pub key: (u8, u8),
    /// How often the map was asked since its keys changed.
    asked: AtomicU16,
    /// Where the last key was found: programs often read a value and then write it.
    last: AtomicU32,
    table: OnceBox<Table>,
}

/// Where keys are.
struct Table {
    by_value: Hashed,
    /// Where texts are by their addresses; empty for numbers.
    by_address: Hashed,
}

/// Where keys are, by their hashes.
struct Hashed {
    /// Its length is a power of two.
    places: Box<[Place]>,
    /// How many bits of a hash are left out: its high bits depend on all bits of the key.
    shift: u32,
}

/// A place of the table.
#[derive(Clone, Copy, Default)]
struct Place {
    /// The index of a key plus one; 0 where there is none.
    number: u32,
    /// A part of the key's hash, so that most other keys are not looked at.
    tag: u32,
}

/// The answer of the index about a key.
pub enum Found {
    /// It is at this index.
    At(usize),
    /// It is not in the map.
    Nowhere,
    /// The index does not know.
    Unknown,
}

impl Found {
    /// The index, if it is known.
    #[inline]
    pub fn at(self) -> Option<usize> {
        match self {
            Found::At(at) => Some(at),
            Found::Nowhere | Found::Unknown => None,
        }
    }
}

impl Index {
    /// For keys of this number of scalars and objects.
    pub fn new(key: (u8, u8)) -> Index {
        Index {
            key,
            ..Index::default()
        }
    }

    /// Where a number is among the keys of these entries.
    #[inline(always)]
    pub fn find_number<T: Item>(&self, entries: &List<T>, number: u64) -> Found {
        let is_at = |at: usize| entries.first_scalar(at) == Some(number);
        // Numbers without gaps need no index.
        let first = entries.first_scalar(0).unwrap_or(0);
        let guess = number.wrapping_sub(first) as usize;
        if is_at(guess) {
            return Found::At(guess);
        }
        let last = self.last.load(Ordering::Relaxed) as usize;
        if is_at(last) {
            return Found::At(last);
        }
        self.look_number_up(entries, number)
    }

    #[inline(never)]
    fn look_number_up<T: Item>(&self, entries: &List<T>, number: u64) -> Found {
        let Some(table) = self.table.get() else {
            return self.ask(entries);
        };
        let hash = mixed(0, number);
        self.note(
            table
                .by_value
                .find(hash, |at| entries.first_scalar(at) == Some(number)),
        )
    }

    /// Where a text is among the keys of these entries.
    #[inline(always)]
    pub fn find_text<T: Item>(&self, entries: &List<T>, text: &T) -> Found {
        let address = text.address();
        let is_at = |at: usize| {
            let found = entries.first_object(at).and_then(T::address);
            found.is_some() && found == address
        };
        let last = self.last.load(Ordering::Relaxed) as usize;
        if is_at(last) {
            return Found::At(last);
        }
        if let (Some(table), Some(address)) = (self.table.get(), address)
            && let Found::At(at) = table.by_address.find(hash_of_address(address), is_at)
        {
            self.last.store(at as u32, Ordering::Relaxed);
            return Found::At(at);
        }
        self.look_text_up(entries, text)
    }

    #[inline(never)]
    fn look_text_up<T: Item>(&self, entries: &List<T>, text: &T) -> Found {
        let Some(table) = self.table.get() else {
            return self.ask(entries);
        };
        let characters = text.text();
        let is_at = |at: usize| {
            let found = entries.first_object(at);
            found.is_some_and(|found| found.text() == characters)
        };
        self.note(table.by_value.find(hash_of_text(characters), is_at))
    }

    /// Forgets the index, because the keys change.
    #[inline]
    pub fn forget(&mut self) {
        if *self.asked.get_mut() > 0 {
            *self = Index::new(self.key);
        }
    }

    /// Whether there is a table at present.
    #[cfg(test)]
    pub fn is_made(&self) -> bool {
        self.table.get().is_some()
    }

    fn note(&self, found: Found) -> Found {
        if let Found::At(at) = found {
            self.last.store(at as u32, Ordering::Relaxed);
        }
        found
    }

    fn ask<T: Item>(&self, entries: &List<T>) -> Found {
        // Counts that are lost where two threads ask at once do not matter.
        let asked = self.asked.load(Ordering::Relaxed).saturating_add(1);
        self.asked.store(asked, Ordering::Relaxed);
        let length = entries.len();
        if usize::from(asked) >= length.min(usize::from(u16::MAX))
            && (FEWEST..1 << 30).contains(&length)
        {
            self.table
                .get_or_init(|| Box::new(Table::of(entries, self.key)));
        }
        Found::Unknown
    }
}

impl From<(u8, u8)> for Index {
    fn from(key: (u8, u8)) -> Index {
        Index::new(key)
    }
}

impl From<Index> for (u8, u8) {
    fn from(index: Index) -> (u8, u8) {
        index.key
    }
}

/// A copy of a map gets an index of its own when it is asked often.
impl Clone for Index {
    fn clone(&self) -> Index {
        Index::new(self.key)
    }
}

impl core::fmt::Debug for Index {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("Index")
    }
}

impl Table {
    fn of<T: Item>(entries: &List<T>, key: (u8, u8)) -> Table {
        let keys = || entries.iter().map(|entry| entry.split(key)[0]);
        let address = |key: Block<'_, T>| key.objects.first().and_then(T::address);
        Table {
            by_value: Hashed::of(entries.len(), keys().map(|key| Some(hash(key)))),
            by_address: match key {
                (_, 0) => Hashed::of(0, core::iter::empty()),
                _ => Hashed::of(
                    entries.len(),
                    keys().map(|key| address(key).map(hash_of_address)),
                ),
            },
        }
    }
}

impl Hashed {
    /// Keys of which these are the hashes, in order; a key without one is not found.
    fn of(count: usize, hashes: impl Iterator<Item = Option<u64>>) -> Hashed {
        let length = (2 * count).next_power_of_two();
        let mut table = Hashed {
            places: vec![Place::default(); length].into(),
            shift: (u64::BITS - length.trailing_zeros()).min(u64::BITS - 1),
        };
        for (number, hash) in hashes.enumerate() {
            let Some(hash) = hash else { continue };
            let mut places = table.places_of(hash);
            if let Some(place) = places.find(|&place| table.places[place].number == 0) {
                table.places[place] = Place {
                    number: number as u32 + 1,
                    tag: tag(hash),
                };
            }
        }
        table
    }

    /// The places where a key with this hash may be, in order.
    #[inline]
    fn places_of(&self, hash: u64) -> impl Iterator<Item = usize> + use<> {
        let mask = self.places.len() - 1;
        let first = (hash >> self.shift) as usize;
        (first..first + LONGEST).map(move |place| place & mask)
    }

    #[inline]
    fn find(&self, hash: u64, is_at: impl Fn(usize) -> bool) -> Found {
        for place in self.places_of(hash) {
            let Place { number, tag: other } = self.places[place];
            let Some(number) = number.checked_sub(1) else {
                return Found::Nowhere;
            };
            if other == tag(hash) && is_at(number as usize) {
                return Found::At(number as usize);
            }
        }
        Found::Unknown
    }
}

#[inline]
fn hash_of_address(address: NonZeroUsize) -> u64 {
    mixed(0, address.get() as u64)
}

/// Bits of a hash that do not choose the place.
fn tag(hash: u64) -> u32 {
    hash as u32
}

/// Multiplicative hashing: 2^64 divided by the golden ratio.
const FACTOR: u64 = 0x9E37_79B9_7F4A_7C15;

/// The hash of a key: of one number, or of one text.
fn hash<T: Item>(key: Block<'_, T>) -> u64 {
    match key.objects {
        [text, ..] => hash_of_text(text.text()),
        [] => key.scalars.iter().fold(0, |hash, &word| mixed(hash, word)),
    }
}

#[inline]
fn hash_of_text(text: &str) -> u64 {
    let (words, rest) = text.as_bytes().as_chunks::<8>();
    let hash = words
        .iter()
        .fold(0, |hash, &word| mixed(hash, u64::from_le_bytes(word)));
    let last = rest
        .iter()
        .rev()
        .fold(0, |last, &byte| last << 8 | u64::from(byte));
    mixed(hash, last)
}

#[inline]
fn mixed(hash: u64, word: u64) -> u64 {
    (hash.rotate_left(5) ^ word).wrapping_mul(FACTOR)
}

#[cfg(test)]
mod tests {
    use crate::machine::types::{Keys, ObjectType, Parts, Type};
    use crate::machine::value::object::{Block, Map, Object};
    use alloc::collections::BTreeMap;
    use alloc::format;
    use starl_core::Random;

    /// Puts, removes and looks up keys at random, and compares the map with one of the standard library.
    fn same_as_a_tree(key_type: Type, key: impl Fn(u32) -> (Option<u64>, Object)) {
        let types = [ObjectType::Text, ObjectType::Map(key_type, Type::Int)];
        let parts: [Parts; 2] = [0, 1].map(|index| Parts::of(&types[index], &types));
        assert!(parts[1].keys != Keys::Others);
        let mut random = Random::keyed(1, &[]);
        let (mut map, mut tree) = (Map::empty(&parts[1]), BTreeMap::new());
        let mut indexed = 0;
        for turn in 0..20_000u64 {
            let number = random.below(300);
            let (scalar, object) = key(number);
            let block = Block {
                scalars: scalar.as_slice(),
                objects: match scalar {
                    Some(_) => &[],
                    None => core::slice::from_ref(&object),
                },
            };
            let found = map.find(block, &parts[1], &parts);
            indexed += u32::from(map.is_indexed());
            assert_eq!(found.is_some(), tree.contains_key(&number), "turn {turn}");
            let words = [scalar.unwrap_or_default(), turn];
            let entry = Block {
                scalars: &words[usize::from(scalar.is_none())..],
                objects: block.objects,
            };
            // Changes become rare, so that the index is made, used and forgotten.
            match (found, random.chance(20.0 / (20.0 + turn as f64))) {
                (Some(at), false) => {
                    let value = map.get(at).expect("it was found")[1].scalars[0];
                    assert_eq!(tree.get(&number), Some(&value), "turn {turn}");
                }
                (Some(at), true) => {
                    assert!(map.remove(at));
                    tree.remove(&number);
                }
                (None, _) => {
                    assert!(map.insert(map.place(block, &parts[1], &parts), entry));
                    tree.insert(number, turn);
                }
            }
        }
        assert!(
            (2_000..19_000).contains(&indexed),
            "indexed {indexed} times"
        );
    }

    #[test]
    fn numbers_are_found_as_in_a_tree() {
        same_as_a_tree(Type::Int, |number| {
            (Some((i64::from(number) * 37 - 5000) as u64), Object::EMPTY)
        });
    }

    #[test]
    fn texts_are_found_as_in_a_tree() {
        same_as_a_tree(Type::Object(0), |number| match number {
            0 => (None, Object::EMPTY),
            _ => (None, (&format!("the key number {number}")[..]).into()),
        });
    }

    #[test]
    fn keys_with_one_hash_are_found_too() {
        // The lowest bits of a key do not reach the bits of the hash that count in a small table.
        same_as_a_tree(Type::Int, |number| {
            (Some(u64::from(number) << 54), Object::EMPTY)
        });
    }
}
