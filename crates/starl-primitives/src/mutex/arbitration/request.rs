//! A robot's request: the arbiters that it has asked, their answers, and when these are enough.
//!
//! Invariant: a grant counts only if it is for the latest attempt with its arbiter. A robot that yields, or
//! hears that its arbiter has forgotten, begins another attempt.

use super::super::Resources;
use super::super::common::{Common, RequestId};
use super::Post;
use super::packet::{Behind, Packet, Wish};
use alloc::collections::{BTreeMap, VecDeque};
use alloc::vec::Vec;
use starl_core::{Duration, Random, RobotId, Time};

/// Rounds of asking whose time is remembered.
const ROUNDS: usize = 16;

/// A request that is under way, or granted and in use.
#[derive(Clone, Debug)]
pub(super) struct Request {
    pub id: RequestId,
    pub clock: u64,
    pub resources: Resources,
    /// Whether the robot has entered with this grant.
    pub is_entered: bool,
    /// With this number at least, or exactly once it is entered.
    pub number: u64,
    /// The list of participants by which it was made.
    pub list: u32,
    /// How often it was repeated since something changed.
    pub repetitions: u32,
    /// Whether an arbiter has granted it since it was repeated, so that its turn seems to have come.
    pub is_hopeful: bool,
    pub(super) asked: BTreeMap<RobotId, Asked>,
    round: u32,
    /// When the latest rounds were sent, by the robot's clock.
    sent: VecDeque<(u32, Time)>,
}

/// How it stands with one arbiter.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Asked {
    pub attempt: u32,
    /// Until when it has granted it, and with what number.
    pub granted: Option<(Time, u64)>,
    pub behind: Option<Behind>,
    /// When it was heard of last.
    heard: Option<Time>,
}

impl Asked {
    /// Whether it was heard of within a lease.
    fn is_heard(&self, now: Time, enough: Enough) -> bool {
        let Enough::Majority(_, belief) = enough else {
            return true;
        };
        self.heard
            .is_some_and(|heard| heard <= now && now.since(heard) < belief)
    }
}

impl Request {
    pub fn new(
        id: RequestId,
        clock: u64,
        resources: Resources,
        list: u32,
        arbiters: Vec<RobotId>,
    ) -> Request {
        Request {
            id,
            clock,
            resources,
            is_entered: false,
            number: 0,
            list,
            repetitions: 0,
            is_hopeful: false,
            asked: arbiters
                .into_iter()
                .map(|peer| (peer, Asked::default()))
                .collect(),
            round: 0,
            sent: VecDeque::new(),
        }
    }

    /// The same request to these arbiters, without their earlier answers.
    pub fn of_others(mut self, arbiters: &[RobotId], list: u32) -> Request {
        self.asked.retain(|arbiter, _| arbiters.contains(arbiter));
        for &arbiter in arbiters {
            self.asked.entry(arbiter).or_default();
        }
        self.list = list;
        self
    }

    /// All asked arbiters.
    pub fn arbiters(&self) -> impl Iterator<Item = RobotId> {
        self.asked.keys().copied()
    }

    pub fn has_asked(&self, arbiter: RobotId) -> bool {
        self.asked.contains_key(&arbiter)
    }

    /// The message to an arbiter.
    pub fn wish(&self, arbiter: RobotId, common: &Common) -> Wish {
        let resources = match self.is_entered {
            true => common.held.clone(),
            false => self.resources.clone(),
        };
        Wish {
            id: self.id,
            attempt: self.asked.get(&arbiter).map_or(0, |asked| asked.attempt),
            round: self.round,
            clock: self.clock,
            number: self.number,
            is_entered: self.is_entered,
            hears: true,
            list: self.list,
            resources,
        }
    }

    /// Asks again the arbiters that have not granted it, or all whose grants end.
    pub fn ask(&mut self, now: Time, enough: Enough, common: &Common, post: &mut Post) {
        self.round = self.round.wrapping_add(1);
        self.sent.push_back((self.round, now));
        if self.sent.len() > ROUNDS {
            self.sent.pop_front();
        }
        if matches!(enough, Enough::All) {
            let missing = self
                .asked
                .iter()
                .filter(|(_, asked)| asked.granted.is_none());
            for (&arbiter, _) in missing {
                post.send(arbiter, Packet::Request(self.wish(arbiter, common)));
            }
            return;
        }
        let Some(first) = self.arbiters().next() else {
            return;
        };
        // The same to all, so that it is one datagram.
        let attempts = self
            .asked
            .iter()
            .map(|(&arbiter, asked)| (arbiter, asked.attempt));
        let heard = self
            .asked
            .iter()
            .filter(|(_, asked)| asked.is_heard(now, enough));
        let repeat = Packet::Repeat {
            wish: self.wish(first, common),
            attempts: attempts.filter(|&(_, attempt)| attempt != 0).collect(),
            heard: heard.map(|(&arbiter, _)| arbiter).collect(),
        };
        for arbiter in self.arbiters() {
            post.send(arbiter, repeat.clone());
        }
    }

