//! Delta encoding of lists of numbers: only numbers whose bits have changed are stored.

use alloc::vec::Vec;
use serde::{Deserialize, Serialize};

/// A list of 64-bit words by what differs from the list before it. Words that the list before did not
/// have count as 0.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Delta {
    /// How many words the new list has.
    count: u32,
    /// A bit for each word, the lowest bit of a byte first, that says whether the word differs; then the
    /// words that do, the lowest byte first.
    #[serde(serialize_with = "super::bytes::as_bytes")]
    bytes: Vec<u8>,
}

const WORD: usize = size_of::<u64>();

impl Delta {
    /// The change from `old` to `new`; `None` if they are equal.
    pub fn between(
        old: impl ExactSizeIterator<Item = u64>,
        new: impl ExactSizeIterator<Item = u64>,
    ) -> Option<Delta> {
        let count = new.len();
        let mut differs = old.len() != count;
        let mask = count.div_ceil(8);
        let mut bytes = Vec::with_capacity(mask + count * WORD);
        bytes.resize(mask, 0);
        let old = old.map(Some).chain(core::iter::repeat(None));
        for (index, (old, new)) in old.zip(new).enumerate() {
            if old.unwrap_or(0) != new {
                differs = true;
                bytes[index / 8] |= 1 << (index % 8);
                bytes.extend(new.to_le_bytes());
            }
        }
        let count = count as u32;
        differs.then_some(Delta { count, bytes })
    }

    /// Applies the delta to `old`; `None` if the delta is invalid.
    pub fn apply(&self, old: impl Iterator<Item = u64>) -> Option<Vec<u64>> {
        let count = self.count as usize;
        let (mask, words) = self.bytes.split_at_checked(count.div_ceil(8))?;
        let (words, rest) = words.as_chunks::<WORD>();
        let mut words = words.iter().map(|word| u64::from_le_bytes(*word));
        let mut old = old.map(Some).chain(core::iter::repeat(None));
        let mut list = Vec::with_capacity(count);
        for index in 0..count {
            let before = old.next().flatten().unwrap_or(0);
            let differs = mask[index / 8] & 1 << (index % 8) != 0;
            list.push(if differs { words.next()? } else { before });
        }
        (rest.is_empty() && words.next().is_none()).then_some(list)
    }
}
