//! The answers of participants, including this robot, and when they are enough.
//!
//! Invariant: answers count together only if none of them is from a life of its sender that another one knows to be
//! over. So a value or promise of a majority is still that of a majority, or has been recovered.

use super::operation::{Answer, Kind, Phase};
use super::packet::{Entry, QuestionId};
use super::tag::Tag;
use super::version::Version;
use super::{Alarm, Register};
use starl_core::{Duration, Robot, RobotId};

/// A participant's answer to a question.
pub(super) enum Said {
    /// Its copy. `claimed` is the ballot that it promises now, `promised` the one before.
    Shown {
        claimed: Option<Tag>,
        promised: Option<Tag>,
        version: Option<Version>,
    },
    /// It has stored the copy with this tag.
    Stored(Tag),
    /// That it has not promised or stored that, since a greater ballot is promised.
    Refused { tag: Tag, promised: Tag },
}

impl Register {
    /// A participant answers.
    pub(super) fn answered(
        &mut self,
        robot: &mut Robot<'_>,
        from: RobotId,
        life: u64,
        id: QuestionId,
        said: Said,
    ) {
        let is_ours = self.incarnation.known() == Some(id.incarnation);
        if is_ours && self.is_member(robot, from) && self.note(from, life, id.number, said) {
            self.advance(robot, id.number);
            self.back_off(robot, id.number);
        }
    }

    /// Records an answer, if it is one to what is asked now.
    fn note(&mut self, from: RobotId, life: u64, number: u32, said: Said) -> bool {
        let Some(operation) = self.operations.get_mut(&number) else {
            return false;
        };
        let (asked, stored) = match (operation.phase, &operation.latest) {
            (Phase::Query, _) => (None, None),
            (Phase::Claim(ballot), _) => (Some(ballot), None),
            (Phase::Store, latest) => (None, latest.as_ref().map(|version| version.tag)),
        };
        let is_query = operation.phase != Phase::Store;
        let (tag, is_firm) = match said {
            Said::Shown {
                claimed,
                promised,
                version,
            } => {
                let tag = version.as_ref().map(|version| version.tag);
                let is_valid = version.as_ref().is_none_or(Version::is_valid)
                    && promised.is_none_or(Tag::is_valid);
                if !is_query || claimed != asked || !is_valid {
                    return false;
                }
                operation.heard(promised.max(tag));
                operation.found(version);
                (tag, promised <= tag)
            }
            Said::Stored(tag) => {
                if is_query || stored != Some(tag) {
                    return false;
                }
                (Some(tag), true)
            }
            Said::Refused { tag, promised } => {
                let is_asked = asked.or(stored) == Some(tag);
                if is_asked && promised.is_valid() && !operation.answers.contains_key(&from) {
                    operation.heard(Some(promised));
                    operation.refused.insert(from);
                }
                return is_asked;
            }
        };
        let answer = Answer { life, tag, is_firm };
        operation.refused.remove(&from);
        operation.answers.insert(from, answer);
        true
    }

    /// This robot's own answer, if it is a participant.
    pub(super) fn answer_own(&mut self, robot: &mut Robot<'_>, number: u32) {
        if !self.is_up() {
            return;
        }
        let Some(operation) = self.operations.get(&number) else {
            return;
        };
        let register = operation.register.clone();
        let said = match (operation.phase, &operation.latest) {
            (Phase::Query, _) => Said::Shown {
                claimed: None,
                promised: self.replica.promised(&register),
                version: self.replica.get(&register).cloned(),
            },
            (Phase::Claim(ballot), _) => match self.promise(&register, ballot) {
                Ok(promised) => Said::Shown {
                    claimed: Some(ballot),
                    promised,
                    version: self.replica.get(&register).cloned(),
                },
                Err(Some(promised)) => Said::Refused {
                    tag: ballot,
                    promised,
                },
                Err(None) => return,
            },
            (Phase::Store, Some(version)) => {
                let (tag, version) = (version.tag, version.clone());
                let register = (*register).into();
                match self.store(robot, &Entry { register, version }) {
                    Err(Some(promised)) => Said::Refused { tag, promised },
                    Ok(()) => Said::Stored(tag),
                    Err(None) => return,
                }
            }
            (Phase::Store, None) => return,
        };
        let (me, life) = (robot.id(), self.standing.life());
        self.note(me, life, number, said);
    }

