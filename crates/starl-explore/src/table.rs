//! Tables that number rows of words in the order of insertion: equal rows have one number.
//!
//! Rows lie end to end, and are found by open addressing with linear probing (Knuth, The Art of Computer Programming 3,
//! section 6.4). Whole rows are compared, so two different rows are never confused. Unlike the standard library's
//! tables these are the same on every run.

use starl_core::Digest;

/// Numbers rows of words, of any length each, from 0 on.
#[derive(Clone, Debug, Default)]
pub struct Table {
    words: Vec<u32>,
    /// Where each row ends.
    ends: Vec<usize>,
    index: Index,
}

impl Table {
    /// How many rows there are.
    pub fn len(&self) -> u32 {
        self.ends.len() as u32
    }

    /// The row with this number; empty if there is none.
    pub fn row(&self, number: u32) -> &[u32] {
        row_of(&self.words, &self.ends, number)
    }

    /// The number of a row, and whether it is new.
    pub fn insert(&mut self, row: &[u32]) -> (u32, bool) {
        let Table { words, ends, index } = self;
        let place = match index.find(row, |number| row_of(words, ends, number)) {
            Ok(found) => return (found, false),
            Err(place) => place,
        };
        let number = ends.len() as u32;
        words.extend_from_slice(row);
        ends.push(words.len());
        index.enter(place, number, |number| row_of(words, ends, number));
        (number, true)
    }

    /// Memory in use, bytes.
    pub fn bytes(&self) -> usize {
        let words = self.words.capacity() * size_of::<u32>();
        words + self.ends.capacity() * size_of::<usize>() + self.index.bytes()
    }
}

fn row_of<'a>(words: &'a [u32], ends: &[usize], number: u32) -> &'a [u32] {
    let index = number as usize;
    let begin = match index.checked_sub(1) {
        Some(before) => ends.get(before).copied().unwrap_or_default(),
        None => 0,
    };
    let end = ends.get(index).copied().unwrap_or(begin);
    words.get(begin..end).unwrap_or_default()
}

/// Numbers rows of one length from 0 on, and keeps some words more with each. Only the index has spare memory: rows are
/// in chunks that are never moved.
#[derive(Clone, Debug)]
pub struct Rows {
    /// How many words a row has.
    key: usize,
    /// How many words are kept of each, the row first.
    width: usize,
    chunks: Vec<Vec<u32>>,
    len: u32,
    index: Index,
}

/// Rows in a chunk.
const CHUNK: u32 = 1 << 12;

impl Rows {
    /// A table of rows of `key` words, with each of which `more` words are kept.
    pub fn new(key: usize, more: usize) -> Rows {
        Rows {
            key,
            width: key + more,
            chunks: Vec::new(),
            len: 0,
            index: Index::default(),
        }
    }

    /// How many rows there are.
    pub fn len(&self) -> u32 {
        self.len
    }

    /// The row with this number; there must be one.
    pub fn row(&self, number: u32) -> &[u32] {
        &all_of(&self.chunks, self.width, number)[..self.key]
    }

    /// The data kept with this row, which must exist.
    pub fn kept(&self, number: u32) -> &[u32] {
        &all_of(&self.chunks, self.width, number)[self.key..]
    }

    /// The number of a row, and whether it is new; only if it is, `more` is kept with it.
    pub fn insert(&mut self, row: &[u32], more: &[u32]) -> (u32, bool) {
        let Rows {
            key, width, chunks, ..
        } = &*self;
        let place = match self
            .index
            .find(row, |number| &all_of(chunks, *width, number)[..*key])
        {
            Ok(found) => return (found, false),
            Err(place) => place,
        };
        let number = self.push(row, more);
        let Rows {
            key,
            width,
            chunks,
            index,
            ..
        } = self;
        index.enter(place, number, |number| {
            &all_of(chunks, *width, number)[..*key]
        });
        (number, true)
    }

    /// Adds a row that [`Rows::insert`] does not find. Gives its number.
    pub fn push(&mut self, row: &[u32], more: &[u32]) -> u32 {
        debug_assert_eq!((row.len(), row.len() + more.len()), (self.key, self.width));
        let number = self.len;
        self.len += 1;
        if number.is_multiple_of(CHUNK) {
            let chunk = Vec::with_capacity(CHUNK as usize * self.width);
            self.chunks.push(chunk);
        }
        let chunk = &mut self.chunks[(number / CHUNK) as usize];
        chunk.extend_from_slice(row);
        chunk.extend_from_slice(more);
        number
    }

