//! When memories are compared: the Trickle algorithm (Levis, Patel, Culler, Shenker 2004, "Trickle: A
//! Self-Regulating Algorithm for Code Propagation and Maintenance in Wireless Sensor Networks"; RFC
//! 6206).
//!
//! A robot announces its memory at a random moment in the second half of an interval, unless it has heard several equal
//! ones announced meanwhile. Intervals double up to the longest, and fall back to the shortest when memories differ. So
//! the traffic while nothing changes does not grow with the number of robots in range of each other.
//!
//! Where ours differs: the next interval begins with the announcement, not with the end of this one.

use super::Options;
use starl_core::{Duration, Random, RobotId};

/// The rhythm of announcements.
#[derive(Clone, Debug, Default)]
pub(super) struct Gossip {
    /// The present interval.
    pub interval: Duration,
    /// Whether the timer of announcements was ever armed. It is rearmed whenever it fires.
    pub begun: bool,
    /// How many memories equal to its own were announced in this interval.
    pub equal: u32,
    /// The last robot in this interval that showed another memory.
    pub differing: Option<RobotId>,
    /// How often differences have called for haste since this memory last changed.
    pub vain: u32,
}

impl Gossip {
    /// Begins the shortest interval; gives the time until the announcement.
    pub fn begin(&mut self, options: &Options, random: &mut Random) -> Duration {
        self.begun = true;
        self.enter(options.intervals().0, random)
    }

    /// Begins the next interval, twice as long; gives the time until the announcement.
    pub fn next(&mut self, options: &Options, random: &mut Random) -> Duration {
        let (shortest, longest) = options.intervals();
        let doubled = (self.interval * 2).max(shortest).min(longest);
        self.enter(doubled, random)
    }

    /// Whether the shortest interval is still to be begun when something calls for it.
    pub fn is_slow(&self, options: &Options) -> bool {
        self.interval > options.intervals().0
    }

    fn enter(&mut self, interval: Duration, random: &mut Random) -> Duration {
        self.interval = interval;
        self.equal = 0;
        Duration::from_seconds_f64(interval.seconds() * random.between(0.5, 1.0))
    }
}
