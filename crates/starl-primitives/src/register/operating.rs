//! How operations begin and end.

use super::operation::{Kind, Operation, Phase};
use super::packet::Entry;
use super::{
    Alarm, LONGEST_NAME, MOST_RESULTS, OperationError, OperationId, Register, Status, report,
};
use alloc::collections::{BTreeMap, BTreeSet};
use starl_core::event::RegisterEvent;
use starl_core::{Payload, Robot};

impl Register {
    /// Begins to read a register.
    ///
    /// # Errors
    /// If the name is too long, or too much is under way.
    pub fn read(
        &mut self,
        robot: &mut Robot<'_>,
        register: &str,
    ) -> Result<OperationId, OperationError> {
        self.check(register, None)?;
        let id = self.prepare(robot, register, Kind::Read)?;
        let operation = report::operation(id, register);
        robot.report(self.port, RegisterEvent::Read { operation });
        self.set_out(robot, id);
        Ok(id)
    }

    /// Begins a write that does not depend on the register's value. A register that is also claimed should be written
    /// by [`Register::write_claimed`] only.
    ///
    /// # Errors
    /// The name or the value is too long, or there are too many operations.
    pub fn write(
        &mut self,
        robot: &mut Robot<'_>,
        register: &str,
        value: Payload,
    ) -> Result<OperationId, OperationError> {
        self.check(register, Some(&value))?;
        let id = self.prepare(robot, register, Kind::Write(value.clone()))?;
        let write = RegisterEvent::Write {
            operation: report::operation(id, register),
            value: report::value_hash(&value),
        };
        robot.report(self.port, write);
        self.set_out(robot, id);
        Ok(id)
    }

    /// Gives up an operation, or forgets its result. One that was under way may still take effect.
    pub fn withdraw(&mut self, robot: &mut Robot<'_>, operation: OperationId) {
        self.results.remove(&operation.0);
        if let Some(withdrawn) = self.operations.remove(&operation.0) {
            robot.cancel_timer(self.timer(Alarm::Operation(operation.0)));
            let operation = report::operation(operation, &withdrawn.register);
            robot.report(self.port, RegisterEvent::Withdraw { operation });
        }
    }

    /// Asks others, or is done at once.
    pub(super) fn set_out(&mut self, robot: &mut Robot<'_>, id: OperationId) {
        self.answer_own(robot, id.0);
        self.ask(robot, id.0);
        self.advance(robot, id.0);
        self.back_off(robot, id.0);
    }

    /// Whether an operation may be begun.
    pub(super) fn check(
        &self,
        register: &str,
        written: Option<&Payload>,
    ) -> Result<(), OperationError> {
        let length = written.map_or(0, |value| value.len());
        if register.len() > LONGEST_NAME {
            Err(OperationError::NameTooLong)
        } else if length > self.options.longest_value {
            Err(OperationError::ValueTooLong)
        } else if self.operations.len() >= self.options.most_operations {
            Err(OperationError::TooMany)
        } else {
            Ok(())
        }
    }

    /// Notes a new operation.
    pub(super) fn prepare(
        &mut self,
        robot: &mut Robot<'_>,
        register: &str,
        kind: Kind,
    ) -> Result<OperationId, OperationError> {
        self.check(register, None)?;
        self.last_number = self.last_number.wrapping_add(1);
        let id = OperationId(self.last_number);
        let operation = Operation {
            register: register.into(),
            kind,
            phase: Phase::Query,
            answers: BTreeMap::new(),
            refused: BTreeSet::new(),
            greatest: None,
            latest: None,
            begun: robot.now(),
            repetitions: 0,
            rounds: 0,
            is_backing_off: false,
            let_go: None,
            is_stuck: false,
        };
        self.operations.insert(id.0, operation);
        Ok(id)
    }

    /// Ends an operation.
    pub(super) fn finish(&mut self, robot: &mut Robot<'_>, number: u32) {
        let is_refused = self.is_refused(robot, number);
        let Some(operation) = self.operations.remove(&number) else {
            return;
        };
        robot.cancel_timer(self.timer(Alarm::Operation(number)));
        let register = &*operation.register;
        if let Phase::Claim(ballot) = operation.phase {
            self.keep_claimed(register, ballot, operation.latest.clone());
        }
        if let Some(version) = operation.latest.clone().filter(|_| !is_refused) {
            // The value that was found is shown here from now on too.
            let register = register.into();
            self.merge(robot, &Entry { register, version });
        }
        let result = operation.latest.and_then(|version| version.value);
        let is_lost = matches!(
            operation.kind,
            Kind::Update {
                found: Some(false),
                ..
            }
        );
        let operation = report::operation(OperationId(number), register);
        let value = result.as_ref().map(report::value_hash);
        let (event, status) = match (is_refused, is_lost) {
            (true, _) => (RegisterEvent::Refused { operation, value }, Status::Refused),
            (_, true) => (RegisterEvent::Lost { operation, value }, Status::Lost),
            _ => (
                RegisterEvent::Done { operation, value },
                Status::Done(result),
            ),
        };
        robot.report(self.port, event);
        self.results.insert(number, status);
        while self.results.len() > MOST_RESULTS {
            self.results.pop_first();
        }
    }
}
