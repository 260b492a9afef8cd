//! How operations come about: asking, counting the answers, asking again.
//!
//! Invariant: answers count together only if none of them is from a life of its sender that another one
//! knows to be over. So what a majority has stored, a majority has, or has recovered.

use super::operation::{Operation, Phase};
use super::packet::{Entry, QuestionId};
use super::tag::Tag;
use super::{
    LONGEST_NAME, MOST_RESULTS, OPERATION_TIMER, OperationError, OperationId, Register, report,
};
use alloc::collections::BTreeMap;
use starl_core::{Payload, Robot, RobotId};

impl Register {
    /// Begins to read a register.
    ///
    /// # Errors
    /// Where the name is too long, or too much is under way.
    pub fn read(
        &mut self,
        robot: &mut Robot<'_>,
        register: &str,
    ) -> Result<OperationId, OperationError> {
        self.begin(robot, register, None)
    }

    /// Begins to write a register.
    ///
    /// # Errors
    /// Where the name or the value is too long, or too much is under way.
    pub fn write(
        &mut self,
        robot: &mut Robot<'_>,
        register: &str,
        value: Payload,
    ) -> Result<OperationId, OperationError> {
        self.begin(robot, register, Some(value))
    }

    /// Begins to write a register that this robot has read or written just before, and that nobody else
    /// writes meanwhile: it holds a lock on it. That saves asking for tags.
    ///
    /// Whoever comes to hold the lock should first write what it has read. What the one before wrote may not
    /// have reached a majority if that one has crashed, and would have the same tag as what comes next; of
    /// the second write on the tag is greater than any that the one before can have used.
    ///
    /// # Errors
    /// As [`Register::write`].
    pub fn write_locked(
        &mut self,
        robot: &mut Robot<'_>,
        register: &str,
        value: Payload,
    ) -> Result<OperationId, OperationError> {
        let found = self.replica.get(register).map(|(tag, _)| *tag);
        let id = self.prepare(robot, register, Some(value.clone()))?;
        let tag = Tag::after(found, robot.id(), self.incarnation.of(robot));
        if let Some(operation) = self.operations.get_mut(&id.0) {
            operation.phase = Phase::Store;
            operation.latest = Some((tag, value));
        }
        self.set_out(robot, id);
        Ok(id)
    }

    /// Gives up an operation, or forgets its result. One that was under way may still take effect.
    pub fn withdraw(&mut self, robot: &mut Robot<'_>, operation: OperationId) {
        self.results.remove(&operation.0);
        if let Some(withdrawn) = self.operations.remove(&operation.0) {
            robot.cancel_timer(self.timer(OPERATION_TIMER, operation.0));
            let register = &withdrawn.register;
            report::operation(robot, self.port, "withdraw", operation, register, None);
        }
    }

    fn begin(
        &mut self,
        robot: &mut Robot<'_>,
        register: &str,
        written: Option<Payload>,
    ) -> Result<OperationId, OperationError> {
        let id = self.prepare(robot, register, written)?;
        self.set_out(robot, id);
        Ok(id)
    }

    /// Asks others, or is done at once.
    fn set_out(&mut self, robot: &mut Robot<'_>, id: OperationId) {
        self.answer_own(robot, id.0);
        self.ask(robot, id.0);
        self.advance(robot, id.0);
    }

    /// Notes a new operation.
    fn prepare(
        &mut self,
        robot: &mut Robot<'_>,
        register: &str,
        written: Option<Payload>,
    ) -> Result<OperationId, OperationError> {
        let length = written.as_ref().map_or(0, |value| value.len());
        if register.len() > LONGEST_NAME {
            return Err(OperationError::NameTooLong);
        } else if length > self.options.longest_value {
            return Err(OperationError::ValueTooLong);
        } else if self.operations.len() >= self.options.most_operations {
            return Err(OperationError::TooMany);
        }
        self.last_number = self.last_number.wrapping_add(1);
        let id = OperationId(self.last_number);
        let event = match written {
            Some(_) => "write",
            None => "read",
        };
        report::operation(robot, self.port, event, id, register, written.as_deref());
        let operation = Operation {
            register: register.into(),
            written,
            phase: Phase::Query,
            answers: BTreeMap::new(),
            latest: None,
            begun: robot.now(),
            repetitions: 0,
            is_stuck: false,
        };
        self.operations.insert(id.0, operation);
        Ok(id)
    }

