//! Seeded random numbers: streams for robots, and stateless draws keyed by the decision.

use crate::math;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg32;
use serde::{Deserialize, Serialize};

/// A stream of random numbers; equal seeds and keys give equal streams on every target.
///
/// PCG XSH RR 64/32 (O'Neill 2014, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for
/// Random Number Generation"). A stored stream continues where it was.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "Place", from = "Place")]
pub struct Random {
    generator: Pcg32,
    place: Place,
}

/// Where a stream is: enough to continue from there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Place {
    seed: u64,
    /// Words of 32 bits that were drawn.
    drawn: u64,
}

impl From<Random> for Place {
    fn from(random: Random) -> Place {
        random.place
    }
}

impl From<Place> for Random {
    fn from(place: Place) -> Random {
        let mut generator = Pcg32::seed_from_u64(place.seed);
        generator.advance(place.drawn);
        Random { generator, place }
    }
}

impl Random {
    /// The stream of `seed` for the purpose that `key` names, independent of streams of other keys.
    ///
    /// A key is a few numbers, e.g. `[purpose, robot]` or `[purpose, sender, receiver, sequence]`:
    /// a draw that is keyed by what it decides does not depend on the order of other draws.
    pub fn keyed(seed: u64, key: &[u64]) -> Random {
        let (seed, drawn) = (hash_key(seed, key), 0);
        Random::from(Place { seed, drawn })
    }

    /// The next 32 random bits.
    pub fn bits(&mut self) -> u32 {
        self.place.drawn = self.place.drawn.wrapping_add(1);
        self.generator.next_u32()
    }

    /// The next 64 random bits.
    pub fn word(&mut self) -> u64 {
        u64::from(self.bits()) << 32 | u64::from(self.bits())
    }

    /// A whole number of any order of magnitude: small ones are as likely as great ones.
    pub fn magnitude(&mut self) -> u64 {
        self.word() >> self.below(64)
    }

    /// The next 128 bits, without drawing them. Streams with equal bits have equal further numbers in practice, so this
    /// distinguishes streams.
    pub fn preview(&self) -> u128 {
        let mut copy = self.clone();
        (0..4).fold(0, |bits, _| bits << 32 | u128::from(copy.bits()))
    }

    /// Uniform in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        self.place.drawn = self.place.drawn.wrapping_add(2);
        (self.generator.next_u64() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }

    /// Uniform in [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.uniform()
    }

    /// Uniform in 0..bound; 0 if `bound` is 0.
    pub fn below(&mut self, bound: u32) -> u32 {
        ((u64::from(self.bits()) * u64::from(bound)) >> 32) as u32
    }

    /// True with the given probability; at 0 and below never, at 1 and above always.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.uniform() < probability
    }

    /// Normally distributed (Box and Muller 1958); one of each pair is thrown away, so that the
    /// stream holds no hidden state.
    pub fn normal(&mut self, mean: f64, deviation: f64) -> f64 {
        let radius = math::sqrt(-2.0 * math::log(1.0 - self.uniform()));
        mean + deviation * radius * math::cos(math::TAU * self.uniform())
    }

    /// Exponentially distributed with the given mean.
    pub fn exponential(&mut self, mean: f64) -> f64 {
        -mean * math::log(1.0 - self.uniform())
    }
}

/// Mixes a seed and a key into 64 well-spread bits: the finaliser of SplitMix64 (Steele, Lea and
/// Flood 2014) after each word.
pub fn hash_key(seed: u64, key: &[u64]) -> u64 {
    key.iter().fold(mix(seed), |hash, &word| mix(hash ^ word))
}

fn mix(word: u64) -> u64 {
    let mut z = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
