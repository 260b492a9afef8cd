//! The armed timers of one robot.

use smallvec::SmallVec;
use starl_core::{Time, TimerKey};

/// Timers by the host's time; those due first are last, ready to be taken. Most robots have one.
#[derive(Clone, Debug, Default)]
pub struct Timers(SmallVec<[(Time, TimerKey); 1]>);

impl Timers {
    /// Arms a timer, or moves it if it is armed.
    pub fn set(&mut self, at: Time, key: TimerKey) {
        self.cancel(key);
        let place = self.0.partition_point(|&timer| timer > (at, key));
        self.0.insert(place, (at, key));
    }

    /// Forgets a timer.
    pub fn cancel(&mut self, key: TimerKey) {
        self.0.retain(|&mut (_, armed)| armed != key);
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// When the next one is due; [`Time::NEVER`] if none is armed.
    #[inline]
    pub fn next(&self) -> Time {
        self.0.last().map_or(Time::NEVER, |&(at, _)| at)
    }

    /// Takes the one that is due next: of those due at one moment, the one with the smallest key.
    #[inline]
    pub fn take(&mut self) -> Option<TimerKey> {
        self.0.pop().map(|(_, key)| key)
    }

    /// All armed timers with the moments at which they are due, the next one first.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (Time, TimerKey)> {
        self.0.iter().rev().copied()
    }
}
