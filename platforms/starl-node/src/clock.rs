//! The clock of the process: nanoseconds since the fleet's epoch.

use starl_core::Time;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

/// The time since an epoch that all robots of a fleet share. It is monotonic: the system's clock is read once, and a
/// monotonic one from then on.
#[derive(Clone, Copy, Debug)]
pub struct WallClock {
    /// When the system's clock was read.
    start: Instant,
    /// How long after the epoch that was.
    offset: Duration,
}

impl WallClock {
    /// A clock that counts from `epoch`, a time of the system's clock since 1970. If the epoch is in the future, it
    /// shows 0 now.
    pub fn since(epoch: Duration) -> WallClock {
        WallClock {
            start: Instant::now(),
            offset: WallClock::system().saturating_sub(epoch),
        }
    }

    /// The system's clock: the time since 1970.
    pub fn system() -> Duration {
        SystemTime::now()
            .duration_since(UNIX_EPOCH)
            .unwrap_or_default()
    }

    /// The time now.
    pub fn now(&self) -> Time {
        self.at(Instant::now())
    }

    /// The time at `instant`.
    pub fn at(&self, instant: Instant) -> Time {
        let elapsed = self.offset + instant.saturating_duration_since(self.start);
        Time(u64::try_from(elapsed.as_nanos()).unwrap_or(u64::MAX))
    }

    /// How long it is until `time`; nothing if that has passed.
    pub fn until(&self, time: Time) -> Duration {
        Duration::from_nanos(time.0.saturating_sub(self.now().0))
    }
}
