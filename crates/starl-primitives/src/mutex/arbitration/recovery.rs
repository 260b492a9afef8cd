//! How an arbiter that remembers nothing comes to be one: it asks the others what it had granted.
//!
//! A robot cannot tell its first start from a restart, so every robot does this once. Until it is ready it
//! grants nothing.
//!
//! When all others have answered, nobody can enter by a grant that was forgotten: they have said what they hold,
//! and who waits has begun another attempt, to which such a grant is none. Without leases that is needed, and is
//! enough. With leases a lease of silence shows as much, and what is missing then are the numbers, so it asks
//! once more: a number that somebody entered with by a forgotten grant may have come to those who gave the
//! others after they had answered. A number that somebody has entered with is known to a majority, so those who
//! remember and have answered must be too many for such a majority to avoid. No clock has a part in that.
//!
//! Where so many cannot be, as a majority has forgotten, nobody can know the last number. A robot takes that for
//! granted only if it has seen it: a majority, itself among them, that remembered nothing at one moment, since each
//! said so in the same life before it and after it. That is so too when the fleet is new. Then numbers go on from
//! the time in milliseconds, the latest of those who have forgotten: no counting is as fast, so they grow unless
//! clocks are wrong. Robots that are silent, whether they are down or cut off, are waited for.
//!
//! After a change of participants all of the new ones have to answer, having changed too: two quorums of
//! different lists need have nobody in common.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::{Duration, Random, RobotId, Time};

/// With this repetition, and those after it, robots that had forgotten too are asked whether they know more by now.
const FORGETFUL_ASKED: u32 = 3;

/// How far an arbiter is.
#[derive(Clone, Debug, Default)]
pub(super) struct Recovery {
    /// None before it has begun.
    begun: Option<Begun>,
    pub is_ready: bool,
    /// Whether it has been ready since the robot started, so that it knows what it has granted.
    pub remembers: bool,
}

/// An arbiter that asks.
#[derive(Clone, Debug)]
pub(super) struct Begun {
    pub nonce: u32,
    since: Time,
    /// When it has asked for the first time with this nonce.
    stage_since: Time,
    /// Whether the participants have changed; otherwise the robot has started.
    is_change: bool,
    /// Whether nobody can enter by a grant that was forgotten; with leases.
    is_silence_over: bool,
    /// Who has answered, and in which life if it has forgotten what it granted.
    answers: BTreeMap<RobotId, Option<u32>>,
    /// Who had forgotten that before it asked with this nonce, and in which life.
    forgot_before: BTreeMap<RobotId, u32>,
    /// How often it has asked.
    pub repetitions: u32,
}

/// What a look at the answers shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outlook {
    Ready,
    /// Ready, but numbers have to begin anew.
    ReadyWithoutNumbers,
    Unready,
}

impl Recovery {
    /// Whether it has to be begun, or begun anew.
    pub fn is_idle(&self) -> bool {
        !self.is_ready && self.begun.is_none()
    }

    pub fn begin(&mut self, nonce: u32, now: Time, is_change: bool) {
        self.is_ready = false;
        self.begun = Some(Begun {
            nonce,
            since: now,
            stage_since: now,
            is_change,
            is_silence_over: false,
            answers: BTreeMap::new(),
            forgot_before: BTreeMap::new(),
            repetitions: 0,
        });
    }

    /// The asking that is under way.
    pub fn asking(&mut self) -> Option<&mut Begun> {
        let is_ready = self.is_ready;
        self.begun.as_mut().filter(|_| !is_ready)
    }

    /// Whether it has asked for so long.
    pub fn has_asked_for(&self, span: Duration, now: Time) -> bool {
        let begun = self.begun.as_ref();
        begun.is_some_and(|begun| now.since(begun.since) >= span)
    }

    /// Who has not answered; none if all have.
    pub fn silent(&self, others: &[RobotId]) -> Vec<RobotId> {
        let answered = |peer: &RobotId| {
            let begun = self.begun.as_ref();
            begun.is_some_and(|begun| begun.answers.contains_key(peer))
        };
        others
            .iter()
            .copied()
            .filter(|peer| !answered(peer))
            .collect()
    }

