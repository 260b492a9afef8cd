//! Which algorithm elects, and how patiently.

use starl_core::{Duration, Time};

pub use starl_core::event::agreement::Algorithm;

/// Settings of [`super::LeaderElection`]; all participants should have the same. Times run on the robot's
/// own clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// How a leader is found. Default `Leases`.
    pub algorithm: Algorithm,
    /// Leases: a vote binds a robot for this time. A leader that is cut off leads no longer than this,
    /// and a robot that starts does not vote for this time. Default 3 s.
    pub lease: Duration,
    /// Leases: no clock runs faster or slower than true time by more than this share. Default 0.01.
    pub drift: f64,
    /// The time between two messages by which a leader says that it leads. Default 500 ms.
    pub period: Duration,
    /// The time until the first retransmission, then twice that, up to four times the period. Use a few times the
    /// network's delay. Default 250 ms.
    pub first_timeout: Duration,
    /// Bully: a greater robot that has not answered for this time counts as failed. Default 1 s.
    pub answer_timeout: Duration,
    /// Ballots and Bully: a leader that has been silent for this time counts as failed, and so does a robot whose
    /// ballot is missing, or that has promised to lead. Default 5 s.
    pub patience: Duration,
    /// An election that has taken this long counts as failed; it continues nevertheless. Default 15 s.
    pub give_up: Duration,
    /// Ballots: each is a number below this. The fewer there are the more draws are tied. Default 2³² - 1.
    pub ballots: u32,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            algorithm: Algorithm::default(),
            lease: Duration::from_seconds(3),
            drift: 0.01,
            period: Duration::from_millis(500),
            first_timeout: Duration::from_millis(250),
            answer_timeout: Duration::from_seconds(1),
            patience: Duration::from_seconds(5),
            give_up: Duration::from_seconds(15),
            ballots: u32::MAX,
        }
    }
}

impl Options {
    /// The time from one message by which a leader says that it leads to the next.
    pub(super) fn period(&self) -> Duration {
        self.period.max(Duration::from_millis(1))
    }

    /// The time to the repetition with this number, from 0.
    pub(super) fn timeout(&self, repetition: u32) -> Duration {
        let first = self.first_timeout.max(Duration::from_millis(1));
        let doubled = first * (1 << repetition.min(20));
        doubled.min((self.period() * 4).max(first))
    }

    /// How long a leader may count on a vote, from when it asked for it: on the fastest clock a vote
    /// binds for no shorter time than this lasts on the slowest.
    pub(super) fn term(&self) -> Duration {
        let drift = self.drift.clamp(0.0, 0.9);
        Duration::from_seconds_f64(self.lease.seconds() * (1.0 - drift) / (1.0 + drift))
    }
}

/// The earlier of a moment and the latest that makes sense. A corruption may have left any.
pub(super) fn no_later(moment: &mut Time, latest: Time) {
    *moment = (*moment).min(latest);
}
