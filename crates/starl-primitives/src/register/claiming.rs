//! Claims: reading and writing a register as one step.
//!
//! A claim asks a majority for its copies, and for the promise to store nothing under a lower ballot; the following
//! write is stored under the claim's ballot. So of two robots that claim a register one is refused or has read the
//! write of the other: no update is lost, independent of clocks, locks and leases. This is Lamport's Paxos (1998, "The
//! Part-Time Parliament") for one value that changes: Rystsov 2018, "CASPaxos: Replicated State Machines without logs".
//! A ballot is also a fencing number (Kleppmann 2016) that is checked where the value is kept.
//!
//! Invariant: a value is *chosen* once a majority has stored it while it had promised nothing greater. Each
//! ballot is used by one robot for one value. A robot that claims under a greater ballot learns every value
//! that was chosen before from a member of both majorities, so each chosen value was made from the one chosen
//! before it. Copies that spread in the background do not count as stored where something greater is
//! promised. A robot that restarts recovers promises like copies: for each promise that it gave, a robot of
//! the majority that it hears knows as much (the module `recovery`).
//!
//! Some robots may have stored a refused write, and the robot that claimed the register after it may have read it there
//! or not. To decide this, a copy names the latest ballot of each robot among those that have led to it. The writer
//! claims the register itself, checks whether its ballot is among them, and has the copy stored again under its new
//! ballot: from then on no earlier value can be chosen. An unfinished write of a crashed robot becomes part of the next
//! claim that finds it, or is never chosen. So the write is [`Status::Done`](super::Status::Done) or
//! [`Status::Lost`](super::Status::Lost), and never both.

use super::operation::{Kind, Operation, Phase};
use super::tag::Tag;
use super::version::Version;
use super::{MOST_RESULTS, OperationError, OperationId, Register, report};
use starl_core::event::RegisterEvent;
use starl_core::{Payload, Robot};

/// A register that this robot has claimed.
#[derive(Clone, Debug)]
pub(super) struct Claimed {
    pub ballot: Tag,
    /// The value that was found.
    pub version: Option<Version>,
}

impl Register {
    /// Begins to read a register in order to write it: no other write takes effect between this read and
    /// [`Register::write_claimed`], or that write is lost. The value read is certain only once that write is done.
    ///
    /// Robots that claim the same register at once disturb each other; the holder of a lock on it is
    /// not disturbed.
    ///
    /// # Errors
    /// The name is too long, there are too many operations, or this robot already claims that register or writes it
    /// after a claim.
    pub fn claim(
        &mut self,
        robot: &mut Robot<'_>,
        register: &str,
    ) -> Result<OperationId, OperationError> {
        let is_claim = |operation: &Operation| {
            let is_claim = matches!(operation.kind, Kind::Claim | Kind::Update { .. });
            is_claim && *operation.register == *register
        };
        // A copy names one ballot of each robot.
        if self.operations.values().any(is_claim) {
            return Err(OperationError::UnderWay);
        }
        self.claimed.remove(register);
        let id = self.prepare(robot, register, Kind::Claim)?;
        let operation = report::operation(id, register);
        robot.report(self.port, RegisterEvent::Claim { operation });
        self.claim_anew(robot, id.0);
        Ok(id)
    }

    /// Begins to write a register that this robot has claimed; once for each claim. Ends as
    /// [`Status::Done`](super::Status::Done), with what the register held then, or as [`Status::Lost`](super::Status::Lost) where another claim
    /// came between.
    ///
    /// # Errors
    /// As [`Register::write`]; and where it was not claimed.
    pub fn write_claimed(
        &mut self,
        robot: &mut Robot<'_>,
        register: &str,
        value: Payload,
    ) -> Result<OperationId, OperationError> {
        self.check(register, Some(&value))?;
        let claimed = self.claimed.remove(register);
        let Claimed { ballot, version } = claimed.ok_or(OperationError::NotClaimed)?;
        let kind = Kind::Update {
            ballot,
            found: None,
        };
        let id = self.prepare(robot, register, kind)?;
        let mut version = version.unwrap_or_default();
        let update = RegisterEvent::Update {
            operation: report::operation(id, register),
            found: version.value.as_ref().map(report::value_hash),
            value: report::value_hash(&value),
        };
        robot.report(self.port, update);
        version.tag = ballot;
        version.value = Some(value);
        let fleet = robot.fleet();
        version
            .writers
            .retain(|writer, _| fleet.binary_search(writer).is_ok());
        version.writers.insert(robot.id(), ballot);
        if let Some(operation) = self.operations.get_mut(&id.0) {
            operation.heard(Some(ballot));
            operation.latest = Some(version);
            operation.enter(Phase::Store);
        }
        self.set_out(robot, id);
        Ok(id)
    }

    /// Asks for all copies under a greater ballot.
    pub(super) fn claim_anew(&mut self, robot: &mut Robot<'_>, number: u32) {
        let incarnation = self.incarnation.of(robot);
        let Some(operation) = self.operations.get_mut(&number) else {
            return;
        };
        let register = &operation.register;
        let promised = self.replica.promised(register);
        let stored = self.replica.get(register).map(|version| version.tag);
        let known = [promised, stored, self.last_ballot, operation.greatest];
        let greatest = known
            .into_iter()
            .flatten()
            .filter(|tag| tag.is_valid())
            .max();
        // A robot that was refused often goes before those that begin at the same time.
        let ballot = Tag::after(greatest, robot.id(), incarnation).later_by(operation.rounds);
        self.last_ballot = Some(ballot);
        operation.claim(ballot);
        self.set_out(robot, OperationId(number));
    }

    /// Keeps what a claim has found, until it is written.
    pub(super) fn keep_claimed(&mut self, register: &str, ballot: Tag, version: Option<Version>) {
        let claimed = Claimed { ballot, version };
        self.claimed.insert(register.into(), claimed);
        while self.claimed.len() > MOST_RESULTS {
            self.claimed.pop_first();
        }
    }
}
