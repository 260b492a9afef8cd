//! A robot as an arbiter: who has asked it for what, and whom it has granted what.
//!
//! Each robot asks for one set at a time, so there is one entry for each. An arbiter grants a request that
//! overlaps neither with one that it has granted nor with an earlier one that waits; where an earlier one
//! waits for a later one it asks that one to yield (Maekawa 1985, with sets in place of the one resource).
//! It tells whoever must wait that it must, also one whose turn it was until an earlier request came: that
//! was missing in the original and could deadlock (Sanders 1987).
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
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::{Random, RobotId};

/// The state of an arbiter.
#[derive(Clone, Debug, Default)]
pub(super) struct Arbiter {
    entries: BTreeMap<RobotId, Entry>,
    /// The last request of each robot that is over.
    finished: BTreeMap<RobotId, RequestId>,
    pub numbers: Numbers,
}

impl Arbiter {
    /// A robot asks, asks again, or asks to keep what it has.
    pub fn request(&mut self, from: RobotId, wish: Wish, terms: Terms, post: &mut Post) {
        self.expire(terms);
        let id = wish.id;
        let last = self.finished.get(&from).copied();
        let known = self.entries.get(&from).map(|entry| entry.wish.id);
        for before in last.into_iter().chain(known.filter(|&known| known != id)) {
            if before.incarnation == id.incarnation && id.number <= before.number {
                return post.send(from, Packet::Outdated { id });
            }
        }
        let until = terms.until();
        let mut is_repeated = false;
        match self.entries.get_mut(&from) {
            Some(entry) if entry.wish.id == id => {
                if is_later(entry.wish.attempt, wish.attempt) {
                    // Sent before the robot yielded, or its count is wrong.
                    return inquire(from, entry, false, post);
                }
                if wish.attempt != entry.wish.attempt {
                    *entry = Entry::new(wish, until);
                } else {
                    is_repeated = true;
                    entry.until = until;
                    entry.is_told = false;
                    entry.wish.clock = wish.clock;
                    // An earlier one only makes the robot believe in the lease for less long.
                    entry.wish.round = wish.round;
                    entry.wish.number = entry.wish.number.max(wish.number);
                    if entry.is_granted {
                        // It may have given back some of it.
                        entry.wish.resources.retain(|r| wish.resources.contains(r));
                    } else {
                        entry.wish.resources = wish.resources;
                    }
                }
            }
            Some(entry) if entry.is_granted && entry.wish.id.incarnation != id.incarnation => {
                // One of the two is from before a restart, and nobody can say which.
                return inquire(from, entry, false, post);
            }
            _ => {
                self.entries.insert(from, Entry::new(wish, until));
            }
        }
        if is_repeated && self.entries.get(&from).is_some_and(|e| e.is_granted) {
            self.grant(from, terms, post);
        }
        self.settle(terms, post);
        if is_repeated {
            self.ask_those_in_the_way(from, terms, post);
        }
    }

    /// A robot keeps only some of what it was granted, or nothing.
    pub fn release(
        &mut self,
        from: RobotId,
        id: RequestId,
        left: &Resources,
        terms: Terms,
        post: &mut Post,
    ) {
        let entry = self.entries.get_mut(&from);
        if let Some(entry) = entry.filter(|entry| entry.wish.id == id) {
            entry.wish.resources.retain(|r| left.contains(r));
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

    /// A robot says what it holds by a grant that was forgotten.
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
            ..Entry::new(wish, terms.until())
        };
        self.entries.insert(from, entry);
    }

