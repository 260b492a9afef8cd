//! Which algorithm gives out resources, and how patiently a robot asks.

use starl_core::Duration;

/// How robots agree on who has what. All robots must use the same for one mutex.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Algorithm {
    /// All others permit each request (Ricart and Agrawala 1981): the fewest rounds.
    #[default]
    Permission,
}

/// Settings of [`super::Mutex`]. Times run on the robot's own clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// How robots agree. Default [`Algorithm::Permission`].
    pub algorithm: Algorithm,
    /// A request is repeated after this time to those that have not permitted it; best a few times the
    /// network's delay. Default 250 ms.
    pub first_timeout: Duration,
    /// The time between repetitions doubles up to this. Default 2 s.
    pub longest_timeout: Duration,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            algorithm: Algorithm::default(),
            first_timeout: Duration::from_millis(250),
            longest_timeout: Duration::from_seconds(2),
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
