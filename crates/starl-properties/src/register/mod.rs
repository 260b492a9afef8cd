//! Registers: linearizability, from the robots' reports of the begins and ends of operations.
//!
//! Each register is judged separately, because a system is linearizable if each of its objects is (Herlihy and Wing
//! 1990, "Linearizability: A Correctness Condition for Concurrent Objects").

mod search;

use super::report::Report;
use super::{Checker, Excuse, Excused, Kinds, Setting, Violation};
use search::{Content, Id, Search, Verdict};
use starl_core::event::storing as event;
use starl_core::event::{Event, Fault, RegisterEvent};
use starl_core::{Duration, Port, Record, RobotId, Time};
use std::collections::{BTreeMap, BTreeSet};

const LINEARIZABILITY: &str = "register.linearizability";
/// Copies that were left from before have spread so long after a majority has come back.
const SETTLED: Duration = Duration::from_seconds(35);

/// Watches all registers.
#[derive(Clone, Debug, Default)]
pub(super) struct Register {
    instances: BTreeMap<Port, Instance>,
    /// Counts operations.
    last: Id,
    /// Whether some state was corrupted, so that copies may hold what was never written.
    corrupted: bool,
    /// The number of robots.
    fleet: usize,
    /// The robots that are down, and whether the network is partitioned.
    down: BTreeSet<RobotId>,
    is_parted: bool,
    /// Whether a crash leaves robots what they have stored.
    keeps_storage: bool,
    excused: Excused,
}

/// The registers of one instance.
#[derive(Clone, Debug, Default)]
struct Instance {
    registers: BTreeMap<String, Search>,
    /// The pending operations: by robot and its number for the operation.
    operations: BTreeMap<(RobotId, u32), Operation>,
    /// Operations that will not end, but may still take effect on a register that is judged again.
    loose: Vec<Operation>,
    /// The size of the fleet, of which majorities are, and the robots that keep copies now.
    fleet: usize,
    up: BTreeSet<RobotId>,
    /// Whether a majority has been down or recovering at once, having forgotten all, so that values may be lost.
    is_lost: bool,
    /// After that: since when nothing has happened that may bring back what was lost; [`Time::NEVER`] while no
    /// majority is up. [`SETTLED`] later it is judged again.
    quiet_since: Time,
}

#[derive(Clone, Debug)]
struct Operation {
    id: Id,
    register: String,
    kind: Kind,
    /// The value that it writes, and the value that it replaces.
    value: i64,
    found: Content,
    begun: Time,
    /// Whether another operation on the register was under way meanwhile.
    is_crowded: bool,
}

impl Operation {
    fn begin(&self, search: &mut Search) {
        match self.kind {
            Kind::Read => search.read_begins(self.id),
            Kind::Write => search.write_begins(self.id, self.value),
            Kind::Update => search.update_begins(self.id, self.found, self.value),
        }
    }
}

/// The kind of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Read,
    Write,
    /// It replaces the value that was found.
    Update,
}

impl Instance {
    /// The history of a register; none as long as its content is unknown.
    fn search(&mut self, register: &str) -> Option<&mut Search> {
        if !self.is_lost {
            return Some(self.registers.entry(register.into()).or_default());
        }
        self.registers.get_mut(register)
    }

    /// An operation will not end, but may still take effect.
    fn abandon(&mut self, operation: Operation) {
        match self.registers.get_mut(&operation.register) {
            Some(search) => search.is_abandoned(operation.id),
            None => self.loose.push(operation),
        }
    }

    /// An operation that has ended shows what its register holds, after a majority had forgotten it, if it was the
    /// only one: from now on the register is judged again.
    fn learn(&mut self, ended: &Operation, result: Content) {
        let is_settled = ended.begun >= self.quiet_since + SETTLED;
        if ended.is_crowded || !is_settled || self.quiet_since == Time::NEVER {
            return;
        }
        let mut search = Search::holding(match ended.kind {
            Kind::Read => result,
            Kind::Write | Kind::Update => Content::Value(ended.value),
        });
        self.loose.retain(|operation| {
            let is_of_it = operation.register == ended.register;
            if is_of_it {
                operation.begin(&mut search);
                search.is_abandoned(operation.id);
            }
            !is_of_it
        });
        self.registers.insert(ended.register.clone(), search);
    }

    fn crashed(&mut self, robot: RobotId) {
        let under_way = self.operations.range((robot, 0)..=(robot, u32::MAX));
        let keys: Vec<(RobotId, u32)> = under_way.map(|(&key, _)| key).collect();
        for key in keys {
            if let Some(operation) = self.operations.remove(&key) {
                self.abandon(operation);
            }
        }
    }

    /// A robot has lost its copies. Whether that made a majority, so that values may be lost.
    fn forgot(&mut self, robot: RobotId) -> bool {
        let had_majority = self.has_majority();
        self.up.remove(&robot);
        let has_majority = self.has_majority();
        let loses = had_majority && !has_majority;
        if loses {
            self.is_lost = true;
            self.registers.clear();
        }
        loses
    }

