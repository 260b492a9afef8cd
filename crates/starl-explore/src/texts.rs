//! Numbers texts that stand for states: equal texts have one number.
//!
//! Only 128 bits of each text are kept. That two different texts share them is as likely as two of so
//! many random numbers being equal: for a million texts less than one in 10^26.

use crate::table::Table;
use starl_core::Digest;

/// Texts by their fingerprints.
#[derive(Clone, Debug, Default)]
pub struct Texts(Table);

impl Texts {
    /// The number of a text, from 0 in the order in which they come, and whether it is new.
    pub fn insert(&mut self, text: &str) -> (u32, bool) {
        let fingerprint = fingerprint(text);
        let words = [0, 32, 64, 96].map(|shift| (fingerprint >> shift) as u32);
        self.0.insert(&words)
    }
}

/// 128 bits that stand for a text.
pub fn fingerprint(text: &str) -> u128 {
    let mut halves = [Digest::default(), Digest::default()];
    halves[1].word(1);
    let [low, high] = halves.map(|mut half| {
        half.bytes(text.as_bytes());
        half.value()
    });
    u128::from(high) << 64 | u128::from(low)
}