    /// A participant answers: with its copy, or that it has stored one.
    pub(super) fn answered(
        &mut self,
        robot: &mut Robot<'_>,
        from: RobotId,
        life: u64,
        id: QuestionId,
        copy: Option<(Option<Tag>, Payload)>,
    ) {
        if self.incarnation.known() != Some(id.incarnation) || !self.is_member(robot, from) {
            return;
        }
        let Some(operation) = self.operations.get_mut(&id.number) else {
            return;
        };
        match (operation.phase, copy) {
            (Phase::Query, Some((tag, value))) if tag.is_none_or(Tag::is_valid) => {
                operation.answers.insert(from, (life, tag));
                operation.found(tag, value);
            }
            (Phase::Store, None) => {
                operation.answers.insert(from, (life, None));
            }
            _ => return,
        }
        self.advance(robot, id.number);
    }

    /// This robot's own answer, if it is a participant.
    pub(super) fn answer_own(&mut self, robot: &mut Robot<'_>, number: u32) {
        let me = robot.id();
        let Some(operation) = self
            .operations
            .get_mut(&number)
            .filter(|_| matches!(self.standing, super::entering::Standing::Up(_)))
        else {
            return;
        };
        let life = self.standing.life();
        match (operation.phase, &operation.latest) {
            (Phase::Query, _) => {
                let own = self.replica.get(&operation.register).cloned();
                let tag = own.as_ref().map(|(tag, _)| *tag);
                operation.answers.insert(me, (life, tag));
                operation.found(tag, own.map(|(_, value)| value).unwrap_or_default());
            }
            (Phase::Store, Some((tag, value))) => {
                let entry = Entry {
                    register: (*operation.register).into(),
                    tag: *tag,
                    value: value.clone(),
                };
                operation.answers.insert(me, (life, None));
                self.merge(robot, &entry);
            }
            (Phase::Store, None) => {}
        }
    }

    /// Goes on with an operation if a majority has answered.
    pub(super) fn advance(&mut self, robot: &mut Robot<'_>, number: u32) {
        let majority = self.majority(robot);
        let incarnation = self.incarnation.of(robot);
        while let Some(operation) = self.operations.get_mut(&number) {
            let lives = &self.lives;
            operation
                .answers
                .retain(|&robot, &mut (life, _)| life >= lives.of(robot));
            if operation.answers.len() < majority {
                return;
            }
            if operation.phase == Phase::Store
                || operation.written.is_none() && operation.is_unanimous()
            {
                return self.finish(robot, number);
            }
            if let Some(value) = &operation.written {
                let found = operation.latest.as_ref().map(|(tag, _)| *tag);
                let tag = Tag::after(found, robot.id(), incarnation);
                operation.latest = Some((tag, value.clone()));
            }
            operation.phase = Phase::Store;
            operation.answers.clear();
            operation.repetitions = 0;
            self.answer_own(robot, number);
            self.ask(robot, number);
        }
    }

    fn finish(&mut self, robot: &mut Robot<'_>, number: u32) {
        let Some(operation) = self.operations.remove(&number) else {
            return;
        };
        robot.cancel_timer(self.timer(OPERATION_TIMER, number));
        if let Some((tag, value)) = &operation.latest {
            // What was found is shown here from now on too.
            let entry = Entry {
                register: (*operation.register).into(),
                tag: *tag,
                value: value.clone(),
            };
            self.merge(robot, &entry);
        }
        let result = operation.latest.map(|(_, value)| value);
        let (id, register) = (OperationId(number), &operation.register);
        report::operation(robot, self.port, "done", id, register, result.as_deref());
        self.results.insert(number, result);
        while self.results.len() > MOST_RESULTS {
            self.results.pop_first();
        }
    }
}
