//! The questions of operations, their repetitions, and the reports that no robot answers.

use super::operation::{Kind, Phase};
use super::packet::{Content, Entry, QuestionId};
use super::{Alarm, OperationId, Register, report};
use alloc::vec::Vec;
use starl_core::event::RegisterEvent;
use starl_core::{Destination, Robot, RobotId};

impl Register {
    /// The current question of an operation.
    fn question(&mut self, robot: &mut Robot<'_>, number: u32) -> Option<Content> {
        let operation = self.operations.get(&number)?;
        let id = QuestionId {
            incarnation: self.incarnation.of(robot),
            number,
        };
        let register = (*operation.register).into();
        Some(match (operation.phase, &operation.latest) {
            (Phase::Store, Some(version)) => Content::Store {
                id,
                entry: Entry {
                    register,
                    version: version.clone(),
                },
            },
            (Phase::Claim(ballot), _) => Content::Claim {
                id,
                register,
                ballot,
            },
            _ => Content::Query {
                id,
                register,
                is_read: operation.kind == Kind::Read,
            },
        })
    }

    /// Asks those that have not answered. A robot that has just started waits until it is up: before, it may not know that
    /// the life in which another one answers is over.
    pub(super) fn ask(&mut self, robot: &mut Robot<'_>, number: u32) {
        let me = robot.id();
        if !self.is_up() && self.is_member(robot, me) {
            let pause = self.options.timeout(0);
            return robot.set_timer(self.timer(Alarm::Operation(number)), pause);
        }
        let Some(question) = self.question(robot, number) else {
            return;
        };
        let mut missing = self.members(robot);
        let Some(operation) = self.operations.get_mut(&number) else {
            return;
        };
        missing.retain(|peer| {
            let has_answered = operation.answers.contains_key(peer);
            *peer != me && !has_answered && !operation.refused.contains(peer)
        });
        let after = self.options.timeout(operation.repetitions);
        operation.repetitions = operation.repetitions.saturating_add(1);
        self.send_each(robot, &missing, &question);
        robot.set_timer(self.timer(Alarm::Operation(number)), after);
    }

    /// The time for answers is over.
    pub(super) fn ask_again(&mut self, robot: &mut Robot<'_>, number: u32) {
        if self.is_refused(robot, number) {
            return match self.lets_another_go_first(number) {
                true => self.wait_at_random(robot, number),
                false => self.claim_anew(robot, number),
            };
        }
        // A corruption may have removed answers, or invented some.
        self.answer_own(robot, number);
        self.advance(robot, number);
        self.ask(robot, number);
        self.judge(robot, number);
    }

    /// Whether another claim is under way, as far as this robot's own copy shows, for which it has not waited yet.
    fn lets_another_go_first(&mut self, number: u32) -> bool {
        let Some(operation) = self.operations.get_mut(&number) else {
            return false;
        };
        let promised = self.replica.promised(&operation.register);
        let stored = self.replica.get(&operation.register);
        let is_under_way = promised > stored.map(|version| version.tag);
        let lets_go = is_under_way && promised > operation.let_go;
        operation.let_go = promised;
        lets_go
    }

    /// Says so if no majority seems to answer.
    fn judge(&mut self, robot: &mut Robot<'_>, number: u32) {
        let mut members = self.members(robot);
        members.retain(|member| !self.suspects.contains(member));
        let is_hopeless = members.len() < self.majority(robot);
        let (patience, now) = (self.options.patience, robot.now());
        let Some(operation) = self.operations.get_mut(&number) else {
            return;
        };
        operation.begun = operation.begun.min(now);
        if !operation.is_stuck && (is_hopeless || now.since(operation.begun) >= patience) {
            operation.is_stuck = true;
            let operation = report::operation(OperationId(number), &operation.register);
            robot.report(self.port, RegisterEvent::NoQuorum { operation });
        }
    }

    /// A participant is believed to have failed.
    pub(super) fn suspect(&mut self, robot: &mut Robot<'_>, peer: RobotId) {
        if self.is_member(robot, peer) && self.suspects.insert(peer) {
            let numbers: Vec<u32> = self.operations.keys().copied().collect();
            numbers
                .into_iter()
                .for_each(|number| self.judge(robot, number));
        }
    }

    /// A participant is believed to be up again.
    pub(super) fn trust(&mut self, robot: &mut Robot<'_>, peer: RobotId) {
        self.suspects.remove(&peer);
        if !self.is_up() {
            return;
        }
        let asked: Vec<u32> = self
            .operations
            .iter()
            .filter(|(_, operation)| !operation.answers.contains_key(&peer))
            .map(|(&number, _)| number)
            .collect();
        for number in asked {
            if let Some(question) = self.question(robot, number) {
                self.send(robot, Destination::Robot(peer), question);
            }
        }
    }
}
