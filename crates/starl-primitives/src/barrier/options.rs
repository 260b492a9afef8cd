//! How patiently a robot says that it waits.

use starl_core::Duration;

/// Settings of [`super::Barrier`]. Times run on the robot's own clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// A waiting robot repeats its announcement to silent robots after this time; best a few times the
    /// network's delay. Default 250 ms.
    pub first_timeout: Duration,
    /// The time between repetitions doubles up to this. Default 4 s.
    pub longest_timeout: Duration,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            first_timeout: Duration::from_millis(250),
            longest_timeout: Duration::from_seconds(4),
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
}
