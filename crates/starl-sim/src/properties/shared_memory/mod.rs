//! Shared memory (thesis, section 3.3.2): eventual consistency, and that what is shown was written and
//! never goes back.
//!
//! Convergence is judged with a bound, as nothing else can be judged in finite time: a robot shows a
//! write, or a later one, no later than the bound after it was written, or after the last moment at which
//! something excused it. It is owed by those that have it: by each robot that shows the write to each
//! robot that has the memory, as long as both are well and no partition can have kept them apart.

mod element;

use super::health::{Health, Needs};
use super::parts::Parts;
use super::report::Report;
use super::{Checker, Setting, Violation, robot_list};
use crate::scenario::Scenario;
use element::{Element, Shown, Stamp};
use starl_core::event::{Event, Value};
use starl_core::{Duration, Port, Record, RobotId, Time};
use std::collections::BTreeMap;
use std::sync::Arc;

const INTEGRITY: &str = "shared_memory.integrity";
const ORDER: &str = "shared_memory.order";
const CONVERGENCE: &str = "shared_memory.convergence";

/// Watches all shared memories.
#[derive(Clone, Debug)]
pub(super) struct SharedMemory {
    bound: Duration,
    health: Health,
    parts: Parts,
    memories: BTreeMap<Port, Memory>,
    /// What is to be shown, by the time at which it is judged and a running number.
    owed: BTreeMap<(Time, u64), Debt>,
    debts: u64,
    /// Whether some state was corrupted, so that memories may hold what was never written.
    corrupted: bool,
}

/// One memory.
#[derive(Clone, Debug, Default)]
struct Memory {
    /// Who has it, and since when.
    members: BTreeMap<RobotId, Time>,
    /// By name, and for arrays by owner.
    variables: BTreeMap<Arc<str>, BTreeMap<Option<RobotId>, Element>>,
}

/// An element by its names.
#[derive(Clone, Debug)]
struct Address {
    port: Port,
    variable: Arc<str>,
    owner: Option<RobotId>,
}

/// A write that is to be shown.
#[derive(Clone, Debug)]
struct Debt {
    address: Address,
    stamp: Stamp,
    /// When it was written.
    written: Time,
    /// To this robot; none where it is all.
    to: Option<RobotId>,
}

/// Whether a robot is yet to show a write.
enum Verdict {
    /// It may show it, or nobody is left that does.
    Settled,
    /// It does not, and should have by now.
    Late,
    /// It is to show it by then.
    Due(Time),
}

impl SharedMemory {
    pub fn new(scenario: &Scenario, setting: &Setting) -> SharedMemory {
        let bound = scenario.properties.shared_memory_bound;
        let robots = setting.bodies.len();
        SharedMemory {
            bound,
            health: Health::new(robots, Needs::Computing, bound),
            parts: Parts::new(robots, bound),
            memories: BTreeMap::new(),
            owed: BTreeMap::new(),
            debts: 0,
            corrupted: false,
        }
    }

    fn reported(&mut self, report: &Report<'_>, found: &mut Vec<Violation>) {
        let Report {
            at, robot, port, ..
        } = *report;
        self.joined(port, robot, at);
        let Some((variable, owner, stamp, value)) = content(report) else {
            return;
        };
        let memory = self.memories.entry(port).or_default();
        let variable = match memory.variables.get_key_value(variable) {
            Some((known, _)) => known.clone(),
            None => Arc::from(variable),
        };
        let elements = memory.variables.entry(variable.clone()).or_default();
        let element = elements.entry(owner).or_default();
        let address = Address {
            port,
            variable,
            owner,
        };
        let is_write = matches!(report.name, "write" | "write_again");
        let is_new = is_write || !element.was_written(stamp, value);
        if is_new && !is_write && !self.corrupted {
            found.push(Violation {
                property: INTEGRITY.into(),
                at,
                robots: vec![robot, stamp.writer],
                text: format!(
                    "robot {robot} shows a value in {address} that robot {} did not write",
                    stamp.writer
                ),
            });
        }
        if is_new {
            element.write(stamp, value);
        }
        if let Some(before) = element.show(robot, stamp, at) {
            found.push(Violation {
                property: ORDER.into(),
                at,
                robots: vec![robot],
                text: format!(
                    "robot {robot} went back in {address} from {} to {}",
                    words(before),
                    words(stamp)
                ),
            });
        }
        if is_new {
            let debt = Debt {
                address,
                stamp,
                written: at,
                to: None,
            };
            self.owe(at + self.bound, debt);
        }
    }

