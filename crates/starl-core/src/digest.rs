//! A running hash of events, which shows whether two runs are equal.

use crate::event::Event;
use crate::geometry::{Point, Pose};
use crate::{Destination, RobotId, Time};
use core::fmt;

/// Folds events into 64 bits, the same on every target. It is not a cryptographic hash: it distinguishes runs but does
/// not protect against forgery.
///
/// Each word is multiplied into the state and the high half of the product folded onto the low one
/// (the "folded multiply" of wyhash and of AHash).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest(u64);

impl Default for Digest {
    fn default() -> Digest {
        Digest(0x243f_6a88_85a3_08d3) // the first fractional bits of pi
    }
}

impl Digest {
    /// The hash so far.
    pub fn value(self) -> u64 {
        self.0
    }

    /// Folds in one word.
    pub fn word(&mut self, word: u64) {
        const FACTOR: u64 = 0x9e37_79b9_7f4a_7c15; // 2^64 over the golden ratio
        let (low, high) = product(self.0 ^ word ^ FACTOR.rotate_left(32), FACTOR);
        self.0 = low ^ high.rotate_left(23) ^ self.0.rotate_left(17);
    }

    /// Folds in bytes and their number.
    pub fn bytes(&mut self, bytes: &[u8]) {
        self.word(bytes.len() as u64);
        for chunk in bytes.chunks(8) {
            let mut word = [0; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            self.word(u64::from_le_bytes(word));
        }
    }

    /// Folds in an event and its time.
    pub fn event(&mut self, at: Time, event: &Event) {
        self.word(at.0);
        // The events that make up the bulk of a run are folded word by word; the rest go through
        // their encoding.
        match event {
            Event::Moved(pose) => {
                self.word(1);
                self.pose(pose);
            }
            Event::Estimated(pose) => {
                self.word(2);
                self.pose(pose);
            }
            Event::Sent {
                sequence,
                destination,
                port,
                payload,
            } => {
                self.word(3);
                self.word(match destination {
                    Destination::All => u64::MAX,
                    Destination::Robot(RobotId(id)) => u64::from(*id),
                });
                self.word(u64::from(*sequence) << 32 | u64::from(port.0));
                self.bytes(payload);
            }
            Event::Delivered { from, sequence } => {
                self.word(4);
                self.word(u64::from(*sequence) << 32 | u64::from(from.0));
            }
            Event::Dropped {
                from,
                to,
                sequence,
                reason,
            } => {
                self.word(5 | (*reason as u64) << 8 | to.map_or(0, |to| u64::from(to.0) + 1) << 16);
                self.word(u64::from(*sequence) << 32 | u64::from(from.0));
            }
            other => crate::message::with_encoded(other, |bytes| self.bytes(bytes)),
        }
    }

    fn pose(&mut self, pose: &Pose) {
        let Point { x, y, z } = pose.position;
        for number in [x, y, z, pose.yaw, pose.pitch, pose.roll] {
            self.word(number.to_bits());
        }
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

/// The low and the high word of the product of two words.
#[cfg(not(target_family = "wasm"))]
fn product(a: u64, b: u64) -> (u64, u64) {
    let product = u128::from(a) * u128::from(b);
    (product as u64, (product >> 64) as u64)
}

/// The same from products of half words: WebAssembly has no larger ones, and calls a routine for 128 bits.
#[cfg(target_family = "wasm")]
fn product(a: u64, b: u64) -> (u64, u64) {
    const HALF: u64 = u32::MAX as u64;
    let (low_a, high_a, low_b, high_b) = (a & HALF, a >> 32, b & HALF, b >> 32);
    let low = low_a * low_b;
    let first = high_a * low_b + (low >> 32);
    let second = low_a * high_b + (first & HALF);
    let high = high_a * high_b + (first >> 32) + (second >> 32);
    (a.wrapping_mul(b), high)
}
