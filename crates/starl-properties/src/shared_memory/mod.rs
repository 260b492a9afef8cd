//! Shared memory (thesis, section 3.3.2): eventual consistency, integrity and order.
//!
//! Convergence is judged with a bound, because only a bound can be judged in finite time: a robot shows a write, or a
//! later one, no later than the bound after it was written, or after the last excuse. Each robot that shows the write
//! must pass it on to each robot that has the memory, as long as both work and no partition can have separated them.

mod causality;
mod debt;
mod element;

pub(super) use causality::Causality;

use super::health::{Health, Needs};
use super::parts::Parts;
use super::pending::Pending;
use super::report::Report;
use super::{Checker, Excuse, Excused, Kinds, Setting, Violation};
use debt::{Address, Debt};
use element::{Element, Shown, Stamp};
use starl_core::event::storing::Written;
use starl_core::event::{Event, Fault, SharedMemoryEvent};
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
    /// The writes that must be shown, by the time at which they are judged and a running number.
    owed: BTreeMap<(Time, u64), Debt>,
    debts: u64,
    /// Robots that went back.
    backward: Pending,
    /// Whether some state was corrupted, so that memories may hold what was never written.
    corrupted: bool,
    excused: Excused,
}

/// One memory.
#[derive(Clone, Debug, Default)]
struct Memory {
    /// The robots with this memory, and since when.
    members: BTreeMap<RobotId, Time>,
    /// By name, and for arrays by owner.
    variables: BTreeMap<Arc<str>, BTreeMap<Option<RobotId>, Element>>,
}

impl SharedMemory {
    pub fn new(setting: &Setting) -> SharedMemory {
        let bound = setting.properties.shared_memory_bound;
        let robots = setting.bodies.len();
        SharedMemory {
            bound,
            health: Health::new(robots, Needs::Computing, bound),
            parts: Parts::new(robots, bound),
            memories: BTreeMap::new(),
            owed: BTreeMap::new(),
            debts: 0,
            backward: Pending::new(setting),
            corrupted: false,
            excused: Excused::default(),
        }
    }

    fn reported(&mut self, report: &Report<'_, SharedMemoryEvent>, found: &mut Vec<Violation>) {
        let Report {
            at, robot, port, ..
        } = *report;
        self.joined(port, robot, at);
        let (written, is_write) = match report.event {
            SharedMemoryEvent::Write { written } | SharedMemoryEvent::WriteAgain { written } => {
                (written, true)
            }
            SharedMemoryEvent::Update { written } => (written, false),
            SharedMemoryEvent::Start
            | SharedMemoryEvent::Initialize { .. }
            | SharedMemoryEvent::Causal { .. } => return,
        };
        let (owner, stamp, value) = (owner(written), Stamp::of(written), written.value);
        let memory = self.memories.entry(port).or_default();
        let variable = match memory.variables.get_key_value(&written.variable) {
            Some((known, _)) => known.clone(),
            None => written.variable.clone(),
        };
        let elements = memory.variables.entry(variable.clone()).or_default();
        let element = elements.entry(owner).or_default();
        let address = Address {
            port,
            variable,
            owner,
        };
        let is_new = is_write || !element.was_written(stamp, value);
        let wrong = if is_write && element.has_other(stamp, value) {
            Some(format!(
                "robot {robot} gave two values in {address} one stamp: {}",
                words(stamp)
            ))
        } else if is_new && !is_write {
            Some(format!(
                "robot {robot} shows a value in {address} that robot {} did not write",
                stamp.writer
            ))
        } else {
            None
        };
        match wrong {
            Some(text) if !self.corrupted => found.push(Violation {
                property: INTEGRITY.into(),
                at,
                robots: vec![robot, stamp.writer],
                text,
            }),
            Some(_) => self.excused.note(INTEGRITY, Excuse::Corruption),
            None => {}
        }
        if is_new {
            element.write(stamp, value, at);
        }
        if let Some(before) = element.show(robot, stamp, at) {
            self.backward.push(Violation {
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

    /// A robot has a memory. If it did not have it before, everything that is in it is to reach it.
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
            let stamp = element.latest()?;
            Some(Debt {
                address: Address {
                    port,
                    variable,
                    owner,
                },
                stamp,
                written: element.written_at(stamp).unwrap_or(at),
                to: Some(robot),
            })
        });
        for debt in latest.collect::<Vec<_>>() {
            self.owe(at + self.bound, debt);
        }
    }

    /// Time has come to `now`.
    fn pass(&mut self, now: Time, found: &mut Vec<Violation>) {
        self.check_bound(now, found);
        self.backward.settle(now, found);
    }

    /// A robot has lost its memories.
    fn crashed(&mut self, robot: RobotId) {
        let others = |back: &Violation| back.robots[0] != robot;
        self.backward
            .retain(Excuse::Down, &mut self.excused, others);
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
        let others = |back: &Violation| back.robots[0] != robot;
        self.backward
            .retain(Excuse::Corruption, &mut self.excused, others);
        for memory in self.memories.values_mut() {
            if memory.members.contains_key(&robot) {
                for element in memory.variables.values_mut().flat_map(|e| e.values_mut()) {
                    element.shown.insert(robot, Shown::Unknown);
                }
            }
        }
    }
}

impl Checker for SharedMemory {
    fn properties(&self) -> &'static [&'static str] {
        &[INTEGRITY, ORDER, CONVERGENCE]
    }

    fn heeds(&self) -> Kinds {
        Kinds::REPORTS | Kinds::SENT | Kinds::DELIVERED
    }

    fn is_owed(&self, property: &str) -> bool {
        property == CONVERGENCE && !self.owed.is_empty()
    }

    fn excused(&self, property: &str) -> Vec<(Excuse, u64)> {
        self.excused.of(property)
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        match &record.event {
            Event::Sent { .. } | Event::Delivered { .. } => self.parts.observe(record),
            Event::Primitive { .. } => {
                if let Some(report) = Report::of(record) {
                    self.pass(record.at, violations);
                    self.reported(&report, violations);
                }
            }
            Event::Fault(fault) => {
                self.pass(record.at, violations);
                self.health.observe(record);
                self.parts.observe(record);
                match (record.robot, fault) {
                    (Some(robot), Fault::Crash) => self.crashed(robot),
                    (Some(robot), Fault::CorruptState) => self.corrupted(robot),
                    _ => {}
                }
            }
            Event::Failed(_) => {
                self.pass(record.at, violations);
                self.health.observe(record);
            }
            _ => {}
        }
    }

    fn advance(&mut self, now: Time, violations: &mut Vec<Violation>) {
        self.pass(now, violations);
    }
}

/// The robot that owns an element of an array; none where all write the variable.
fn owner(written: &Written) -> Option<RobotId> {
    written.single_writer.then_some(written.writer)
}

fn words(stamp: Stamp) -> String {
    let Stamp {
        time,
        count,
        writer,
        ..
    } = stamp;
    format!("what robot {writer} wrote at {time} by its clock (count {count})")
}
