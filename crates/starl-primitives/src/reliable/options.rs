//! How often and how long the protocol tries, and what that promises.

use starl_core::{Duration, Time, math};

/// Settings of [`super::Reliable`]. Time-outs run on the robot's own clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// A message without acknowledgement is retransmitted after this time. Default 250 ms, the original StarL's; use a
    /// little more than the round trip. A receiver acknowledges at most five times as often, for all messages that
    /// arrived meanwhile.
    pub first_timeout: Duration,
    /// Each further time-out is twice the one before, up to this. Default 2 s.
    pub longest_timeout: Duration,
    /// Each time-out is stretched by a random factor of at most 1 + jitter, so that robots that lost
    /// their messages together do not send again together. In [0, 1]; default 0.25.
    pub jitter: f64,
    /// A receiver that says nothing is tried again at most this often; then the failure of the message is
    /// reported. A sender that a receiver does not know is asked which life it has as often. Default 15.
    pub retries: u32,
    /// Whether each receiver takes a sender's messages in the order in which they were sent. Then a
    /// lost message holds back later ones until it arrives or its sender gives it up. Default false.
    pub first_in_first_out: bool,
    /// With more messages than this on their way the oldest is given up, and its failure reported. Default
    /// 4096.
    pub most_outstanding: u32,
    /// A receiver accepts messages up to this number after the first missing one; messages further ahead are sent again
    /// when there is room. Default 256.
    pub window: u32,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            first_timeout: Duration::from_millis(250),
            longest_timeout: Duration::from_seconds(2),
            jitter: 0.25,
            retries: 15,
            first_in_first_out: false,
            most_outstanding: 4096,
            window: 256,
        }
    }
}

impl Options {
    /// The time-out after the transmission numbered `attempt` (the first is 0), jitter left out.
    pub fn timeout(&self, attempt: u32) -> Duration {
        let doubled = self.first_timeout * (1u64 << attempt.min(32));
        doubled.min(self.longest_timeout.max(self.first_timeout))
    }

    /// The time-out after the transmission numbered `attempt`, with this share of the jitter, in [0, 1].
    pub(super) fn stretched(&self, attempt: u32, share: f64) -> Duration {
        let factor = 1.0 + self.safe_jitter() * share;
        Duration::from_seconds_f64(self.timeout(attempt).seconds() * factor)
    }

    /// The jitter, made a number in [0, 1].
    fn safe_jitter(&self) -> f64 {
        // Written so that NaN becomes zero.
        if self.jitter > 0.0 {
            self.jitter.min(1.0)
        } else {
            0.0
        }
    }

    /// The last copy of a message is sent no later than this after the first.
    pub fn retry_span(&self) -> Duration {
        self.span_before(self.retries.saturating_add(1))
    }

    /// Success or failure of a message is known no later than this after it was sent: in FIFO order
    /// a little later than otherwise, since messages that are held back have to be released.
    pub fn failure_bound(&self) -> Duration {
        let slack = self.first_timeout * u64::from(self.first_in_first_out);
        self.patience(self.first_in_first_out) + slack
    }

    /// The time for which a message is retransmitted, by whether a receiver holds it back.
    pub(super) fn patience(&self, is_held: bool) -> Duration {
        let timeout = self.longest_timeout.max(self.first_timeout);
        self.retry_span() + timeout * (2 * u64::from(is_held))
    }

    /// When a sender is answered that was last answered at some time.
    pub(super) fn answer_time(&self, last: Option<Time>, now: Time) -> Time {
        match last {
            // A clock that was set back must not put it off.
            Some(last) if last <= now => last + self.first_timeout / 5,
            _ => now,
        }
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

    /// Within this time a message arrives with probability at least `1 - miss` at a robot that has heard of
    /// this one since both started, if each datagram is lost independently with probability `loss` and
    /// otherwise delivered within `longest_delay`. None where the retries do not suffice for that.
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
        (loss < 1.0 && retries <= f64::from(self.retries)).then(|| {
            let span = self.span_before(retries as u32).seconds() * (1.0 + self.safe_jitter());
            Duration::from_seconds_f64(span) + longest_delay
        })
    }

    /// The time from the first transmission to the one numbered `attempt`, jitter left out.
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
        span
    }
}
