//! How patiently a robot asks others for their copies, and how much is kept.

use starl_core::Duration;

/// Settings of [`super::Register`]; all robots should have the same. Times run on the robot's own clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// A question is repeated after this time to robots that have not answered; use a few times the network's delay.
    /// Default 250 ms.
    pub first_timeout: Duration,
    /// The time between repetitions doubles up to this. Default 2 s.
    pub longest_timeout: Duration,
    /// An operation for which no majority has answered for this long says so. Default 3 s.
    pub patience: Duration,
    /// If all robots that are heard have just started, a robot waits this long for one that has not. Default 1 s.
    pub grace: Duration,
    /// After a change copies are compared within this time. Default 500 ms.
    pub shortest_interval: Duration,
    /// While nothing changes the time between comparisons doubles up to this. Default 4 s.
    pub longest_interval: Duration,
    /// Lists of registers are cut into datagrams no longer than this, bytes; one whose only value is longer
    /// is sent as it is. Default 1200, which fits the smallest packet that every IPv6 network carries.
    pub longest_datagram: usize,
    /// Longer values are refused, bytes. Default 60,000, which fits a UDP datagram.
    pub longest_value: usize,
    /// At most this many registers are kept; a write to another one finds no quorum. Default 10,000.
    pub most_registers: usize,
    /// At most this many operations are under way on a robot. Default 64.
    pub most_operations: usize,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            first_timeout: Duration::from_millis(250),
            longest_timeout: Duration::from_seconds(2),
            patience: Duration::from_seconds(3),
            grace: Duration::from_seconds(1),
            shortest_interval: Duration::from_millis(500),
            longest_interval: Duration::from_seconds(4),
            longest_datagram: 1200,
            longest_value: 60_000,
            most_registers: 10_000,
            most_operations: 64,
        }
    }
}

impl Options {
    /// The time to the repetition with this number, from 0.
    pub(super) fn timeout(&self, repetition: u32) -> Duration {
        let first = self.first_timeout.max(Duration::from_millis(1));
        let doubled = first.0.saturating_mul(1 << repetition.min(20));
        Duration(doubled.min(self.longest_timeout.max(first).0))
    }

    /// Intervals between these, made a sensible range.
    pub(super) fn intervals(&self) -> (Duration, Duration) {
        let shortest = self.shortest_interval.max(Duration::from_millis(1));
        (shortest, self.longest_interval.max(shortest))
    }
}