    /// Tells an arbiter that only this is still needed.
    pub fn release(&self, left: Resources) -> Packet {
        Packet::Release {
            id: self.id,
            left,
            number: if self.is_entered { self.number } else { 0 },
        }
    }

    /// Whether it should have been repeated, as it is at least this often.
    pub fn is_overdue(&self, now: Time, span: Duration) -> bool {
        self.sent
            .back()
            .is_none_or(|&(_, at)| now.since(at) > span || at > now)
    }

    /// An arbiter was heard of.
    pub fn hear_of(&mut self, arbiter: RobotId, now: Time) {
        if let Some(asked) = self.asked.get_mut(&arbiter) {
            asked.heard = Some(now);
        }
    }

    /// An arbiter grants it.
    pub fn grant(&mut self, from: RobotId, attempt: u32, round: u32, number: u64, enough: Enough) {
        let until = match enough {
            Enough::All => Some(Time::NEVER),
            Enough::Majority(_, belief) => {
                let sent = self.sent.iter().find(|(sent, _)| *sent == round);
                sent.map(|&(_, at)| at + belief)
            }
        };
        if let (Some(asked), Some(until)) = (self.asked.get_mut(&from), until)
            && asked.attempt == attempt
        {
            self.is_hopeful |= asked.granted.is_none();
            let before = asked.granted.unwrap_or((Time::ZERO, 0));
            asked.granted = Some((before.0.max(until), before.1.max(number)));
            asked.behind = None;
        }
    }

    /// An arbiter says that it has to wait.
    pub fn wait(&mut self, from: RobotId, attempt: u32, behind: Behind) {
        if let Some(asked) = self.asked.get_mut(&from)
            && asked.attempt == attempt
            && (asked.granted.is_none() || self.is_entered)
        {
            asked.behind = Some(behind);
        }
    }

    /// An arbiter asks whether its grant is still needed. The robot yields if it must.
    pub fn inquire(
        &mut self,
        from: RobotId,
        attempt: u32,
        must_yield: bool,
        common: &Common,
        post: &mut Post,
    ) {
        let Some(asked) = self.asked.get_mut(&from) else {
            // It was made up by a fault.
            return post.send(from, self.release(Resources::new()));
        };
        if (attempt.wrapping_sub(asked.attempt) as i32) > 0 {
            // Only a corruption makes an arbiter know attempts that were not made.
            asked.attempt = attempt;
            self.try_anew(from, common, post);
        } else if self.is_entered {
            if common.held.len() < self.resources.len() {
                post.send(from, self.release(common.held.clone()));
            }
        } else if must_yield && attempt == asked.attempt {
            self.try_anew(from, common, post);
        }
    }

    /// Starts another attempt with an arbiter: its grant is returned.
    pub fn try_anew(&mut self, arbiter: RobotId, common: &Common, post: &mut Post) {
        if let Some(asked) = self.asked.get_mut(&arbiter) {
            *asked = Asked {
                attempt: asked.attempt.wrapping_add(1),
                heard: asked.heard,
                ..Asked::default()
            };
            post.send(arbiter, Packet::Request(self.wish(arbiter, common)));
        }
    }

    /// Begins another attempt with every arbiter.
    pub fn try_all_anew(&mut self, common: &Common, post: &mut Post) {
        for arbiter in self.arbiters().collect::<Vec<_>>() {
            self.try_anew(arbiter, common, post);
        }
    }

    /// Overwrites the state at random; `some` are the resources that it requests afterwards.
    pub fn corrupt(&mut self, random: &mut Random, some: Resources) {
        self.resources = some;
        self.is_entered = random.chance(0.5);
        self.clock = u64::from(random.bits());
        self.repetitions = random.bits();
        if random.chance(0.5) {
            self.id.number = u64::from(random.bits());
        }
        for asked in self.asked.values_mut() {
            if random.chance(0.5) {
                asked.granted = random.chance(0.5).then(|| (Time(random.bits().into()), 0));
                asked.attempt = random.bits();
            }
        }
    }
}

/// How many grants are enough, and for how long.
#[derive(Clone, Copy, Debug)]
pub(super) enum Enough {
    /// All of those asked, for as long as the robot likes.
    All,
    /// This number of grants with the same fencing number, for this time after the request.
    Majority(usize, Duration),
}
