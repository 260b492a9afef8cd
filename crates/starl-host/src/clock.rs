//! A robot's own clock, which may be ahead of the host's and may run at another rate.

use starl_core::{Duration, Time};

/// Turns the host's time into the robot's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    /// How far the clock was ahead when the host's showed 0, nanoseconds; negative if it was behind. A clock
    /// that would show a time before 0 shows 0.
    pub offset: i64,
    /// Seconds it counts in a second of the host's clock.
    pub rate: f64,
}

impl Default for Clock {
    /// The host's clock itself.
    fn default() -> Clock {
        Clock {
            offset: 0,
            rate: 1.0,
        }
    }
}

impl Clock {
    /// The time that the clock shows at a moment of the host's.
    #[inline]
    pub fn read(&self, now: Time) -> Time {
        let elapsed = match self.rate {
            1.0 => now.0,
            rate => (now.0 as f64 * rate) as u64,
        };
        Time(elapsed.saturating_add_signed(self.offset))
    }

    /// How long a span of this clock takes by the host's.
    #[inline]
    pub fn real(&self, span: Duration) -> Duration {
        if self.rate == 1.0 {
            return span;
        }
        Duration((span.0 as f64 / self.rate) as u64)
    }
}
