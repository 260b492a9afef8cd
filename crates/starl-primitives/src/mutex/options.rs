//! Which algorithm gives out resources, and how patiently a robot asks.

use starl_core::Duration;

/// The algorithm by which robots agree. All robots must use the same for one mutex.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Algorithm {
    /// All others permit each request (Ricart and Agrawala 1981): the fewest rounds.
    #[default]
    Permission,
    /// Some two square roots of the participants grant it (Maekawa 1985): the fewest messages.
    Quorum,
    /// A majority grants it for a while, with a number that distinguishes later grants from earlier
    /// ones (Gray and Cheriton 1989): the holder may fail.
    Lease,
}

/// Settings of [`super::Mutex`]. Times run on the robot's own clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// How robots agree. Default [`Algorithm::Permission`].
    pub algorithm: Algorithm,
    /// A request is repeated after this time to robots that have not permitted it; use a few times the network's delay.
    /// Default 250 ms.
    pub first_timeout: Duration,
    /// The time between repetitions doubles up to this. Default 2 s.
    pub longest_timeout: Duration,
    /// The duration of a majority's grant: [`Algorithm::Lease`] only, and the same on all robots. The resources
    /// of a failed robot are free after this time. The lease is renewed when half of it is left, so it should be
    /// many times the network's delay. Default 2 s.
    pub lease: Duration,
    /// No robot's clock runs faster or slower than true time by more than this share: for
    /// [`Algorithm::Lease`]. Default 0.01.
    pub drift: f64,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            algorithm: Algorithm::default(),
            first_timeout: Duration::from_millis(250),
            longest_timeout: Duration::from_seconds(2),
            lease: Duration::from_seconds(2),
            drift: 0.01,
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
