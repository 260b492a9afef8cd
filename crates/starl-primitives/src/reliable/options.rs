//! How often and how long the protocol tries, and what that promises.

use starl_core::{Duration, math};

/// Settings of [`super::Reliable`]. Time-outs run on the robot's own clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// A message that is not acknowledged is sent again after this time. Default 250 ms, the
    /// original StarL's; best a little above the round trip.
    pub first_timeout: Duration,
    /// Each further time-out is twice the one before, up to this. Default 2 s.
    pub longest_timeout: Duration,
    /// Each time-out is stretched by a random factor of at most 1 + jitter, so that robots that lost
    /// their messages together do not send again together. In [0, 1]; default 0.25.
    pub jitter: f64,
    /// A message is sent again at most this often; then its failure is reported. Default 15.
    pub retries: u32,
    /// Whether each receiver takes a sender's messages in the order in which they were sent. Then a
    /// lost message holds back later ones until it arrives or its sender gives it up. Default false.
    pub first_in_first_out: bool,
    /// With more messages than this on their way the oldest is given up. Default 1024.
    pub most_outstanding: u32,
    /// A receiver keeps at most this many messages of one sender that wait for an earlier one, or
    /// gaps between those that came; what exceeds it is not acknowledged, so its sender tries it
    /// again. Default 64.
    pub most_gaps: u32,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            first_timeout: Duration::from_millis(250),
            longest_timeout: Duration::from_seconds(2),
            jitter: 0.25,
            retries: 15,
            first_in_first_out: false,
            most_outstanding: 1024,
            most_gaps: 64,
        }
    }
}

impl Options {
    /// The time-out after the transmission numbered `attempt` (the first is 0), jitter left out.
    pub fn timeout(&self, attempt: u32) -> Duration {
        let doubled = self.first_timeout * (1u64 << attempt.min(32));
        doubled.min(self.longest_timeout.max(self.first_timeout))
    }

    /// The jitter, made a number in [0, 1].
    pub(super) fn safe_jitter(&self) -> f64 {
        // Written so that NaN becomes zero.
        if self.jitter > 0.0 {
            self.jitter.min(1.0)
        } else {
            0.0
        }
    }

    /// The last copy of a message is sent no later than this after the first.
    pub fn retry_span(&self) -> Duration {
        self.span_before(self.retries)
    }

    /// Success or failure of a message is known no later than this after it was sent: in FIFO order
    /// two time-outs more than otherwise, in which messages held back are released.
    pub fn failure_bound(&self) -> Duration {
        let extra = if self.first_in_first_out { 3 } else { 1 };
        self.span_before(self.retries.saturating_add(extra))
    }

    /// The thesis's d1 and d2: over a network that delivers a datagram within `longest_delay` or not
    /// at all, a message arrives no later than this after it was sent, or never. In FIFO order a
    /// receiver may hold it back as long as its sender tries it or a message before it.
    pub fn delivery_bound(&self, longest_delay: Duration) -> Duration {
        let last = if self.first_in_first_out {
            self.failure_bound()
        } else {
            self.retry_span()
        };
        last + longest_delay
    }

    /// Within this time a message arrives with probability at least `1 - miss`, if each datagram is
    /// lost independently with probability `loss` and otherwise delivered within `longest_delay`.
    /// None where the retries do not suffice for that.
    pub fn likely_delivery_bound(
        &self,
        longest_delay: Duration,
        loss: f64,
        miss: f64,
    ) -> Option<Duration> {
        if loss <= 0.0 {
            return Some(longest_delay);
        }
        // The smallest number of copies that are all lost with probability at most `miss`.
        let copies = math::ceil(math::log(miss) / math::log(loss)).max(1.0);
        let retries = copies - 1.0;
        (loss < 1.0 && retries <= f64::from(self.retries))
            .then(|| self.span_before(retries as u32) + longest_delay)
    }

    /// The longest time from the first transmission to the one numbered `attempt`.
    fn span_before(&self, attempt: u32) -> Duration {
        let mut span = Duration::ZERO;
        for earlier in 0..attempt {
            let timeout = self.timeout(earlier);
            if timeout == self.timeout(attempt) {
                // All that follow are as long.
                span = span + timeout * u64::from(attempt - earlier);
                break;
            }
            span = span + timeout;
        }
        Duration::from_seconds_f64(span.seconds() * (1.0 + self.safe_jitter()))
    }
}
