//! Registers: linearizability, from what robots say of when their operations begin and end.
//!
//! Each register is judged for itself, as a whole is linearizable if each of its objects is (Herlihy and Wing
//! 1990, "Linearizability: A Correctness Condition for Concurrent Objects").

mod search;

use super::report::Report;
use super::{Checker, Excuse, Excused, Kinds, Setting, Violation};
use search::{Content, Id, Search, Verdict};
use starl_core::event::storing as event;
use starl_core::event::{Event, Fault, RegisterEvent};
use starl_core::{Port, Record, RobotId, Time};
use std::collections::{BTreeMap, BTreeSet};

const LINEARIZABILITY: &str = "register.linearizability";

/// Watches all registers.
#[derive(Clone, Debug, Default)]
pub(super) struct Register {
    instances: BTreeMap<Port, Instance>,
    /// Counts operations.
    last: Id,
    /// Whether some state was corrupted, so that copies may hold what was never written.
    corrupted: bool,
    /// Whether a crash leaves robots what they have stored.
    keeps_storage: bool,
    excused: Excused,
}

/// The registers of one instance.
#[derive(Clone, Debug, Default)]
struct Instance {
    registers: BTreeMap<String, Search>,
    /// What is under way: by robot and its number for it.
    operations: BTreeMap<(RobotId, u32), Operation>,
    /// Who has kept copies at some time, and who does now.
    members: BTreeSet<RobotId>,
    up: BTreeSet<RobotId>,
    /// Whether a majority has been down or recovering at once, having forgotten all, so that values may be lost.
    is_lost: bool,
}

#[derive(Clone, Debug)]
struct Operation {
    id: Id,
    register: String,
    kind: Kind,
}

/// What an operation does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Read,
    Write,
    /// It writes in the place of what was found.
    Update,
}

impl Instance {
    fn search(&mut self, register: &str) -> &mut Search {
        self.registers.entry(register.into()).or_default()
    }

    fn abandon(&mut self, operation: &Operation) {
        if let Some(search) = self.registers.get_mut(&operation.register) {
            search.is_abandoned(operation.id);
        }
    }

    fn crashed(&mut self, robot: RobotId) {
        let under_way = self.operations.range((robot, 0)..=(robot, u32::MAX));
        let keys: Vec<(RobotId, u32)> = under_way.map(|(&key, _)| key).collect();
        for key in keys {
            if let Some(operation) = self.operations.remove(&key) {
                self.abandon(&operation);
            }
        }
    }

    /// A robot has lost its copies.
    fn forgot(&mut self, robot: RobotId) {
        self.up.remove(&robot);
        if self.up.len() <= self.members.len() / 2 && self.members.contains(&robot) {
            self.is_lost = true;
            self.operations.clear();
            self.registers.clear();
        }
    }

    /// An operation is under way no longer.
    fn ends(&mut self, robot: RobotId, operation: &event::Operation) -> Option<Operation> {
        self.operations.remove(&(robot, operation.operation))
    }

    /// An operation has ended in this way: whether that fits.
    fn judge(
        &mut self,
        report: &Report<'_, RegisterEvent>,
        operation: &event::Operation,
        end: impl FnOnce(&mut Search, &Operation),
    ) -> Option<Violation> {
        let operation = self.ends(report.robot, operation)?;
        let search = self.search(&operation.register);
        let before = search.verdict();
        end(search, &operation);
        let verdict = search.verdict();
        (before != verdict).then(|| violation(verdict, &operation, report.at, report.robot))?
    }

    fn is_up(&mut self, robot: RobotId) {
        self.members.insert(robot);
        self.up.insert(robot);
    }
}

impl Register {
    pub fn new(setting: &Setting) -> Register {
        Register {
            keeps_storage: setting.keeps_storage,
            ..Register::default()
        }
    }