    /// Continues an operation if a majority has answered.
    pub(super) fn advance(&mut self, robot: &mut Robot<'_>, number: u32) {
        let (me, majority) = (robot.id(), self.majority(robot));
        let incarnation = self.incarnation.of(robot);
        while let Some(operation) = self.operations.get_mut(&number) {
            let lives = &self.lives;
            operation
                .answers
                .retain(|&robot, answer| answer.life >= lives.of(robot));
            if operation.answers.len() < majority {
                return;
            }
            let is_unanimous = operation.is_unanimous();
            match (operation.phase, &mut operation.kind) {
                (Phase::Store, _) | (Phase::Claim(_), Kind::Claim) => {
                    return self.finish(robot, number);
                }
                (Phase::Query, Kind::Read) if is_unanimous => {
                    return self.finish(robot, number);
                }
                (Phase::Query, Kind::Read) if operation.latest.is_some() => {
                    operation.enter(Phase::Store);
                }
                (Phase::Query, Kind::Write(value)) => {
                    let value = value.clone();
                    let tag = Tag::after(operation.greatest, me, incarnation);
                    operation.latest = Some(Version::written(tag, value));
                    operation.enter(Phase::Store);
                }
                (Phase::Query, _) => return self.claim_anew(robot, number),
                (Phase::Claim(ballot), kind) => {
                    let mut version = operation.latest.take().unwrap_or_default();
                    if let Kind::Update { ballot, found } = kind {
                        *found = Some(version.writers.get(&me) == Some(ballot));
                    }
                    version.tag = ballot;
                    operation.latest = Some(version);
                    operation.enter(Phase::Store);
                }
            }
            self.answer_own(robot, number);
            self.ask(robot, number);
        }
    }

    /// Whether an operation cannot continue as it is, since others have promised a greater ballot.
    pub(super) fn is_refused(&self, robot: &Robot<'_>, number: u32) -> bool {
        let majority = self.majority(robot);
        self.operations.get(&number).is_some_and(|operation| {
            let (answers, refused) = (operation.answers.len(), operation.refused.len());
            refused > 0 && answers < majority && answers + refused >= majority
        })
    }

    /// If an operation is refused, waits for a random time, so that robots that claim the same do not refuse
    /// each other for ever.
    pub(super) fn back_off(&mut self, robot: &mut Robot<'_>, number: u32) {
        if !self.is_refused(robot, number) {
            return;
        }
        match self.operations.get_mut(&number) {
            Some(operation) if matches!(operation.kind, Kind::Write(_)) => {
                self.finish(robot, number);
            }
            Some(operation) if !operation.is_backing_off => {
                operation.is_backing_off = true;
                operation.rounds = operation.rounds.saturating_add(1);
                self.wait_at_random(robot, number);
            }
            _ => {}
        }
    }

    /// Waits before the next claim. The wait grows with the number of refusals, because many robots may be competing.
    pub(super) fn wait_at_random(&mut self, robot: &mut Robot<'_>, number: u32) {
        let rounds = self.operations.get(&number).map_or(0, |o| o.rounds);
        let for_all = self.options.first_timeout * robot.fleet().len() as u64;
        let longest = self.options.longest_timeout.max(for_all);
        let after = (self.options.first_timeout * (1 << rounds.min(20))).min(longest);
        let after = after.seconds() * robot.random().between(0.0, 1.0);
        let after = Duration::from_seconds_f64(after);
        robot.set_timer(self.timer(Alarm::Operation(number)), after);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::alone::alone;
    use crate::register::Options;
    use crate::register::entering::Standing;
    use starl_core::Payload;

    /// Robot 0 has asked for copies, and one other has answered that it has none: it stores its value next.
    fn writing(robot: &mut Robot<'_>) -> (Register, u32, Tag) {
        let mut register = Register::new("values", None, Options::default());
        register.standing = Standing::Up(1);
        register
            .write(robot, "x", Payload::from_slice(&[7]))
            .expect("a short name");
        let number = register.last_number;
        let nothing = Said::Shown {
            claimed: None,
            promised: None,
            version: None,
        };
        let incarnation = register.incarnation.of(robot);
        let id = QuestionId {
            incarnation,
            number,
        };
        register.answered(robot, RobotId(1), 1, id, nothing);
        let operation = &register.operations[&number];
        assert_eq!(operation.phase, Phase::Store);
        let tag = operation.latest.as_ref().expect("it is stored").tag;
        (register, number, tag)
    }

    #[test]
    fn an_acknowledgement_of_another_value_does_not_count() {
        alone(|robot| {
            let (mut register, number, tag) = writing(robot);
            let earlier = Tag::default();
            assert!(!register.note(RobotId(2), 1, number, Said::Stored(earlier)));
            assert!(
                !register.operations[&number]
                    .answers
                    .contains_key(&RobotId(2))
            );
            assert!(register.note(RobotId(2), 1, number, Said::Stored(tag)));
        });
    }
}
