//! The armed timers of one robot.

use starl_core::{Time, TimerKey};

/// Timers by the simulator's time; those due first are last, ready to be taken.
#[derive(Clone, Debug, Default)]
pub struct Timers(Vec<(Time, TimerKey)>);

impl Timers {
    /// Arms a timer, or moves it if it is armed.
    pub fn set(&mut self, at: Time, key: TimerKey) {
        self.cancel(key);
        let place = self.0.partition_point(|&timer| timer > (at, key));
        self.0.insert(place, (at, key));
    }

    /// Forgets a timer.
    pub fn cancel(&mut self, key: TimerKey) {
        self.0.retain(|&(_, armed)| armed != key);
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// When the next one is due.
    pub fn next(&self) -> Time {
        self.0.last().map_or(Time::NEVER, |&(at, _)| at)
    }

    /// Takes the one that is due next.
    pub fn take(&mut self) -> Option<TimerKey> {
        self.0.pop().map(|(_, key)| key)
    }
}
