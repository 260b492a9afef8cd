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
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::{Duration, Random, RobotId};

/// After this number of comparisons without an answer, a robot is taken for one that is only heard. With a third of all
/// datagrams lost, this is rarely wrong.
const UNANSWERED: u8 = 8;

/// The greatest number of robots that an announcement names.
const MOST_COMPARED: usize = 8;

/// The number of hops from a robot without answers within which others send elements unasked, plus one.
pub(super) const FARTHEST: u8 = 8;

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
    /// Robots whose comparisons have arrived since the last announcement.
    pub compared: Vec<RobotId>,
    /// How many comparisons with these robots have had no answer.
    unanswered: BTreeMap<RobotId, u8>,
    /// If above 0, some robot does not hear one that hears it, so that they cannot compare their memories. Then all send
    /// elements unasked with their announcements, so that these robots get them from any others that they hear. The
    /// robot without answers starts at [`FARTHEST`], and those that hear of it continue with one less.
    pub unasked: u8,
    /// The key after the last one that was sent unasked.
    pub next: u64,
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

    /// A comparison of a robot has arrived.
    pub fn is_compared_by(&mut self, peer: RobotId) {
        if self.compared.len() < MOST_COMPARED && !self.compared.contains(&peer) {
            self.compared.push(peer);
        }
    }

    /// A comparison with a robot begins.
    pub fn compare_with(&mut self, peer: RobotId) {
        let unanswered = self.unanswered.entry(peer).or_default();
        *unanswered = unanswered.saturating_add(1);
        if *unanswered >= UNANSWERED {
            self.unasked = FARTHEST;
        }
    }

    /// A robot hears this one.
    pub fn is_answered_by(&mut self, peer: RobotId) {
        self.unanswered.remove(&peer);
    }

    /// A robot has announced that some memories cannot be compared.
    pub fn hear_unasked(&mut self, theirs: u8) {
        self.unasked = self.unasked.max(theirs.min(FARTHEST).saturating_sub(1));
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
