//! The time of a write: hybrid logical clocks (Kulkarni, Demirbas, Madappa, Avva, Leone 2014, "Logical Physical Clocks
//! and Consistent Snapshots in Globally Distributed Databases").
//!
//! A clock shows the robot's own time, or the latest time that it has heard of if that is later, and counts events
//! while that time does not advance. Invariants: a robot's readings only grow; and they are greater than every reading
//! that has reached it (Lamport 1978), so a write by a robot that knows of another write is always the later one,
//! however wrong the clocks are. A clock is ahead of its robot's time by no more than the fleet's clocks differ, so
//! where they agree stamps are times.
//!
//! Where ours differs: receiving does not count, because it creates no stamp; and readings have an upper limit that is
//! the same for all robots, instead of a bound on their distance from the receiver's own time. With a bound by each
//! robot's own clock, some robots would accept a write that others reject permanently.

use serde::{Deserialize, Serialize};
use starl_core::{RobotId, Time};

/// The latest time of any clock: 146 years. A robot's own time beyond this counts as this, and only the count grows.
pub(super) const LATEST: Time = Time(u64::MAX >> 2);

/// Orders the writes: the greatest wins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Stamp {
    /// The writer's hybrid clock. Its own time, or a later one that it had heard of.
    pub time: Time,
    /// Counts the stamps of this time.
    pub count: u32,
    /// The writer; decides between writes at equal readings of two clocks.
    pub writer: RobotId,
    /// Its life. A restarted robot may hear a reading that it had already used, and continue from there as before; the
    /// life keeps its stamps unique.
    pub incarnation: u32,
}

impl Stamp {
    /// The reading of the writer's clock.
    pub(super) fn clock(self) -> HybridClock {
        HybridClock {
            time: self.time,
            count: self.count,
        }
    }
}

/// A reading of a hybrid logical clock, and the clock itself, which is its last reading.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) struct HybridClock {
    pub time: Time,
    pub count: u32,
}

impl HybridClock {
    /// Whether a clock of ours can show this.
    pub fn is_valid(self) -> bool {
        self.time <= LATEST
    }

    /// The next reading, above all before it.
    pub fn tick(&mut self, now: Time) -> HybridClock {
        self.refresh();
        let now = now.min(LATEST);
        if now > self.time {
            *self = HybridClock {
                time: now,
                count: 0,
            };
        } else if let Some(count) = self.count.checked_add(1) {
            self.count = count;
        } else if self.time < LATEST {
            *self = HybridClock {
                time: Time(self.time.0 + 1),
                count: 0,
            };
        }
        *self
    }

    /// Records another clock's reading.
    pub fn observe(&mut self, other: HybridClock) {
        if other.is_valid() {
            *self = (*self).max(other);
        }
    }

    /// Restarts if it shows an impossible value, which only a corruption causes.
    pub fn refresh(&mut self) {
        if !self.is_valid() {
            *self = HybridClock::default();
        }
    }

    /// Its current reading.
    pub fn show(self, now: Time) -> HybridClock {
        let own = HybridClock {
            time: now.min(LATEST),
            count: 0,
        };
        self.max(own)
    }
}
