//! How a starting robot gets its vote, although it may have forgotten its earlier promises.
//!
//! First it waits silently for one lease, on its own clock: a leader by its forgotten vote no longer leads
//! after that. Then it asks the others for their promises, and takes the latest epoch as its own promise.
//! It needs answers from so many robots with memory that each majority contains one of them.
//!
//! Invariant: the robot learns every epoch with a leader by its forgotten vote, unless a majority has
//! forgotten at once. The others voted for that epoch while the robot waited, or before; therefore it asks
//! only afterwards. Recovery as in Viewstamped Replication Revisited (Liskov and Cowling 2012) may ask too
//! early: see Michael, Ports, Sharma and Szekeres 2017, with a different solution.
//!
//! If a majority is recovering at once, all memory may be lost, and waiting for it is useless. This is the case
//! when a fleet starts. Then these robots start again, from the latest epoch that any of them has heard of and from
//! their clocks. To the robots that were up then, such a robot does not count as one with memory. They do not all
//! start again at the same moment. To one that started in between, those that have been up since the first of them
//! count as robots with memory: earlier promises may be lost, and since then they have forgotten nothing.

use super::{Leases, Promise};
use crate::election::epoch::Epoch;
use crate::election::options::no_later;
use crate::election::packet::{Memory, Packet};
use crate::election::rules::Scene;
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::event::ElectionEvent;
use starl_core::random::hash_key;
use starl_core::{Duration, Random, RobotId, Time};

/// How far a robot is.
#[derive(Clone, Debug, Default)]
pub(super) enum Stage {
    /// It has not begun.
    #[default]
    Fresh,
    /// Since this moment it waits.
    Waiting(Time),
    /// It asks.
    Learning(Learning),
    /// It remembers its promises, because it learned them from others, or since this moment, when a majority
    /// started again.
    Remembering(Option<Time>),
}

/// The answers of the others.
#[derive(Clone, Debug)]
pub(super) struct Learning {
    /// When the robot began.
    begun: Time,
    /// Answers are collected for the time of a lease. Those collected before then count no more, nor do those to
    /// questions of an earlier life: each life counts from a number that is made of the time.
    attempt: u32,
    until: Time,
    answers: BTreeMap<RobotId, Answer>,
    /// When the first of this attempt's questions was asked.
    asked_at: Time,
    repeat_at: Time,
    repetitions: u32,
}

/// Another robot's memory, in this robot's time.
#[derive(Clone, Copy, Debug)]
struct Answer {
    /// Whether it remembers everything that it promised before this robot started.
    remembers: bool,
    /// It has been up since then, or longer.
    up_since: Time,
    /// It started again then, or later.
    anew_since: Option<Time>,
}

impl Leases {
    /// Whether this robot votes and stands.
    pub(super) fn remembers(&self) -> bool {
        matches!(self.stage, Stage::Remembering(_))
    }

    /// Performs the due steps.
    pub(super) fn recover(&mut self, scene: &mut Scene<'_, '_>) {
        let now = scene.now();
        let lease = scene.options.lease;
        self.stage.make_plausible(now, scene);
        match &mut self.stage {
            _ if !scene.takes_part => {}
            Stage::Fresh => {
                self.stage = Stage::Waiting(now);
                self.up_since = now;
            }
            Stage::Waiting(begun) if now >= *begun + lease => {
                // Another number than in earlier lives, whose answers may still come.
                let (begun, attempt) = (*begun, hash_key(begun.0, &[]) as u32);
                self.collect(scene, begun, attempt);
            }
            Stage::Learning(learning) if now >= learning.until => {
                let (begun, attempt) = (learning.begun, learning.attempt.wrapping_add(1));
                self.collect(scene, begun, attempt);
            }
            Stage::Learning(learning) if now >= learning.repeat_at => {
                learning.ask(scene);
                self.begin_if_told(scene);
            }
            _ => {}
        }
    }

    /// When something is due.
    pub(super) fn recovery_due(&self, scene: &Scene<'_, '_>) -> Time {
        match &self.stage {
            Stage::Fresh | Stage::Remembering(_) => Time::NEVER,
            Stage::Waiting(begun) => *begun + scene.options.lease,
            Stage::Learning(learning) => learning.repeat_at.min(learning.until),
        }
    }

    fn collect(&mut self, scene: &mut Scene<'_, '_>, begun: Time, attempt: u32) {
        let now = scene.now();
        let mut learning = Learning {
            begun,
            attempt,
            until: now + scene.options.lease.max(scene.options.timeout(0)),
            answers: BTreeMap::new(),
            asked_at: now,
            repeat_at: now,
            repetitions: 0,
        };
        learning.ask(scene);
        self.stage = Stage::Learning(learning);
        self.begin_if_told(scene);
    }

