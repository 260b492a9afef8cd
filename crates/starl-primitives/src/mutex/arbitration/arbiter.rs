//! A robot as an arbiter: the requests to it, and its grants.
//!
//! Each robot requests one set at a time, so there is one entry for each. An arbiter grants a request that overlaps
//! neither with a granted request nor with an earlier waiting one. If an earlier request waits for a later one, the
//! arbiter asks that one to yield (Maekawa 1985, with sets instead of the one resource), which it does immediately
//! unless it has entered. So the earliest of a set of waiting requests waits only for robots that have entered, and
//! there is no deadlock (which Maekawa's original has: Sanders 1987).
//!
//! Waiting robots get no messages, except a robot that waits for a failed one: a crowd of n that asks repeatedly
//! would cause n answers each time. Only a grant without news for a while is queried.
//!
//! Invariant: the requests that are granted are disjoint.

use super::super::Resources;
use super::super::common::RequestId;
use super::super::lease::Numbers;
use super::Post;
use super::entry::{Entry, Terms, inquire, is_later};
use super::packet::{Behind, Packet, Wish};
use super::saving::Kept;
use super::standing::standings;
use crate::copies::is_copy;
use alloc::collections::BTreeMap;
use starl_core::{Random, RobotId};

/// The state of an arbiter.
#[derive(Clone, Debug, Default)]
pub(super) struct Arbiter {
    entries: BTreeMap<RobotId, Entry>,
    /// The last request of each robot that is over.
    finished: BTreeMap<RobotId, RequestId>,
    /// The last request of each robot that ended without a word.
    expired: BTreeMap<RobotId, Expired>,
    pub numbers: Numbers,
}

/// A request whose time is over.
#[derive(Clone, Copy, Debug)]
struct Expired {
    id: RequestId,
    /// The last round of asking.
    round: u32,
    /// It was granted, and the robot did not hear of it.
    is_deaf: bool,
}

impl Arbiter {
    /// A robot requests, repeats its request, or renews its lease.
    pub fn request(&mut self, from: RobotId, wish: Wish, terms: Terms, post: &mut Post) {
        let before = self.entries.len();
        self.expire(terms);
        let id = wish.id;
        let last = self.finished.get(&from).copied();
        let known = self.entries.get(&from).map(|entry| entry.wish.id);
        for before in last.into_iter().chain(known.filter(|&known| known != id)) {
            if before.incarnation == id.incarnation && id.number <= before.number {
                return post.send(from, Packet::Outdated { id });
            }
        }
        let (mut is_repeated, mut is_news) = (false, true);
        match self.entries.get_mut(&from) {
            Some(entry) if entry.wish.id == id => {
                if is_later(entry.wish.attempt, wish.attempt) {
                    // Sent before the robot yielded, or its count is wrong.
                    return inquire(from, entry, false, post);
                }
                if wish.attempt != entry.wish.attempt {
                    *entry = Entry::new(wish, terms);
                } else {
                    is_repeated = true;
                    is_news = entry.wish.clock != wish.clock
                        || entry.is_granted
                        || wish.is_entered
                        || entry.is_last && wish.hears;
                    entry.wish.is_entered = wish.is_entered;
                    // Late copies must not keep the lease of a robot that is gone.
                    if !is_copy(wish.round, entry.wish.round) {
                        entry.wish.round = wish.round;
                        if wish.hears {
                            entry.known = terms.now;
                            entry.is_last = false;
                        }
                        if entry.may_be_renewed(terms) {
                            entry.until = terms.until();
                            entry.renewed = wish.round;
                        }
                    }
                    entry.heard = terms.now;
                    if terms.lease.is_none() || entry.is_last {
                        entry.told = None;
                    }
                    entry.wish.clock = wish.clock;
                    entry.wish.number = entry.wish.number.max(wish.number);
                    if entry.is_granted {
                        // It may have given back some of it.
                        entry.wish.resources.retain(|r| wish.resources.contains(r));
                    } else {
                        is_news |= entry.wish.resources != wish.resources;
                        entry.wish.resources = wish.resources;
                    }
                }
            }
            Some(entry) if entry.is_granted && entry.wish.id.incarnation != id.incarnation => {
                // One of the two is from before a restart, and it is unknown which.
                return inquire(from, entry, false, post);
            }
            _ => {
                let expired = self.expired.get(&from).filter(|expired| expired.id == id);
                if expired.is_some_and(|expired| is_copy(wish.round, expired.round)) {
                    return;
                }
                let is_last = expired.is_some_and(|expired| expired.is_deaf) && !wish.hears;
                let entry = Entry {
                    is_last,
                    ..Entry::new(wish, terms)
                };
                self.entries.insert(from, entry);
            }
        }
        if let Some(entry) = self.entries.get(&from).filter(|e| e.wish.is_entered) {
            let held = entry.wish.resources.clone();
            self.end_those_before(from, &held, entry.wish.number, terms);
        }
        if is_repeated && self.entries.get(&from).is_some_and(|e| e.is_granted) {
            self.grant(from, terms, post);
        }
        let is_blocked = is_repeated && self.ask_those_in_the_way(from, terms, post);
        // Most of what a crowd says is only that it still waits.
        if is_news || !is_blocked || self.entries.len() < before || terms.lease.is_none() {
            self.settle(terms, post);
        }
    }