    /// What is to outlast a restart; `list` stands for the participants.
    pub fn kept(&self, list: u32) -> Kept {
        let granted = self.entries.iter().filter(|(_, entry)| entry.is_granted);
        let grants = granted.map(|(&robot, entry)| {
            // Renewals do not count.
            let round = 0;
            let wish = Wish {
                round,
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

    /// Takes up what was kept over a restart.
    pub fn restore(&mut self, kept: Kept, terms: Terms) {
        self.numbers = kept.numbers;
        self.finished = kept.finished.into_iter().collect();
        for (robot, wish, number) in kept.grants {
            let entry = Entry {
                is_granted: true,
                number,
                ..Entry::new(wish, terms.until())
            };
            self.entries.insert(robot, entry);
        }
    }

    /// Grants what can be granted, and tells all others how it stands.
    pub fn settle(&mut self, terms: Terms, post: &mut Post) {
        self.expire(terms);
        for standing in standings(&self.entries) {
            if let Some(behind) = terms.unready {
                self.tell(standing.robot, behind, true, terms, post);
                continue;
            }
            if let Some(behind) = standing.behind {
                self.tell(standing.robot, behind, true, terms, post);
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

    /// Forgets those who no longer take part.
    pub fn keep_only(&mut self, everyone: &[RobotId]) {
        self.entries.retain(|peer, _| everyone.contains(peer));
        self.finished.retain(|peer, _| everyone.contains(peer));
    }

    /// Adds what was granted, and what is asked for.
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
        for entry in self.entries.values_mut() {
            entry.is_granted = random.chance(0.5);
            entry.is_told = random.chance(0.5);
            entry.is_inquired = random.chance(0.5);
            if random.chance(0.5) {
                entry.wish.id.number = u64::from(random.bits());
                entry.wish.attempt = random.bits();
                entry.wish.clock = u64::from(random.bits());
            }
        }
        self.numbers.corrupt(random);
    }

    /// Those that have to give way to a request or to be waited for: before it in line, and those that have
    /// been granted what it wants though they come after it.
    fn in_the_way(&self, robot: RobotId) -> (Vec<RobotId>, Vec<RobotId>) {
        let Some(entry) = self.entries.get(&robot) else {
            return Default::default();
        };
        let rank = entry.rank(robot);
        let overlapping = self.entries.iter().filter(|&(&peer, other)| {
            peer != robot
                && (other.is_granted || other.rank(peer) < rank)
                && !other.wish.resources.is_disjoint(&entry.wish.resources)
        });
        overlapping
            .map(|(&peer, other)| (peer, other.rank(peer) < rank))
            .fold(
                Default::default(),
                |mut sides: (Vec<_>, Vec<_>), (peer, is_before)| {
                    let side = if is_before {
                        &mut sides.0
                    } else {
                        &mut sides.1
                    };
                    side.push(peer);
                    sides
                },
            )
    }

    /// A request was repeated and still waits: what it waits for may be over without a word, also what waits itself
    /// for what nobody else asks for.
    fn ask_those_in_the_way(&mut self, robot: RobotId, terms: Terms, post: &mut Post) {
        if self
            .entries
            .get(&robot)
            .is_none_or(|entry| entry.is_granted)
        {
            return;
        }
        let (before, after) = self.in_the_way(robot);
        if before.is_empty()
            && let Some(&behind) = after.first()
        {
            self.tell(robot, behind, false, terms, post);
        }
        let both = before.into_iter().map(|peer| (peer, false));
        for (peer, must_yield) in both.chain(after.into_iter().map(|peer| (peer, true))) {
            if let Some(entry) = self.entries.get(&peer) {
                inquire(peer, entry, must_yield, post);
            }
        }
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
        entry.is_granted = true;
        entry.is_inquired = false;
        entry.is_told = false;
        entry.until = terms.until();
        let Wish {
            id, attempt, round, ..
        } = entry.wish;
        let grant = Packet::Grant {
            id,
            attempt,
            round,
            clock: terms.clock,
            number: entry.number,
        };
        post.send(robot, grant);
    }

    fn tell(
        &mut self,
        robot: RobotId,
        behind: RobotId,
        must_wait: bool,
        terms: Terms,
        post: &mut Post,
    ) {
        let entry = self.entries.get_mut(&robot);
        if let Some(entry) = entry.filter(|entry| !entry.is_told) {
            entry.is_told = must_wait;
            let Wish { id, attempt, .. } = entry.wish;
            let wait = Packet::Wait {
                id,
                attempt,
                clock: terms.clock,
                behind: Behind::Robot(behind),
                must_wait,
            };
            post.send(robot, wait);
        }
    }

    /// Drops those of whom nothing was heard for a lease.
    fn expire(&mut self, terms: Terms) {
        if terms.lease.is_some() {
            let longest = terms.until();
            self.entries.retain(|_, entry| {
                entry.until = entry.until.min(longest);
                entry.until > terms.now
            });
        }
    }
}