    /// A robot has a memory. If it did not have it before, all that is in it is to reach it.
    fn joined(&mut self, port: Port, robot: RobotId, at: Time) {
        let memory = self.memories.entry(port).or_default();
        if memory.members.contains_key(&robot) {
            return;
        }
        memory.members.insert(robot, at);
        let elements = memory.variables.iter().flat_map(|(variable, elements)| {
            let named = elements.iter();
            named.map(move |(&owner, element)| (variable.clone(), owner, element))
        });
        let latest = elements.filter_map(|(variable, owner, element)| {
            Some(Debt {
                address: Address {
                    port,
                    variable,
                    owner,
                },
                stamp: element.latest()?,
                written: at,
                to: Some(robot),
            })
        });
        for debt in latest.collect::<Vec<_>>() {
            self.owe(at + self.bound, debt);
        }
    }

    /// A robot has lost its memories.
    fn crashed(&mut self, robot: RobotId) {
        for memory in self.memories.values_mut() {
            if memory.members.remove(&robot).is_some() {
                for element in memory.variables.values_mut().flat_map(|e| e.values_mut()) {
                    element.shown.remove(&robot);
                }
            }
        }
    }

    /// A robot's memories were overwritten.
    fn corrupted(&mut self, robot: RobotId) {
        self.corrupted = true;
        for memory in self.memories.values_mut() {
            if memory.members.contains_key(&robot) {
                for element in memory.variables.values_mut().flat_map(|e| e.values_mut()) {
                    element.shown.insert(robot, Shown::Unknown);
                }
            }
        }
    }

    fn owe(&mut self, due: Time, debt: Debt) {
        self.debts += 1;
        self.owed.insert((due, self.debts), debt);
    }

    /// Judges what was to be shown before `now`.
    fn check_bound(&mut self, now: Time, found: &mut Vec<Violation>) {
        while let Some(first) = self.owed.first_entry() {
            let due = first.key().0;
            if due >= now {
                return;
            }
            let debt = first.remove();
            self.settle(due, &debt, found);
        }
    }

    fn settle(&mut self, now: Time, debt: &Debt, found: &mut Vec<Violation>) {
        let Address {
            port,
            variable,
            owner,
        } = &debt.address;
        let Some(memory) = self.memories.get(port) else {
            return;
        };
        let elements = memory.variables.get(variable);
        let Some(element) = elements.and_then(|elements| elements.get(owner)) else {
            return;
        };
        let is_latest = element.latest().is_none_or(|latest| latest <= debt.stamp);
        let (mut late, mut due) = (Vec::new(), Vec::new());
        let mut everyone = debt.to.is_none();
        let robots = memory.members.keys().copied();
        for robot in robots.filter(|&robot| debt.to.is_none_or(|to| to == robot)) {
            match self.judge(robot, debt, memory, element, now) {
                Verdict::Settled => continue,
                Verdict::Late => late.push(robot),
                // A later write is to be shown too, and stands for this one.
                Verdict::Due(time) if is_latest => due.push((time, robot)),
                Verdict::Due(_) => {}
            }
            everyone = false;
        }
        if everyone {
            self.forget(debt);
        }
        for (time, robot) in due {
            let to = Some(robot);
            self.owe(time, Debt { to, ..debt.clone() });
        }
        if !late.is_empty() {
            let text = format!(
                "{} did not come to show what robot {} wrote to {} at {} within {}",
                robot_list(&late),
                debt.stamp.writer,
                debt.address,
                debt.written,
                self.bound
            );
            found.push(Violation {
                property: CONVERGENCE.into(),
                at: now,
                robots: [debt.stamp.writer].into_iter().chain(late).collect(),
                text,
            });
        }
    }