    /// A robot keeps only some of its granted resources, or none.
    pub fn release(
        &mut self,
        from: RobotId,
        id: RequestId,
        (left, number): (&Resources, u64),
        terms: Terms,
        post: &mut Post,
    ) {
        let entry = self.entries.get_mut(&from);
        if let Some(entry) = entry.filter(|entry| entry.wish.id == id) {
            let given_back = entry.wish.resources.clone();
            entry.wish.resources.retain(|r| left.contains(r));
            if number > 0 {
                self.end_those_before(from, &given_back, number, terms);
            }
        }
        if left.is_empty() {
            self.entries
                .retain(|&peer, entry| peer != from || entry.wish.id != id);
            let is_over =
                |last: &RequestId| last.incarnation == id.incarnation && id.number <= last.number;
            if !self.finished.get(&from).is_some_and(is_over) {
                self.finished.insert(from, id);
            }
        }
        self.settle(terms, post);
    }

    /// A robot reports the resources that it holds by a forgotten grant.
    pub fn reinstate(&mut self, from: RobotId, wish: Wish, terms: Terms) {
        let is_over =
            |id: RequestId| id.incarnation == wish.id.incarnation && wish.id.number <= id.number;
        let known = self.entries.get(&from).map(|entry| entry.wish.id);
        let is_newer = known.is_some_and(|id| id != wish.id && is_over(id));
        if is_newer || self.finished.get(&from).is_some_and(|&id| is_over(id)) {
            return;
        }
        self.numbers.learn(&wish.resources, wish.number);
        let entry = Entry {
            is_granted: true,
            number: wish.number,
            ..Entry::new(wish, terms)
        };
        self.entries.insert(from, entry);
    }

    /// The state that must survive a restart; `list` identifies the participants.
    pub fn kept(&self, list: u32) -> Kept {
        let granted = self.entries.iter().filter(|(_, entry)| entry.is_granted);
        let grants = granted.map(|(&robot, entry)| {
            // Renewals do not count.
            let wish = Wish {
                round: 0,
                hears: true,
                ..entry.wish.clone()
            };
            (robot, wish, entry.number)
        });
        Kept {
            grants: grants.collect(),
            finished: self
                .finished
                .iter()
                .map(|(&robot, &id)| (robot, id))
                .collect(),
            list,
            numbers: self.numbers.clone(),
        }
    }

    /// Restores the stored state after a restart.
    pub fn restore(&mut self, kept: Kept, terms: Terms) {
        self.numbers = kept.numbers;
        self.finished = kept.finished.into_iter().collect();
        for (robot, wish, number) in kept.grants {
            let entry = Entry {
                is_granted: true,
                number,
                ..Entry::new(wish, terms)
            };
            self.entries.insert(robot, entry);
        }
    }

