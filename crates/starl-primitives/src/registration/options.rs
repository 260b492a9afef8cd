//! The timing of agreements, and the resulting guarantees.

use starl_core::Duration;

/// Settings of [`super::Registration`], the same on all robots. Times run on the robot's own clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Changes within this time are combined, and the times of different lists are at least this far apart (the
    /// thesis's d). Default 200 ms.
    pub settle: Duration,
    /// A robot that has just registered listens for others this long before it makes a list itself; use `settle` plus a
    /// few times the network's delay. Default 400 ms.
    pub gather: Duration,
    /// The time until a retransmission; use a few times the network's delay. Default 250 ms.
    pub first_timeout: Duration,
    /// The time between repetitions doubles up to this. Default 2 s.
    pub longest_timeout: Duration,
    /// A robot that has not answered after as many repetitions is left out. Default 6.
    pub repetitions: u32,
    /// A robot that has no list makes itself known again after this time, then at intervals that double up
    /// to four times as much. Default 500 ms.
    pub shortest_interval: Duration,
    /// While robots show a list, one of them makes it known in each such time. Default 4 s.
    pub longest_interval: Duration,
    /// Without a list for this time, [`super::Registration::failed`] says so. Default 10 s.
    pub patience: Duration,
    /// The greatest length of a list; robots with greater numbers are left out. Default 512.
    pub most_members: u32,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            settle: Duration::from_millis(200),
            gather: Duration::from_millis(400),
            first_timeout: Duration::from_millis(250),
            longest_timeout: Duration::from_seconds(2),
            repetitions: 6,
            shortest_interval: Duration::from_millis(500),
            longest_interval: Duration::from_seconds(4),
            patience: Duration::from_seconds(10),
            most_members: 512,
        }
    }
}

impl Options {
    /// The time to the repetition with this number, from 0.
    pub(super) fn timeout(&self, repetition: u32) -> Duration {
        let first = self.first_timeout.max(Duration::from_millis(1));
        doubled(first, repetition, self.longest_timeout)
    }

    /// The time to the next announcement of a robot that has made this number of announcements without a list, or with
    /// the same list.
    pub(super) fn interval(&self, announcements: u32, shows: bool) -> Duration {
        let first = self.shortest_interval.max(Duration::from_millis(1));
        let longest = if shows {
            self.longest_interval
        } else {
            first * 4
        };
        doubled(first, announcements, longest)
    }

    /// Without loss, restarts and partitions, and with delays up to `longest_delay`, each robot that
    /// registers shows a list with itself after this time, or a multiple of it where others register and
    /// leave meanwhile.
    pub fn agreement_bound(&self, longest_delay: Duration) -> Duration {
        self.gather.max(self.settle * 2) + longest_delay * 4
    }

    /// A robot that never answers is left out of the list after this time.
    pub fn exclusion_bound(&self) -> Duration {
        let timeouts = (0..=self.repetitions.min(1000)).map(|repetition| self.timeout(repetition));
        timeouts.fold(Duration::ZERO, |sum, timeout| sum + timeout)
    }
}

/// `first`, doubled so often, up to `longest`.
fn doubled(first: Duration, times: u32, longest: Duration) -> Duration {
    Duration(first.0.saturating_mul(1 << times.min(20))).min(longest.max(first))
}
