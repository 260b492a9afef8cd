//! How often memories are compared, and how much they hold.

use starl_core::Duration;

/// Settings of [`super::SharedMemory`]; all robots should have the same. Times run on the robot's own
/// clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// After a change, or when another memory is found to differ, memories are compared within this
    /// time; best several times the network's delay. Default 500 ms.
    pub shortest_interval: Duration,
    /// While nothing changes the time between comparisons doubles up to this. Default 4 s.
    pub longest_interval: Duration,
    /// A robot that hears this many memories equal to its own in an interval does not announce its
    /// own. Default 2.
    pub redundancy: u32,
    /// Datagrams are no longer than this, bytes, except for one whose only value is longer. Default
    /// 1200, which fits the smallest packet that every IPv6 network carries.
    pub longest_datagram: usize,
    /// Longer values are refused, bytes. Default 60,000, which fits a UDP datagram.
    pub longest_value: usize,
    /// At most this many variables and elements are kept; others are refused. Default 100,000.
    pub most_elements: usize,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            shortest_interval: Duration::from_millis(500),
            longest_interval: Duration::from_seconds(4),
            redundancy: 2,
            longest_datagram: 1200,
            longest_value: 60_000,
            most_elements: 100_000,
        }
    }
}

impl Options {
    /// Intervals between these, made a sensible range.
    pub(super) fn intervals(&self) -> (Duration, Duration) {
        let shortest = self.shortest_interval.max(Duration::from_millis(1));
        (shortest, self.longest_interval.max(shortest))
    }

    /// Changes within this time may still be in transit, so they are not repaired.
    pub(super) fn settling(&self) -> Duration {
        self.intervals().0 / 2
    }

    /// A change after this much quiet is worth a comparison soon.
    pub(super) fn quiet(&self) -> Duration {
        self.intervals().0 * 4
    }
}