    /// A robot has entered: earlier holders of its resources, with lower numbers, hold them no longer.
    fn end_those_before(
        &mut self,
        from: RobotId,
        resources: &Resources,
        number: u64,
        terms: Terms,
    ) {
        if terms.lease.is_none() {
            return;
        }
        self.numbers.learn(resources, number);
        self.entries.retain(|&peer, entry| {
            let is_over = peer != from
                && entry.is_granted
                && entry.number < number
                && !entry.wish.resources.is_disjoint(resources);
            !is_over
        });
    }

    /// Grants possible requests, and informs all other waiting robots.
    pub fn settle(&mut self, terms: Terms, post: &mut Post) {
        self.expire(terms);
        for standing in standings(&self.entries, terms.tells) {
            if let Some(behind) = terms.unready {
                self.tell(standing.robot, behind, terms, post);
                continue;
            }
            if let Some(behind) = standing.behind {
                self.tell(standing.robot, behind, terms, post);
            } else if standing.is_next {
                self.grant(standing.robot, terms, post);
            }
            for peer in standing.granted_before_it {
                if let Some(entry) = self.entries.get_mut(&peer)
                    && !entry.is_inquired
                {
                    entry.is_inquired = true;
                    inquire(peer, entry, true, post);
                }
            }
        }
    }

    /// Waiting robots must be informed again for which robots they wait.
    pub fn tell_again(&mut self) {
        self.entries
            .values_mut()
            .for_each(|entry| entry.told = None);
    }

    /// Forgets robots that no longer participate.
    pub fn keep_only(&mut self, everyone: &[RobotId]) {
        self.entries.retain(|peer, _| everyone.contains(peer));
        self.finished.retain(|peer, _| everyone.contains(peer));
        self.expired.retain(|peer, _| everyone.contains(peer));
    }

    /// Adds the granted and the requested resources.
    pub fn add_resources(&self, known: &mut Resources) {
        for entry in self.entries.values() {
            known.extend(entry.wish.resources.iter().cloned());
        }
        self.numbers.add_resources(known);
    }

    /// Overwrites the state at random.
    pub fn corrupt(&mut self, random: &mut Random) {
        self.entries.retain(|_, _| random.chance(0.5));
        self.finished.retain(|_, _| random.chance(0.5));
        for id in self.finished.values_mut() {
            id.number = u64::from(random.bits());
        }
        for expired in self.expired.values_mut() {
            expired.round = random.bits();
        }
        for entry in self.entries.values_mut() {
            entry.is_granted = random.chance(0.5);
            entry.is_inquired = random.chance(0.5);
            entry.is_last = random.chance(0.5);
            if random.chance(0.5) {
                entry.wish.id.number = u64::from(random.bits());
                entry.wish.attempt = random.bits();
                entry.wish.clock = u64::from(random.bits());
            }
        }
        self.numbers.corrupt(random);
    }

    /// A robot still waits: robots in its way that were not heard for long are asked whether they still need their
    /// grants, and later ones to yield. Returns whether any robot is in its way.
    fn ask_those_in_the_way(&mut self, robot: RobotId, terms: Terms, post: &mut Post) -> bool {
        let Some(waiting) = self.entries.get(&robot).filter(|entry| !entry.is_granted) else {
            return false;
        };
        let (rank, resources) = (waiting.rank(robot), waiting.wish.resources.clone());
        let mut behind = None;
        for (&peer, other) in &mut self.entries {
            let is_later = other.rank(peer) > rank;
            let is_in_the_way = peer != robot && (other.is_granted || !is_later);
            if !is_in_the_way || other.wish.resources.is_disjoint(&resources) {
                continue;
            }
            behind = behind.or(Some(peer));
            if other.is_silent(terms) {
                other.was_asked(terms);
                inquire(peer, other, is_later, post);
            }
        }
        if let Some(behind) = behind {
            self.tell(robot, behind, terms, post);
        }
        behind.is_some()
    }

