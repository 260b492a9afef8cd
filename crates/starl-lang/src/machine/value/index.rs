//! A hash index of the keys of a map, so that looking up does not depend on how many there are.
//!
//! A map stays a row of keys in ascending order, which is what it means: how it is compared, recorded and run over. The
//! index does not belong to its value. It is made when a map has been asked as often as it has keys without getting new ones,
//! and forgotten when it gets or loses one. Open addressing with linear probing (Knuth, "The Art of Computer
//! Programming", volume 3, section 6.4). Keys that hash to one place are searched by bisection after [`LONGEST`] of them,
//! so that no keys make it slower than that.

use crate::machine::value::list::{Block, Item, List};
use alloc::boxed::Box;
use alloc::vec;
use core::sync::atomic::{AtomicU32, Ordering};
use once_cell::race::OnceBox;

/// Fewer keys are found as fast by bisection.
const FEWEST: usize = 8;

/// The most places that are looked at for a key.
const LONGEST: usize = 16;

/// The index of one map.
#[derive(Default)]
pub struct Index {
    /// How often the map was asked since its keys changed.
    asked: AtomicU32,
    /// Where the last key was found: programs often read a value and then write it.
    last: AtomicU32,
    table: OnceBox<Table>,
}

/// Where keys are, by their hashes.
struct Table {
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
    pub fn at(self) -> Option<u64> {
        match self {
            Found::At(at) => Some(at as u64),
            Found::Nowhere | Found::Unknown => None,
        }
    }
}

impl Index {
    /// Where a key is. `keys` are the keys of the map.
    #[inline(always)]
    pub fn find<T: Item>(&self, keys: &List<T>, key: Block<'_, T>) -> Found {
        let last = self.last.load(Ordering::Relaxed) as usize;
        if keys.is_surely_at(last, key) {
            return Found::At(last);
        }
        // Numbers without gaps need no index.
        if let ([number], Some(&[first, ..])) = (key.scalars, keys.scalars().first_chunk::<1>()) {
            let guess = number.wrapping_sub(first) as usize;
            if keys.is_surely_at(guess, key) {
                self.last.store(guess as u32, Ordering::Relaxed);
                return Found::At(guess);
            }
        }
        self.look_up(keys, key)
    }

    #[inline(never)]
    fn look_up<T: Item>(&self, keys: &List<T>, key: Block<'_, T>) -> Found {
        let Some(table) = self.table.get() else {
            self.ask(keys);
            return Found::Unknown;
        };
        let found = table.find(keys, key);
        if let Found::At(at) = found {
            self.last.store(at as u32, Ordering::Relaxed);
        }
        found
    }

    /// Forgets the index, because the keys change.
    #[inline]
    pub fn forget(&mut self) {
        if *self.asked.get_mut() > 0 {
            *self = Index::default();
        }
    }

    fn ask<T: Item>(&self, keys: &List<T>) {
        // Counts that are lost where two threads ask at once do not matter.
        let asked = self.asked.load(Ordering::Relaxed).saturating_add(1);
        self.asked.store(asked, Ordering::Relaxed);
        if asked as usize >= keys.len() && keys.len() >= FEWEST && keys.len() < 1 << 30 {
            self.table.get_or_init(|| Box::new(Table::of(keys)));
        }
    }
}

/// A copy of a map gets an index of its own when it is asked often.
impl Clone for Index {
    fn clone(&self) -> Index {
        Index::default()
    }
}

impl core::fmt::Debug for Index {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("Index")
    }
}

impl Table {
    fn of<T: Item>(keys: &List<T>) -> Table {
        let length = (2 * keys.len()).next_power_of_two();
        let mut table = Table {
            places: vec![Place::default(); length].into(),
            shift: u64::BITS - length.trailing_zeros(),
        };
        for (number, key) in keys.iter().enumerate() {
            let hash = hash(key);
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
    fn find<T: Item>(&self, keys: &List<T>, key: Block<'_, T>) -> Found {
        let hash = hash(key);
        for place in self.places_of(hash) {
            let Place { number, tag: other } = self.places[place];
            let Some(number) = number.checked_sub(1) else {
                return Found::Nowhere;
            };
            if other == tag(hash) && keys.is_at(number as usize, key) {
                return Found::At(number as usize);
            }
        }
        Found::Unknown
    }
}

/// Bits of a hash that do not choose the place.
fn tag(hash: u64) -> u32 {
    hash as u32
}

/// Multiplicative hashing: 2^64 divided by the golden ratio.
const FACTOR: u64 = 0x9E37_79B9_7F4A_7C15;

#[inline]
fn hash<T: Item>(key: Block<'_, T>) -> u64 {
    let mut hash = 0u64;
    for &word in key.scalars {
        hash = mixed(hash, word);
    }
    for object in key.objects {
        let (words, rest) = object.text().as_bytes().as_chunks::<8>();
        for &word in words {
            hash = mixed(hash, u64::from_le_bytes(word));
        }
        let last = rest
            .iter()
            .rev()
            .fold(0, |last, &byte| last << 8 | u64::from(byte));
        hash = mixed(hash, last);
    }
    hash
}

#[inline]
fn mixed(hash: u64, word: u64) -> u64 {
    (hash.rotate_left(5) ^ word).wrapping_mul(FACTOR)
}

#[cfg(test)]
mod tests {
    use crate::machine::types::{ObjectType, Parts, Type};
    use crate::machine::value::object::{Block, Map, Object};
    use alloc::collections::BTreeMap;
    use alloc::format;
    use starl_core::Random;

    /// Puts, removes and looks up keys at random, and compares the map with one of the standard library.
    fn same_as_a_tree(key_type: Type, key: impl Fn(u32) -> (Option<u64>, Object)) {
        let types = [ObjectType::Text, ObjectType::Map(key_type, Type::Int)];
        let parts: [Parts; 2] = [0, 1].map(|index| Parts::of(&types[index], &types));
        assert!(parts[1].has_hashed_keys);
        let mut random = Random::keyed(1, &[]);
        let (mut map, mut tree) = (Map::default(), BTreeMap::new());
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
            indexed += u32::from(map.index.table.get().is_some());
            assert_eq!(found.is_some(), tree.contains_key(&number), "turn {turn}");
            let value = [turn];
            let value = Block {
                scalars: &value,
                objects: &[],
            };
            // Changes become rare, so that the index is made, used and forgotten.
            match (found, random.chance(20.0 / (20.0 + turn as f64))) {
                (Some(at), false) => {
                    let values = map.values().list().expect("it has values");
                    let value = values.get(at).expect("as many as keys").scalars[0];
                    assert_eq!(tree.get(&number), Some(&value), "turn {turn}");
                }
                (Some(at), true) => {
                    let (keys, values) = map.parts_mut();
                    for half in [keys, values] {
                        assert!(half.existing_list_mut().expect("it is there").remove(at));
                    }
                    tree.remove(&number);
                }
                (None, _) => {
                    let keys = map.keys().list();
                    let place = keys.map(|keys| keys.search(block, &parts[1].element, &parts));
                    let (Ok(at) | Err(at)) = place.unwrap_or(Err(0));
                    let (keys, values) = map.parts_mut();
                    let keys = keys.list_mut(&parts[1].element).expect("a list");
                    assert!(keys.insert(at, block));
                    let values = values.list_mut(&parts[1].value).expect("a list");
                    assert!(values.insert(at, value));
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