    fn reported(&mut self, report: &Report<'_, RegisterEvent>, found: &mut Vec<Violation>) {
        let instance = self.instances.entry(report.port).or_default();
        if let RegisterEvent::Up { .. } = report.event {
            return instance.is_up(report.robot);
        }
        if instance.is_lost || self.corrupted {
            return;
        }
        match report.event {
            RegisterEvent::Read { operation } => {
                self.begins(report, operation, Kind::Read, Search::read_begins);
            }
            RegisterEvent::Write { operation, value } => {
                self.begins(report, operation, Kind::Write, |search, id| {
                    search.write_begins(id, *value);
                });
            }
            RegisterEvent::Update {
                operation,
                found,
                value,
            } => {
                let found = found.map_or(Content::Nothing, Content::Value);
                self.begins(report, operation, Kind::Update, |search, id| {
                    search.update_begins(id, found, *value);
                });
            }
            RegisterEvent::Withdraw { operation } | RegisterEvent::Refused { operation, .. } => {
                if let Some(operation) = instance.ends(report.robot, operation) {
                    instance.abandon(&operation);
                }
            }
            RegisterEvent::Done { operation, value } => {
                found.extend(instance.judge(report, operation, |search, ending| {
                    let content = value.map_or(Content::Nothing, Content::Value);
                    match ending.kind {
                        Kind::Write | Kind::Update => search.write_ends(ending.id),
                        Kind::Read => search.read_ends(ending.id, content),
                    }
                }));
            }
            RegisterEvent::Lost { operation, .. } => {
                found.extend(instance.judge(report, operation, |search, ending| {
                    search.update_is_lost(ending.id);
                }));
            }
            RegisterEvent::Up { .. }
            | RegisterEvent::Claim { .. }
            | RegisterEvent::NoQuorum { .. } => {}
        }
    }

    /// An operation begins.
    fn begins(
        &mut self,
        report: &Report<'_, RegisterEvent>,
        event::Operation {
            operation,
            register,
        }: &event::Operation,
        kind: Kind,
        begin: impl FnOnce(&mut Search, Id),
    ) {
        self.last += 1;
        let instance = self.instances.entry(report.port).or_default();
        begin(instance.search(register), self.last);
        let begun = Operation {
            id: self.last,
            register: register.to_string(),
            kind,
        };
        instance
            .operations
            .insert((report.robot, *operation), begun);
    }
}

fn violation(
    verdict: Verdict,
    operation: &Operation,
    at: Time,
    robot: RobotId,
) -> Option<Violation> {
    let Operation { register, kind, .. } = operation;
    let text = match verdict {
        Verdict::Possible => return None,
        Verdict::Impossible if *kind == Kind::Update => format!(
            "robot {robot} updated the register {register}, and what was found and written fits no order \
             of its updates: one is lost"
        ),
        Verdict::Impossible if *kind == Kind::Write => format!(
            "what was read of the register {register} fits no order in which the write of robot \
             {robot} took effect"
        ),
        Verdict::Impossible => format!(
            "robot {robot} read what the register {register} did not hold at any moment since it \
             began to read"
        ),
        Verdict::Unknown => format!(
            "it cannot be said whether the register {register} is linearizable: too many \
             operations are under way at once"
        ),
    };
    Some(Violation {
        property: LINEARIZABILITY.into(),
        at,
        robots: vec![robot],
        text,
    })
}

impl Checker for Register {
    fn properties(&self) -> &'static [&'static str] {
        &[LINEARIZABILITY]
    }

    fn heeds(&self) -> Kinds {
        Kinds::REPORTS
    }

    fn excused(&self, property: &str) -> Vec<(Excuse, u64)> {
        self.excused.of(property)
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        match &record.event {
            Event::Primitive { .. } => {
                if let Some(report) = Report::of(record) {
                    self.reported(&report, violations);
                }
            }
            Event::Fault(fault) => match (record.robot, fault) {
                (Some(robot), Fault::Crash | Fault::StorageLost) => {
                    let keeps = self.keeps_storage && *fault == Fault::Crash;
                    for instance in self.instances.values_mut() {
                        let was_lost = instance.is_lost;
                        instance.crashed(robot);
                        if !keeps {
                            instance.forgot(robot);
                        }
                        if instance.is_lost && !was_lost {
                            self.excused.note(LINEARIZABILITY, Excuse::NoMajority);
                        }
                    }
                }
                (_, Fault::CorruptState) => {
                    if !self.instances.is_empty() {
                        self.excused.note(LINEARIZABILITY, Excuse::Corruption);
                    }
                    self.corrupted = true;
                }
                _ => {}
            },
            _ => {}
        }
    }
}
