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
//! remember and have answered must be too many for such a majority to avoid. Where so many remember nothing, all
//! being new, or do not answer within another lease, numbers go on from the time in milliseconds, the latest of
//! those that have forgotten: no counting is as fast, and so they grow unless clocks have been set back.
//!
//! After a change of participants all of the new ones have to answer, having changed too: two quorums of
//! different lists need have nobody in common.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::{Duration, Random, RobotId, Time};

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
    /// Whether the participants have changed; otherwise the robot has started.
    is_change: bool,
    /// Whether nobody can enter by a grant that was forgotten; with leases.
    is_silence_over: bool,
    /// Who has answered, and whether they remember what they granted.
    answers: BTreeMap<RobotId, bool>,
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
            is_change,
            is_silence_over: false,
            answers: BTreeMap::new(),
            repetitions: 0,
        });
    }

    /// The asking that is under way.
    pub fn asking(&mut self) -> Option<&mut Begun> {
        let is_ready = self.is_ready;
        self.begun.as_mut().filter(|_| !is_ready)
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
        let remembers = |peer: &RobotId| self.begun.as_ref()?.answers.get(peer).copied();
        let is_silence_over = self.begun.as_ref().is_some_and(|b| b.is_silence_over);
        let others = others.iter().copied();
        others
            .filter(|peer| match remembers(peer) {
                None => true,
                Some(remembers) => is_silence_over && !remembers,
            })
            .collect()
    }

    /// Whether it is now that nobody can enter by a forgotten grant any longer: then all are asked once more.
    pub fn ends_silence(&mut self, now: Time, others: &[RobotId], lease: Duration) -> bool {
        let all = self.silent(others).is_empty();
        let Some(begun) = self.asking().filter(|begun| !begun.is_silence_over) else {
            return false;
        };
        let has_ended = all || !begun.is_change && now.since(begun.since) >= lease;
        if has_ended {
            begun.is_silence_over = true;
            begun.nonce = begun.nonce.wrapping_add(1);
            begun.answers.clear();
            begun.repetitions = 0;
        }
        has_ended
    }

    /// The time until more can be known without an answer: until one lease is over, or two.
    pub fn until_more(&self, now: Time, lease: Duration) -> Option<Duration> {
        let since = self.begun.as_ref()?.since;
        let mut ends = [since + lease, since + lease * 2].into_iter();
        // Timers are no more precise.
        let least = Duration::from_millis(1);
        Some(ends.find(|&end| end > now)?.since(now).max(least))
    }

    /// Takes an answer; false if it is to another question.
    pub fn hear(&mut self, from: RobotId, nonce: u32, remembers: bool) -> bool {
        match self.asking() {
            Some(begun) if begun.nonce == nonce => {
                begun.answers.insert(from, remembers);
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
        let remember = begun
            .answers
            .values()
            .filter(|&&remembers| remembers)
            .count();
        let is_late = now.since(begun.since) >= lease * 2;
        if !begun.is_silence_over || begun.is_change && !all {
            Outlook::Unready
        } else if remember > count - majority || begun.is_change && self.remembers {
            Outlook::Ready
        } else if all || begun.answers.len() + 1 >= majority && is_late {
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
