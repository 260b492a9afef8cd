//! How an arbiter without memory becomes ready: it asks the others for its earlier grants.
//!
//! A robot cannot tell its first start from a restart, so every robot does this once. Until it is ready it
//! grants nothing.
//!
//! When all others have answered, no robot can enter by a forgotten grant: they have reported what they hold,
//! and waiting robots have begun another attempt, for which such a grant is invalid. Without leases this is
//! necessary and sufficient. With leases one lease of silence has the same effect, and only the numbers are
//! missing. So the robot asks again: robots that granted the rest may have learned a number of a forgotten
//! grant after they had answered. A majority knows every number with which a robot has entered. So the robots
//! with memory that have answered must be so many that every majority contains one of them. Clocks play no part
//! in this.
//!
//! If there cannot be so many, because a majority has forgotten, the last number may be unknown. A robot assumes
//! this only if it has seen it: a majority, including itself, that remembered nothing at one moment, because each
//! reported this in the same life before it and after it. This is also the case when the fleet is new. Then numbers
//! continue from the time in milliseconds, the latest among those that have forgotten: no counting is as fast, so they
//! grow unless clocks are wrong. The robot waits for silent robots, whether they are down or disconnected.
//!
//! A robot that begins so remembers the others of that majority. It tells them, as long as they have not restarted: such
//! a robot has granted nothing since, and is ready when no robot can enter by a grant from before. Otherwise the robots
//! that are ready first could not help the others if some fail soon after the start.
//!
//! After a change of participants all of the new ones must answer, after they have changed too: two
//! quorums of different lists may be disjoint.

use crate::founders::Founders;
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
    /// Whether it has been ready since the robot's start, so that it knows its grants.
    pub remembers: bool,
    /// Those with which the fleet began, if this robot is one of them.
    pub founders: Founders,
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
    /// Whether no robot can enter by a forgotten grant any more; with leases.
    is_silence_over: bool,
    /// The robots that have answered, with the life of those that have forgotten their grants.
    answers: BTreeMap<RobotId, Option<u32>>,
    /// The robots that had forgotten before this robot asked with this nonce, with their lives.
    forgot_before: BTreeMap<RobotId, u32>,
    /// As another robot has told, if this robot is one of them.
    founders: Founders,
    /// How often it has asked.
    pub repetitions: u32,
}

/// The conclusion from the answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outlook {
    Ready,
    /// Ready, but numbers must start again.
    ReadyWithoutNumbers,
    Unready,
}

impl Recovery {
    /// Whether it must be started or restarted.
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
            founders: Founders::default(),
            repetitions: 0,
        });
        self.founders = Founders::default();
    }

    /// It is ready and remembers what it grants from now on.
    pub fn end(&mut self, is_anew: bool) {
        if let Some(begun) = &self.begun {
            // They ask as the same ones later, so that they need not have answered again.
            self.founders = match is_anew {
                true => Founders::new(begun.forgot_before.clone()),
                false => begun.founders.clone(),
            };
        }
        (self.is_ready, self.remembers) = (true, true);
    }

    /// The asking that is under way.
    pub fn asking(&mut self) -> Option<&mut Begun> {
        let is_ready = self.is_ready;
        self.begun.as_mut().filter(|_| !is_ready)
    }

    /// Whether it has asked for this long.
    pub fn has_asked_for(&self, span: Duration, now: Time) -> bool {
        let begun = self.begun.as_ref();
        begun.is_some_and(|begun| now.since(begun.since) >= span)
    }

    /// The robots that have not answered; none if all have.
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

    /// The robots to ask: those that have not answered, and those whose answer may have changed.
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

    /// Whether all must be asked again: when no robot can enter by a forgotten grant any longer, and later when
    /// a robot has forgotten since it was asked.
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

    /// Handles an answer, with the life of a robot that has forgotten; false if it answers another question.
    pub fn hear(
        &mut self,
        from: RobotId,
        nonce: u32,
        forgot: Option<u32>,
        founders: Founders,
    ) -> bool {
        match self.asking() {
            Some(begun) if begun.nonce == nonce => {
                begun.answers.insert(from, forgot);
                if !founders.is_empty() {
                    begun.founders = founders;
                }
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
        } else if remember.count() > count - majority
            || !begun.founders.is_empty() && !begun.is_change
            || begun.is_change && self.remembers
        {
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
        self.founders = Founders::default();
    }
}

impl Begun {
    /// The robots that have forgotten their grants, with their lives; and whether they had before this
    /// robot asked.
    fn forgetful(&self) -> impl Iterator<Item = ((RobotId, u32), bool)> {
        let answers = self.answers.iter();
        let forgot = answers.filter_map(|(&peer, forgot)| Some((peer, (*forgot)?)));
        forgot.map(|(peer, life)| {
            let seen = self.forgot_before.get(&peer) == Some(&life);
            ((peer, life), seen)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_to_an_earlier_question_does_not_count() {
        let (now, lease) = (Time::ZERO, Duration::from_seconds(2));
        let others = [RobotId(1), RobotId(2)];
        let mut recovery = Recovery::default();
        recovery.begin(5, now, false);
        assert!(
            others
                .iter()
                .all(|&peer| recovery.hear(peer, 5, None, Founders::default()))
        );
        assert!(recovery.ends_stage(now, &others, lease));
        assert!(
            !others
                .iter()
                .any(|&peer| recovery.hear(peer, 5, None, Founders::default()))
        );
        let outlook = recovery.outlook(now, &others, Some(lease));
        assert_eq!(outlook, Outlook::Unready);
        assert!(
            others
                .iter()
                .all(|&peer| recovery.hear(peer, 6, None, Founders::default()))
        );
        let outlook = recovery.outlook(now, &others, Some(lease));
        assert_eq!(outlook, Outlook::Ready);
    }
}