    fn grant(&mut self, robot: RobotId, terms: Terms, post: &mut Post) {
        let Some(entry) = self.entries.get_mut(&robot) else {
            return;
        };
        let keeps_number = entry.is_granted && entry.wish.number <= entry.number;
        if terms.lease.is_some() && !keeps_number {
            let Wish {
                resources, number, ..
            } = &entry.wish;
            entry.number = self.numbers.next(robot, resources, *number);
        }
        if !entry.is_granted {
            // A grant is repeated for copies of requests too, and only later requests renew the lease.
            entry.until = terms.until();
            entry.renewed = entry.wish.round;
            entry.known = terms.now;
        }
        entry.is_granted = true;
        entry.is_inquired = false;
        entry.told = None;
        let Wish { id, attempt, .. } = entry.wish;
        let grant = Packet::Grant {
            id,
            attempt,
            round: entry.renewed,
            clock: terms.clock,
            number: entry.number,
        };
        post.send(robot, grant);
    }

    /// Tells a robot for which robots it waits, once for each time that it asks. With leases this is unnecessary,
    /// because the grants of a crashed robot end, except for an arbiter that cannot grant anything, and for a robot that
    /// must show that it hears.
    fn tell(&mut self, robot: RobotId, behind: RobotId, terms: Terms, post: &mut Post) {
        let entry = self.entries.get_mut(&robot);
        let is_new = |entry: &&mut Entry| entry.told != Some(behind);
        if let Some(entry) = entry
            .filter(is_new)
            .filter(|entry| terms.tells || entry.is_last)
        {
            entry.told = Some(behind);
            let Wish { id, attempt, .. } = entry.wish;
            let wait = Packet::Wait {
                id,
                attempt,
                clock: terms.clock,
                behind: Behind::Robot(behind),
            };
            post.send(robot, wait);
        }
    }

    /// Drops requests without news for a lease.
    fn expire(&mut self, terms: Terms) {
        if terms.lease.is_some() {
            let longest = terms.until();
            let expired = &mut self.expired;
            self.entries.retain(|&robot, entry| {
                entry.until = entry.until.min(longest);
                let is_over = entry.until <= terms.now;
                if is_over {
                    let is_deaf = entry.is_granted && entry.is_deaf(terms);
                    let (id, round) = (entry.wish.id, entry.wish.round);
                    expired.insert(robot, Expired { id, round, is_deaf });
                }
                !is_over
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use starl_core::{Duration, Time};

    #[test]
    fn a_copy_of_a_request_that_is_granted_does_not_renew_its_lease() {
        let lease = Duration::from_seconds(2);
        let at = |now: u64| Terms {
            now: Time::ZERO + Duration::from_millis(now),
            clock: 0,
            lease: Some(lease),
            patience: lease,
            patience_waiting: lease,
            unready: None,
            tells: false,
        };
        let wish = |round| Wish {
            id: RequestId {
                incarnation: 7,
                number: 1,
            },
            attempt: 0,
            round,
            clock: 1,
            resources: Resources::from(["a".into()]),
            number: 0,
            is_entered: false,
            hears: true,
            list: 0,
        };
        let (mut arbiter, mut post) = (Arbiter::default(), Post::default());
        arbiter.request(RobotId(1), wish(1), at(0), &mut post);
        let until = |arbiter: &Arbiter| arbiter.entries.get(&RobotId(1)).map(|entry| entry.until);
        assert_eq!(until(&arbiter), Some(Time::ZERO + lease));
        arbiter.request(RobotId(1), wish(1), at(1500), &mut post);
        assert_eq!(until(&arbiter), Some(Time::ZERO + lease));
        arbiter.request(RobotId(1), wish(2), at(1600), &mut post);
        let renewed = Time::ZERO + Duration::from_millis(3600);
        assert_eq!(until(&arbiter), Some(renewed));
        assert_eq!(post.0.len(), 3, "the grant is repeated each time");
    }
}