    /// A robot asks for promises.
    pub(super) fn remember(
        &self,
        scene: &mut Scene<'_, '_>,
        from: RobotId,
        attempt: u32,
        up_for: Duration,
    ) {
        if !scene.takes_part {
            return;
        }
        let drift = scene.options.drift.clamp(0.0, 0.9);
        let up_for = up_for.seconds() * (1.0 - drift) / (1.0 + drift);
        let (remembers, anew_for) = match self.stage {
            Stage::Remembering(None) => (true, None),
            Stage::Remembering(Some(begun)) => {
                let anew_for = scene.now().since(begun);
                (up_for <= anew_for.seconds(), Some(anew_for))
            }
            _ => (false, None),
        };
        let promised = self.known.max(self.promise.epoch);
        let memory = Memory {
            attempt,
            promised,
            remembers,
            up_for: scene.now().since(self.up_since),
            anew_for,
        };
        scene.send(from, Packet::Tell(memory));
    }

    /// A robot answers with its memory.
    pub(super) fn told(&mut self, scene: &mut Scene<'_, '_>, from: RobotId, memory: Memory) {
        self.learn(memory.promised);
        if let Stage::Learning(learning) = &mut self.stage
            && learning.attempt == memory.attempt
        {
            let drift = scene.options.drift.clamp(0.0, 0.9);
            let slowest = (1.0 - drift) / (1.0 + drift);
            let shortest = |span: Duration| Duration::from_seconds_f64(span.seconds() * slowest);
            let longest = |span: Duration| Duration::from_seconds_f64(span.seconds() / slowest);
            let answer = Answer {
                remembers: memory.remembers,
                up_since: scene.now() - shortest(memory.up_for),
                anew_since: memory
                    .anew_for
                    .map(|span| learning.asked_at - longest(span)),
            };
            learning.answers.insert(from, answer);
            self.begin_if_told(scene);
        }
    }

    /// Votes from now on, if enough have answered.
    fn begin_if_told(&mut self, scene: &mut Scene<'_, '_>) {
        let Stage::Learning(learning) = &self.stage else {
            return;
        };
        let majority = scene.majority();
        let remembering = learning.remembering();
        let recovering = 1 + learning.answers.len() - remembering;
        if remembering + majority > scene.others.len() + 1 {
            self.stage = Stage::Remembering(None);
        } else if recovering >= majority {
            self.stage = Stage::Remembering(Some(scene.now()));
        } else {
            return;
        }
        let anew = matches!(self.stage, Stage::Remembering(Some(_)));
        let (port, vote) = (scene.port, ElectionEvent::Vote { anew });
        scene.robot.report(port, vote);
        self.promise = Promise {
            epoch: self.known,
            ..Promise::default()
        };
        self.postpone(scene);
    }
}

impl Learning {
    /// How many remember.
    fn remembering(&self) -> usize {
        let answers = self.answers.values();
        let remembering = answers.clone().filter(|answer| answer.remembers);
        let anew = remembering.filter_map(|answer| answer.anew_since).max();
        let has_forgotten_nothing = |answer: &Answer| anew.is_some_and(|at| answer.up_since <= at);
        answers
            .filter(|answer| answer.remembers || has_forgotten_nothing(answer))
            .count()
    }

    /// Asks those that have not answered.
    fn ask(&mut self, scene: &mut Scene<'_, '_>) {
        let now = scene.now();
        self.repeat_at = now + scene.options.timeout(self.repetitions);
        self.repetitions = self.repetitions.saturating_add(1);
        let others = scene.others.iter().copied();
        let missing = others.filter(|peer| !self.answers.contains_key(peer));
        let missing: Vec<RobotId> = missing.collect();
        let (attempt, up_for) = (self.attempt, now.since(self.begun));
        scene.tell(&missing, Packet::Ask { attempt, up_for });
    }
}

impl Stage {
    /// Makes sense of what a corruption may have left.
    fn make_plausible(&mut self, now: Time, scene: &Scene<'_, '_>) {
        match self {
            Stage::Fresh | Stage::Remembering(None) => {}
            Stage::Waiting(begun) | Stage::Remembering(Some(begun)) => no_later(begun, now),
            Stage::Learning(learning) => {
                no_later(&mut learning.begun, now);
                let longest = scene.options.lease.max(scene.options.timeout(0));
                no_later(&mut learning.until, now + longest);
                no_later(
                    &mut learning.repeat_at,
                    now + scene.options.timeout(u32::MAX),
                );
                let others = scene.others;
                learning.answers.retain(|peer, _| others.contains(peer));
            }
        }
    }

    pub fn corrupt(&mut self, random: &mut Random) {
        let time = |random: &mut Random| Time(Epoch::random(random).0);
        *self = match random.below(5) {
            0 => Stage::Fresh,
            1 => Stage::Waiting(time(random)),
            2 => Stage::Learning(Learning {
                begun: time(random),
                attempt: random.bits(),
                until: time(random),
                answers: (0..random.below(5))
                    .map(|robot| {
                        let answer = Answer {
                            remembers: random.chance(0.5),
                            up_since: time(random),
                            anew_since: random.chance(0.5).then(|| time(random)),
                        };
                        (RobotId(robot), answer)
                    })
                    .collect(),
                asked_at: time(random),
                repeat_at: time(random),
                repetitions: random.bits(),
            }),
            3 => Stage::Remembering(None),
            _ => Stage::Remembering(Some(time(random))),
        };
    }
}
