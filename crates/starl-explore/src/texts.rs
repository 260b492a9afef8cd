//! Numbers texts that represent states: equal texts have one number.
//!
//! Only 128 bits of each text are kept. Two different texts share them as rarely as random numbers do: for a million
//! texts with a probability below 10^-26.

use crate::table::Table;
use starl_core::Digest;

/// Texts by their fingerprints.
#[derive(Clone, Debug, Default)]
pub struct Texts(Table);

impl Texts {
    /// The number of a text, from 0 in the order of insertion, and whether it is new.
    pub fn insert(&mut self, text: &str) -> (u32, bool) {
        let fingerprint = fingerprint(text);
        let words = [0, 32, 64, 96].map(|shift| (fingerprint >> shift) as u32);
        self.0.insert(&words)
    }
}

/// A hash of 128 bits of a text.
pub fn fingerprint(text: &str) -> u128 {
    let mut halves = [Digest::default(), Digest::default()];
    halves[1].word(1);
    let [low, high] = halves.map(|mut half| {
        half.bytes(text.as_bytes());
        half.value()
    });
    u128::from(high) << 64 | u128::from(low)
}
