//! Tables that number rows of words in the order in which they come: equal rows have one number.
//!
//! Rows lie end to end in one piece of memory, and are found by open addressing with linear probing
//! (Knuth, The Art of Computer Programming 3, section 6.4). Equality is of the whole row, so that two
//! rows are never taken for one. Unlike the standard library's table it is the same on every run.

use starl_core::Digest;

/// Marks a place that is free.
const FREE: u32 = u32::MAX;

/// Numbers rows of words from 0 on.
#[derive(Clone, Debug)]
pub struct Table {
    words: Vec<u32>,
    /// Where each row ends.
    ends: Vec<usize>,
    /// Numbers of rows, by hash; a power of two of them.
    places: Vec<u32>,
}

impl Default for Table {
    fn default() -> Table {
        Table {
            words: Vec::new(),
            ends: Vec::new(),
            places: vec![FREE; 16],
        }
    }
}

impl Table {
    /// How many rows there are.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// The row with this number; empty if there is none.
    pub fn row(&self, number: u32) -> &[u32] {
        let index = number as usize;
        let begin = match index.checked_sub(1) {
            Some(before) => self.ends.get(before).copied().unwrap_or_default(),
            None => 0,
        };
        let end = self.ends.get(index).copied().unwrap_or(begin);
        self.words.get(begin..end).unwrap_or_default()
    }

    /// The number of a row, and whether it is new.
    pub fn insert(&mut self, row: &[u32]) -> (u32, bool) {
        let place = self.place(row);
        let found = self.places[place];
        if found != FREE {
            return (found, false);
        }
        let number = self.ends.len() as u32;
        self.places[place] = number;
        self.words.extend_from_slice(row);
        self.ends.push(self.words.len());
        if self.ends.len() * 4 > self.places.len() * 3 {
            self.grow();
        }
        (number, true)
    }

    /// Memory in use, bytes.
    pub fn bytes(&self) -> usize {
        let words = self.words.capacity() + self.places.capacity();
        words * size_of::<u32>() + self.ends.capacity() * size_of::<usize>()
    }

    /// Where the row is, or would be.
    fn place(&self, row: &[u32]) -> usize {
        let mask = self.places.len() - 1;
        let mut place = hash(row) as usize & mask;
        loop {
            let number = self.places[place];
            if number == FREE || self.row(number) == row {
                return place;
            }
            place = (place + 1) & mask;
        }
    }

    fn grow(&mut self) {
        let size = self.places.len() * 2;
        let mut places = vec![FREE; size];
        for number in 0..self.ends.len() as u32 {
            let mut place = hash(self.row(number)) as usize & (size - 1);
            while places[place] != FREE {
                place = (place + 1) & (size - 1);
            }
            places[place] = number;
        }
        self.places = places;
    }
}

fn hash(row: &[u32]) -> u64 {
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
    fn rows_are_numbered_as_they_come_and_found_again() {
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
        assert_eq!(table.len(), known.len());
    }
}
