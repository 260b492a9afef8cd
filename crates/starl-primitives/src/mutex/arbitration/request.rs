//! A robot's request: whom it has asked, what they answered, and when that is enough.
//!
//! Invariant: a grant counts only if it is to the latest attempt with its arbiter. Whoever yields, or hears
//! that its arbiter has forgotten, begins another attempt.

use super::super::Resources;
use super::super::common::{Common, RequestId};
use super::Post;
use super::enough::Enough;
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
    /// When it was granted the robot came to hold the resources.
    pub is_entered: bool,
    /// With this number at least, or exactly once it is entered.
    pub number: u64,
    /// The list of participants by which it was made.
    pub list: u32,
    /// How often it was repeated since something changed.
    pub repetitions: u32,
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
    /// It said that an earlier request goes first.
    pub must_wait: bool,
    /// It asked to yield.
    pub is_inquired: bool,
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
            asked: arbiters
                .into_iter()
                .map(|peer| (peer, Asked::default()))
                .collect(),
            round: 0,
            sent: VecDeque::new(),
        }
    }

    /// The same request of these arbiters, whatever those among them have answered.
    pub fn of_others(mut self, arbiters: &[RobotId], list: u32) -> Request {
        self.asked.retain(|arbiter, _| arbiters.contains(arbiter));
        for &arbiter in arbiters {
            self.asked.entry(arbiter).or_default();
        }
        self.list = list;
        self
    }

    /// All that were asked.
    pub fn arbiters(&self) -> impl Iterator<Item = RobotId> {
        self.asked.keys().copied()
    }

    pub fn has_asked(&self, arbiter: RobotId) -> bool {
        self.asked.contains_key(&arbiter)
    }

    /// What is said to an arbiter.
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
            list: self.list,
            resources,
        }
    }

    /// Asks again: those that have not granted it, or all whose grants end.
    pub fn ask(&mut self, now: Time, enough: Enough, common: &Common, post: &mut Post) {
        self.round = self.round.wrapping_add(1);
        self.sent.push_back((self.round, now));
        if self.sent.len() > ROUNDS {
            self.sent.pop_front();
        }
        let all = matches!(enough, Enough::Majority(..));
        for (&arbiter, asked) in &self.asked {
            if all || asked.granted.is_none() {
                post.send(arbiter, Packet::Request(self.wish(arbiter, common)));
            }
        }
    }

    /// Whether it should have been repeated, as it is at least this often.
    pub fn is_overdue(&self, now: Time, span: Duration) -> bool {
        self.sent
            .back()
            .is_none_or(|&(_, at)| now.since(at) > span || at > now)
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
            let before = asked.granted.unwrap_or((Time::ZERO, 0));
            asked.granted = Some((before.0.max(until), before.1.max(number)));
            asked.behind = None;
            asked.must_wait = false;
        }
    }

    /// An arbiter says that it has to wait.
    pub fn wait(&mut self, from: RobotId, attempt: u32, behind: Behind, must_wait: bool) {
        if let Some(asked) = self.asked.get_mut(&from)
            && asked.attempt == attempt
            && (asked.granted.is_none() || self.is_entered)
        {
            asked.behind = Some(behind);
            asked.must_wait |= must_wait;
        }
    }

    /// An arbiter asks whether its grant is still needed.
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
            let (id, left) = (self.id, Resources::new());
            return post.send(from, Packet::Release { id, left });
        };
        if (attempt.wrapping_sub(asked.attempt) as i32) > 0 {
            // Only a corruption makes an arbiter know attempts that were not made.
            asked.attempt = attempt;
            self.try_anew(from, common, post);
        } else if self.is_entered {
            if common.held.len() < self.resources.len() {
                let (id, left) = (self.id, common.held.clone());
                post.send(from, Packet::Release { id, left });
            }
        } else if attempt == asked.attempt {
            asked.is_inquired |= must_yield;
        }
    }

    /// Begins another attempt with an arbiter: what it granted is given back.
    pub fn try_anew(&mut self, arbiter: RobotId, common: &Common, post: &mut Post) {
        if let Some(asked) = self.asked.get_mut(&arbiter) {
            *asked = Asked {
                attempt: asked.attempt.wrapping_add(1),
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

    /// Yields to those that asked for it: at once if it has to wait for somebody anyway, otherwise only if
    /// `is_late`.
    pub fn yield_if_it_must(&mut self, is_late: bool, common: &Common, post: &mut Post) {
        let mut asked = self.asked.values();
        if self.is_entered || !is_late && !asked.any(|asked| asked.must_wait) {
            return;
        }
        let inquired = self.asked.iter().filter(|(_, asked)| asked.is_inquired);
        for arbiter in inquired.map(|(&peer, _)| peer).collect::<Vec<_>>() {
            self.try_anew(arbiter, common, post);
        }
    }

    /// Overwrites the state at random; `some` are what it comes to ask for.
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
                asked.is_inquired = random.chance(0.5);
                asked.must_wait = random.chance(0.5);
            }
        }
    }
}
