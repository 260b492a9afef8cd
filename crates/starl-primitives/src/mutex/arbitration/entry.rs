//! An arbiter's knowledge of one robot's request.

use super::Post;
use super::packet::{Packet, Wish};
use starl_core::{Duration, RobotId, Time};

/// A robot's request.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub wish: Wish,
    pub is_granted: bool,
    /// The robot that it was last told to wait for.
    pub told: Option<RobotId>,
    /// It was asked to yield.
    pub is_inquired: bool,
    /// Without a word from the robot the entry is dropped then.
    pub until: Time,
    /// When it was heard of last, or asked whether it is still needed.
    pub heard: Time,
    /// The number of the grant.
    pub number: u64,
    /// The round of asking since which the grant lasts.
    pub renewed: u32,
    /// When the robot last showed that it hears this arbiter, or was granted its request.
    pub known: Time,
    /// It comes after all others: the robot did not hear of an earlier grant, and may hear of none.
    pub is_last: bool,
}

/// The conditions of an arbiter at one moment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Terms {
    pub now: Time,
    /// Lamport's clock.
    pub clock: u64,
    /// The time after which a silent grant ends; none for never.
    pub lease: Option<Duration>,
    /// The silence after which it asks whether a grant is still needed.
    pub patience: Duration,
    /// The same for waiting requests.
    pub patience_waiting: Duration,
    /// The robot for which it waits before it grants anything; none if it is ready.
    pub unready: Option<RobotId>,
    /// Whether waiting robots receive the names of the robots that they wait for.
    pub tells: bool,
}

impl Terms {
    pub fn until(&self) -> Time {
        self.lease.map_or(Time::NEVER, |lease| self.now + lease)
    }
}

/// Whether a count is beyond another; counts begin again after 2^32.
pub(super) fn is_later(number: u32, other: u32) -> bool {
    (number.wrapping_sub(other) as i32) > 0
}

impl Entry {
    pub fn new(wish: Wish, terms: Terms) -> Entry {
        let renewed = wish.round;
        Entry {
            wish,
            is_granted: false,
            told: None,
            is_inquired: false,
            until: terms.until(),
            heard: terms.now,
            number: 0,
            renewed,
            known: terms.now,
            is_last: false,
        }
    }

    /// Whether another round of asking makes the grant last longer. A robot that does not hear of its grant does not
    /// keep it: it can only be heard, and would be in the way of all others for ever.
    pub fn may_be_renewed(&self, terms: Terms) -> bool {
        !self.is_granted || self.wish.is_entered || !self.is_deaf(terms)
    }

    /// Whether the robot has shown for a lease that it does not hear this arbiter.
    pub fn is_deaf(&self, terms: Terms) -> bool {
        let is_late = |lease| terms.now.since(self.known) >= lease || self.known > terms.now;
        self.is_last || terms.lease.is_some_and(is_late)
    }

    /// Whether it is time to ask if the grant is still needed. A grant that does not end by itself is queried
    /// whenever a robot waits for it.
    pub fn is_silent(&self, terms: Terms) -> bool {
        terms.lease.is_none()
            || terms.now.since(self.heard) >= self.patience(terms)
            || self.heard > terms.now
    }

    /// It was asked, and is asked again soon if it says nothing: the question or the answer may be lost.
    pub fn was_asked(&mut self, terms: Terms) {
        self.heard = terms.now - (self.patience(terms) - terms.patience);
    }

    fn patience(&self, terms: Terms) -> Duration {
        match self.is_granted {
            true => terms.patience,
            false => terms.patience_waiting,
        }
    }

    /// The order of requests: the earlier request goes first, by Lamport's clock.
    pub fn rank(&self, robot: RobotId) -> (bool, u64, RobotId) {
        (self.is_last, self.wish.clock, robot)
    }
}

/// Asks a robot whether it still needs its grant.
pub(super) fn inquire(robot: RobotId, entry: &Entry, must_yield: bool, post: &mut Post) {
    let Wish { id, attempt, .. } = entry.wish;
    let inquire = Packet::Inquire {
        id,
        attempt,
        must_yield,
    };
    post.send(robot, inquire);
}