    /// Who is to be asked: who has not answered, and whose answer may be another one by now.
    pub fn to_ask(&self, others: &[RobotId]) -> Vec<RobotId> {
        let answer = |peer: &RobotId| self.begun.as_ref()?.answers.get(peer).copied();
        let begun = self.begun.as_ref();
        let asks_again =
            begun.is_some_and(|b| b.is_silence_over && b.repetitions >= FORGETFUL_ASKED);
        let others = others.iter().copied();
        others
            .filter(|peer| match answer(peer) {
                None => true,
                Some(forgot) => asks_again && forgot.is_some(),
            })
            .collect()
    }

    /// Whether all are to be asked once more from now on: when nobody can enter by a forgotten grant any longer, and
    /// later when somebody has forgotten since it asked.
    pub fn ends_stage(&mut self, now: Time, others: &[RobotId], lease: Duration) -> bool {
        let all = self.silent(others).is_empty();
        let Some(begun) = self.asking() else {
            return false;
        };
        let is_late = !begun.is_change && now.since(begun.stage_since) >= lease;
        let needs_another = !begun.is_silence_over || begun.forgetful().any(|(_, seen)| !seen);
        let has_ended = needs_another && (all || is_late);
        if has_ended {
            let forgot = begun.forgetful().map(|(answer, _)| answer);
            begun.forgot_before = forgot.collect();
            begun.stage_since = now;
            begun.is_silence_over = true;
            begun.nonce = begun.nonce.wrapping_add(1);
            begun.answers.clear();
            begun.repetitions = 0;
        }
        has_ended
    }

    /// The time until more can be known without an answer: until one lease is over, or two.
    pub fn until_more(&self, now: Time, lease: Duration) -> Option<Duration> {
        let begun = self.begun.as_ref()?;
        let ends = [begun.since, begun.since + lease, begun.stage_since];
        let ends = ends.into_iter().map(|start| start + lease);
        // Timers are no more precise.
        let least = Duration::from_millis(1);
        let next = ends.filter(|&end| end > now).min()?;
        Some(next.since(now).max(least))
    }

    /// Takes an answer, with the life of a robot that has forgotten; false if it is to another question.
    pub fn hear(&mut self, from: RobotId, nonce: u32, forgot: Option<u32>) -> bool {
        match self.asking() {
            Some(begun) if begun.nonce == nonce => {
                begun.answers.insert(from, forgot);
                true
            }
            _ => false,
        }
    }

    /// Whether enough is known.
    pub fn outlook(&self, now: Time, others: &[RobotId], lease: Option<Duration>) -> Outlook {
        let Some(begun) = &self.begun else {
            return Outlook::Unready;
        };
        let all = others.iter().all(|peer| begun.answers.contains_key(peer));
        let Some(lease) = lease else {
            return if all {
                Outlook::Ready
            } else {
                Outlook::Unready
            };
        };
        let count = others.len() + 1;
        let majority = count / 2 + 1;
        let remember = begun.answers.values().filter(|forgot| forgot.is_none());
        // It has forgotten too.
        let forgot = 1 + begun.forgetful().filter(|&(_, seen)| seen).count();
        let is_late = self.has_asked_for(lease * 2, now);
        if !begun.is_silence_over || begun.is_change && !all {
            Outlook::Unready
        } else if remember.count() > count - majority || begun.is_change && self.remembers {
            Outlook::Ready
        } else if forgot >= majority && (all || is_late) {
            Outlook::ReadyWithoutNumbers
        } else {
            Outlook::Unready
        }
    }

    /// Overwrites the state at random.
    pub fn corrupt(&mut self, random: &mut Random) {
        self.is_ready = random.chance(0.5);
        self.begun = None;
    }
}

impl Begun {
    /// Who has forgotten what it granted, and in which life; and whether it had before this robot asked.
    fn forgetful(&self) -> impl Iterator<Item = ((RobotId, u32), bool)> {
        let answers = self.answers.iter();
        let forgot = answers.filter_map(|(&peer, forgot)| Some((peer, (*forgot)?)));
        forgot.map(|(peer, life)| {
            let seen = self.forgot_before.get(&peer) == Some(&life);
            ((peer, life), seen)
        })
    }
}