    /// Whether a robot shows a write, or who owes it to it since when.
    fn judge(
        &self,
        robot: RobotId,
        debt: &Debt,
        memory: &Memory,
        element: &Element,
        now: Time,
    ) -> Verdict {
        let shown = element.shown.get(&robot);
        if shown.is_some_and(|shown| shown.may_be_at_least(debt.stamp)) {
            return Verdict::Settled;
        }
        // Since when a robot has been in a state to keep the promise.
        let ready = |robot| {
            let joined = memory.members.get(&robot).copied().unwrap_or(Time::NEVER);
            self.health.well_from(robot).max(joined)
        };
        let holders = element.shown.iter().filter_map(|(&holder, shown)| {
            let Shown::Write(stamp, since) = *shown else {
                return None;
            };
            // The writer has shown it or later ones ever since.
            let is_writer = holder == debt.stamp.writer && holder != robot;
            let since = if is_writer {
                since.min(debt.written)
            } else {
                since
            };
            let together = self.parts.together_since(holder, robot);
            (stamp >= debt.stamp).then(|| since.max(ready(holder)).max(together))
        });
        let Some(owed_since) = holders.min() else {
            return Verdict::Settled;
        };
        let owed_since = owed_since.max(ready(robot)).max(debt.written);
        if owed_since == Time::NEVER {
            // Nobody can show it to it now.
            return Verdict::Due(now + self.bound);
        }
        let due = owed_since + self.bound;
        if due <= now {
            Verdict::Late
        } else {
            Verdict::Due(due)
        }
    }

    /// Everyone shows a write; those before it are not asked for again.
    fn forget(&mut self, debt: &Debt) {
        let Address {
            port,
            variable,
            owner,
        } = &debt.address;
        let memory = self.memories.get_mut(port);
        let elements = memory.and_then(|memory| memory.variables.get_mut(variable));
        if let Some(element) = elements.and_then(|elements| elements.get_mut(owner)) {
            element.forget_before(debt.stamp);
        }
    }
}

impl Checker for SharedMemory {
    fn properties(&self) -> &'static [&'static str] {
        &[INTEGRITY, ORDER, CONVERGENCE]
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        match &record.event {
            Event::Sent { .. } | Event::Delivered { .. } => self.parts.observe(record),
            Event::Primitive { .. } => {
                if let Some(report) = Report::of(record, "shared_memory") {
                    self.check_bound(record.at, violations);
                    self.reported(&report, violations);
                }
            }
            Event::Fault(fault) => {
                self.check_bound(record.at, violations);
                self.health.observe(record);
                self.parts.observe(record);
                match (record.robot, &**fault) {
                    (Some(robot), "crash") => self.crashed(robot),
                    (Some(robot), "corrupt state") => self.corrupted(robot),
                    _ => {}
                }
            }
            Event::Failed(_) => {
                self.check_bound(record.at, violations);
                self.health.observe(record);
            }
            _ => {}
        }
    }

    fn advance(&mut self, now: Time, violations: &mut Vec<Violation>) {
        self.check_bound(now, violations);
    }
}

impl std::fmt::Display for Address {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.owner {
            None => write!(f, "{}", self.variable),
            Some(owner) => write!(f, "{}[{owner}]", self.variable),
        }
    }
}

/// What an event says of an element: its variable, its owner in an array, the write and its value.
fn content<'a>(report: &Report<'a>) -> Option<(&'a str, Option<RobotId>, Stamp, i64)> {
    let Some(Value::Text(variable)) = report.get("variable") else {
        return None;
    };
    let fields = ["single_writer", "time", "count", "writer", "value"];
    match fields.map(|field| report.get(field)) {
        [
            Some(&Value::Bool(single_writer)),
            Some(&Value::Time(time)),
            Some(&Value::Int(count)),
            Some(&Value::Robot(writer)),
            Some(&Value::Int(value)),
        ] => {
            let stamp = Stamp {
                time,
                count,
                writer,
            };
            Some((variable, single_writer.then_some(writer), stamp, value))
        }
        _ => None,
    }
}

fn words(stamp: Stamp) -> String {
    let Stamp {
        time,
        count,
        writer,
    } = stamp;
    format!("what robot {writer} wrote at {time} by its clock (count {count})")
}
