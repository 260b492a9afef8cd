//! Registers: linearizability, from what robots say of when their operations begin and end.
//!
//! Each register is judged for itself, as a whole is linearizable if each of its objects is (Herlihy and Wing
//! 1990, "Linearizability: A Correctness Condition for Concurrent Objects").

mod search;

use super::report::Report;
use super::{Checker, Kinds, Violation};
use search::{Content, Id, Search, Verdict};
use starl_core::event::{Event, Value};
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
}

/// The registers of one instance.
#[derive(Clone, Debug, Default)]
struct Instance {
    registers: BTreeMap<String, Search>,
    /// What is under way: by robot and its number for it.
    operations: BTreeMap<(RobotId, i64), Operation>,
    /// Who has kept copies at some time, and who does now.
    members: BTreeSet<RobotId>,
    up: BTreeSet<RobotId>,
    /// Whether a majority has been down or recovering at once, so that values may be lost.
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
        let under_way = self.operations.range((robot, i64::MIN)..=(robot, i64::MAX));
        let keys: Vec<(RobotId, i64)> = under_way.map(|(&key, _)| key).collect();
        for key in keys {
            if let Some(operation) = self.operations.remove(&key) {
                self.abandon(&operation);
            }
        }
        self.up.remove(&robot);
        if self.up.len() <= self.members.len() / 2 && self.members.contains(&robot) {
            self.is_lost = true;
            self.operations.clear();
            self.registers.clear();
        }
    }

    fn is_up(&mut self, robot: RobotId) {
        self.members.insert(robot);
        self.up.insert(robot);
    }
}

impl Register {
    fn reported(&mut self, report: &Report<'_>, found: &mut Vec<Violation>) {
        let Report {
            at, robot, port, ..
        } = *report;
        let instance = self.instances.entry(port).or_default();
        if report.name == "up" {
            return instance.is_up(robot);
        }
        if instance.is_lost || self.corrupted {
            return;
        }
        let (Some(&Value::Int(number)), Some(Value::Text(register))) =
            (report.get("operation"), report.get("register"))
        else {
            return;
        };
        let key = (robot, number);
        let value = match report.get("value") {
            Some(&Value::Int(value)) => Some(value),
            _ => None,
        };
        match (report.name, value) {
            ("read", _) | ("write" | "update", Some(_)) => {
                self.last += 1;
                let id = self.last;
                let search = instance.search(register);
                let kind = match (report.name, value) {
                    ("write", Some(value)) => {
                        search.write_begins(id, value);
                        Kind::Write
                    }
                    ("update", Some(value)) => {
                        let found = match report.get("found") {
                            Some(&Value::Int(found)) => Content::Value(found),
                            _ => Content::Nothing,
                        };
                        search.update_begins(id, found, value);
                        Kind::Update
                    }
                    _ => {
                        search.read_begins(id);
                        Kind::Read
                    }
                };
                let register = register.to_string();
                let operation = Operation { id, register, kind };
                instance.operations.insert(key, operation);
            }
            ("withdraw" | "refused", _) => {
                if let Some(operation) = instance.operations.remove(&key) {
                    instance.abandon(&operation);
                }
            }
            ("done" | "lost", _) => {
                if let Some(operation) = instance.operations.remove(&key) {
                    let search = instance.search(&operation.register);
                    let before = search.verdict();
                    match operation.kind {
                        Kind::Update if report.name == "lost" => {
                            search.update_is_lost(operation.id);
                        }
                        Kind::Write | Kind::Update => search.write_ends(operation.id),
                        Kind::Read => {
                            let content = value.map_or(Content::Nothing, Content::Value);
                            search.read_ends(operation.id, content);
                        }
                    }
                    let verdict = search.verdict();
                    if before != verdict {
                        found.extend(violation(verdict, &operation, at, robot));
                    }
                }
            }
            _ => {}
        }
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

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        match &record.event {
            Event::Primitive { .. } => {
                if let Some(report) = Report::of(record, "register") {
                    self.reported(&report, violations);
                }
            }
            Event::Fault(fault) => match (record.robot, &**fault) {
                (Some(robot), "crash") => {
                    for instance in self.instances.values_mut() {
                        instance.crashed(robot);
                    }
                }
                (_, "corrupt state") => self.corrupted = true,
                _ => {}
            },
            _ => {}
        }
    }
}