    /// Memory in use, bytes.
    pub fn bytes(&self) -> usize {
        let rows = self.chunks.len() * CHUNK as usize * self.width;
        rows * size_of::<u32>() + self.index.bytes()
    }
}

fn all_of(chunks: &[Vec<u32>], width: usize, number: u32) -> &[u32] {
    let begin = (number % CHUNK) as usize * width;
    &chunks[(number / CHUNK) as usize][begin..begin + width]
}

/// Marks a place that is free.
const FREE: u32 = u32::MAX;

/// Finds the numbers of rows by their hashes.
#[derive(Clone, Debug)]
struct Index {
    /// A power of two of them.
    places: Vec<u32>,
    used: usize,
}

impl Default for Index {
    fn default() -> Index {
        Index {
            places: vec![FREE; 16],
            used: 0,
        }
    }
}

impl Index {
    /// The number of a row, or the place where it is to be entered.
    fn find<'a>(&self, row: &[u32], row_of: impl Fn(u32) -> &'a [u32]) -> Result<u32, usize> {
        let mask = self.places.len() - 1;
        let mut place = hash(row) as usize & mask;
        loop {
            let number = self.places[place];
            if number == FREE {
                return Err(place);
            }
            if row_of(number) == row {
                return Ok(number);
            }
            place = (place + 1) & mask;
        }
    }

    /// Enters a number where it was not found.
    fn enter<'a>(&mut self, place: usize, number: u32, row_of: impl Fn(u32) -> &'a [u32]) {
        self.places[place] = number;
        self.used += 1;
        if self.used * 4 > self.places.len() * 3 {
            self.grow(row_of);
        }
    }

    fn grow<'a>(&mut self, row_of: impl Fn(u32) -> &'a [u32]) {
        let mask = self.places.len() * 2 - 1;
        let mut places = vec![FREE; mask + 1];
        for number in 0..self.used as u32 {
            let mut place = hash(row_of(number)) as usize & mask;
            while places[place] != FREE {
                place = (place + 1) & mask;
            }
            places[place] = number;
        }
        self.places = places;
    }

    fn bytes(&self) -> usize {
        self.places.capacity() * size_of::<u32>()
    }
}

/// The hash of a row.
pub fn hash(row: &[u32]) -> u64 {
    let mut digest = Digest::default();
    for pair in row.chunks(2) {
        let high = pair.get(1).map_or(0, |&word| u64::from(word) + 1);
        digest.word(u64::from(pair[0]) | high << 32);
    }
    let value = digest.value();
    value ^ value >> 32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_numbered_in_order_and_found_again() {
        let mut table = Table::default();
        let rows: Vec<Vec<u32>> = (0..5000u32)
            .map(|number| (0..number % 7).map(|k| k * number).collect())
            .collect();
        let mut known: Vec<&Vec<u32>> = Vec::new();
        for row in &rows {
            let before = known.iter().position(|other| *other == row);
            let number = before.unwrap_or(known.len()) as u32;
            assert_eq!(table.insert(row), (number, before.is_none()));
            if before.is_none() {
                known.push(row);
            }
        }
        for (number, row) in known.iter().enumerate() {
            assert_eq!(table.row(number as u32), row.as_slice());
            assert_eq!(table.insert(row), (number as u32, false));
        }
    }

    #[test]
    fn rows_keep_the_words_of_their_first_insertion() {
        let mut rows = Rows::new(2, 1);
        for turn in 0..2 {
            for number in 0..3 * CHUNK {
                let row = [number % 3, number / 3];
                assert_eq!(rows.insert(&row, &[number + turn]), (number, turn == 0));
            }
        }
        assert_eq!(rows.len(), 3 * CHUNK);
        for number in [0, 1, CHUNK - 1, CHUNK, 3 * CHUNK - 1] {
            assert_eq!(rows.row(number), [number % 3, number / 3]);
            assert_eq!(rows.kept(number), [number]);
        }
    }
}