    /// Something has happened that may bring back what was lost, or a majority is there again.
    fn stir(&mut self, at: Time, is_whole: bool) {
        self.loose.clear();
        let has_majority = self.has_majority();
        self.quiet_since = match has_majority && is_whole {
            true => at,
            false => Time::NEVER,
        };
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
        result: Option<Content>,
        end: impl FnOnce(&mut Search, &Operation),
    ) -> Option<Violation> {
        let operation = self.ends(report.robot, operation)?;
        let Some(search) = self.search(&operation.register) else {
            self.learn(&operation, result?);
            return None;
        };
        let before = search.verdict();
        end(search, &operation);
        let verdict = search.verdict();
        (before != verdict).then(|| violation(verdict, &operation, report.at, report.robot))?
    }

    fn is_up(&mut self, robot: RobotId) {
        self.up.insert(robot);
    }

    fn has_majority(&self) -> bool {
        self.up.len() > self.fleet / 2
    }
}

impl Register {
    pub fn new(setting: &Setting) -> Register {
        Register {
            fleet: setting.bodies.len(),
            keeps_storage: setting.keeps_storage,
            ..Register::default()
        }
    }

    fn reported(&mut self, report: &Report<'_, RegisterEvent>, found: &mut Vec<Violation>) {
        let fleet = self.fleet;
        let instance = self
            .instances
            .entry(report.port)
            .or_insert_with(|| Instance {
                fleet,
                ..Instance::default()
            });
        if let RegisterEvent::Up { .. } = report.event {
            instance.is_up(report.robot);
            return self.stir(report.at);
        }
        if self.corrupted {
            return;
        }
        match report.event {
            RegisterEvent::Read { operation } => {
                self.begins(report, operation, Kind::Read, (Content::Nothing, 0));
            }
            RegisterEvent::Write { operation, value } => {
                self.begins(report, operation, Kind::Write, (Content::Nothing, *value));
            }
            RegisterEvent::Update {
                operation,
                found,
                value,
            } => {
                let found = found.map_or(Content::Nothing, Content::Value);
                self.begins(report, operation, Kind::Update, (found, *value));
            }
            RegisterEvent::Withdraw { operation } | RegisterEvent::Refused { operation, .. } => {
                if let Some(operation) = instance.ends(report.robot, operation) {
                    instance.abandon(operation);
                }
            }
            RegisterEvent::Done { operation, value } => {
                let content = value.map_or(Content::Nothing, Content::Value);
                let result = Some(content);
                found.extend(instance.judge(report, operation, result, |search, ending| {
                    match ending.kind {
                        Kind::Write | Kind::Update => search.write_ends(ending.id),
                        Kind::Read => search.read_ends(ending.id, content),
                    }
                }));
            }
            RegisterEvent::Lost { operation, .. } => {
                found.extend(instance.judge(report, operation, None, |search, ending| {
                    search.update_is_lost(ending.id);
                }));
            }
            RegisterEvent::Up { .. }
            | RegisterEvent::Claim { .. }
            | RegisterEvent::NoQuorum { .. } => {}
        }
    }

    /// A robot is down; whether what it stores `is_kept`.
    fn crashed(&mut self, robot: RobotId, is_kept: bool) {
        for instance in self.instances.values_mut() {
            instance.crashed(robot);
            if !is_kept && instance.forgot(robot) {
                self.excused.note(LINEARIZABILITY, Excuse::NoMajority);
            }
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
        (found, value): (Content, i64),
    ) {
        self.last += 1;
        let instance = self.instances.entry(report.port).or_default();
        let mut begun = Operation {
            id: self.last,
            register: register.to_string(),
            kind,
            value,
            found,
            begun: report.at,
            is_crowded: false,
        };
        if let Some(search) = instance.search(register) {
            begun.begin(search);
        } else {
            let others = instance.operations.values_mut();
            for other in others.filter(|other| *other.register == **register) {
                other.is_crowded = true;
                begun.is_crowded = true;
            }
        }
        let key = (report.robot, *operation);
        instance.operations.insert(key, begun);
    }

    /// Something has happened that may bring back what a majority has lost, or a majority is there again.
    fn stir(&mut self, at: Time) {
        // Storage may hold what the others have forgotten.
        let is_whole = !self.is_parted && (!self.keeps_storage || self.down.is_empty());
        for instance in self.instances.values_mut() {
            instance.stir(at, is_whole);
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
            Event::Fault(fault) => {
                match (record.robot, fault) {
                    (Some(robot), Fault::Crash | Fault::StorageLost) => {
                        self.down.insert(robot);
                        self.crashed(robot, self.keeps_storage && *fault == Fault::Crash);
                    }
                    (Some(robot), Fault::Restart) => {
                        self.down.remove(&robot);
                    }
                    (_, Fault::CorruptState) => {
                        if !self.instances.is_empty() {
                            self.excused.note(LINEARIZABILITY, Excuse::Corruption);
                        }
                        self.corrupted = true;
                    }
                    (None, fault) if fault.parts() => self.is_parted = true,
                    (None, Fault::Heal) => self.is_parted = false,
                    _ => return,
                }
                self.stir(record.at);
            }
            _ => {}
        }
    }
}
