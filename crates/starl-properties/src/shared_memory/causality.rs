//! Causality: a robot that shows a write of a causal variable shows all writes of causal variables that
//! its writer showed when it wrote, or later ones.

use super::element::Stamp;
use super::{Address, owner};
use crate::pending::Pending;
use crate::report::Report;
use crate::{Checker, Excuse, Excused, Kinds, Setting, Violation};
use starl_core::event::{Event, Fault, SharedMemoryEvent};
use starl_core::{Port, Record, RobotId, Time};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

const CAUSALITY: &str = "shared_memory.causality";

/// The number of writes of each element that are stored with their dependencies.
const MOST_WRITES: usize = 256;

/// An element: its variable, and its owner in an array.
type Element = (Arc<str>, Option<RobotId>);

/// The writes of causal variables that a robot shows.
type Shown = BTreeMap<Element, Stamp>;

/// Watches the causal variables of all shared memories.
#[derive(Clone, Debug, Default)]
pub(crate) struct Causality {
    memories: BTreeMap<Port, Memory>,
    /// The updates of robots at the present moment.
    fresh: Vec<Update>,
    pending: Pending,
    /// Whether some state was corrupted, so that memories may hold what was never written.
    corrupted: bool,
    excused: Excused,
}

/// One memory.
#[derive(Clone, Debug, Default)]
struct Memory {
    /// The variables that are causal.
    causal: BTreeSet<Arc<str>>,
    /// The writes that each robot shows.
    shown: BTreeMap<RobotId, Shown>,
    /// For each write what its writer showed besides.
    past: BTreeMap<Element, BTreeMap<Stamp, Arc<Shown>>>,
}

/// A robot shows a write from now on.
#[derive(Clone, Debug)]
struct Update {
    at: Time,
    robot: RobotId,
    port: Port,
    element: Element,
    stamp: Stamp,
    /// The other writes that its writer showed.
    past: Arc<Shown>,
}

impl Update {
    fn violation(&self, missing: &Element, needed: Stamp) -> Violation {
        let named = |(variable, owner): &Element| Address {
            port: self.port,
            variable: variable.clone(),
            owner: *owner,
        };
        Violation {
            property: CAUSALITY.into(),
            at: self.at,
            robots: vec![self.robot, self.stamp.writer],
            text: format!(
                "robot {} shows what robot {} wrote to {} and not what robot {} had written to {} \
                 before",
                self.robot,
                self.stamp.writer,
                named(&self.element),
                needed.writer,
                named(missing)
            ),
        }
    }
}

impl Causality {
    pub fn new(setting: &Setting) -> Causality {
        Causality {
            pending: Pending::new(setting),
            ..Causality::default()
        }
    }

    fn reported(&mut self, report: &Report<'_, SharedMemoryEvent>) {
        let Report {
            at, robot, port, ..
        } = *report;
        let (written, is_own) = match report.event {
            SharedMemoryEvent::Causal { variable } => {
                let memory = self.memories.entry(port).or_default();
                memory.causal.insert(variable.clone());
                return;
            }
            SharedMemoryEvent::Write { written } | SharedMemoryEvent::WriteAgain { written } => {
                (written, true)
            }
            SharedMemoryEvent::Update { written } => (written, false),
            SharedMemoryEvent::Start | SharedMemoryEvent::Initialize { .. } => return,
        };
        let Some(memory) = self.memories.get_mut(&port) else {
            return;
        };
        let Some(variable) = memory.causal.get(&written.variable).cloned() else {
            return;
        };
        let (element, stamp) = ((variable, owner(written)), Stamp::of(written));
        let shown = memory.shown.entry(robot).or_default();
        if is_own {
            let mut past = shown.clone();
            past.remove(&element);
            let writes = memory.past.entry(element.clone()).or_default();
            writes.insert(stamp, Arc::new(past));
            while writes.len() > MOST_WRITES {
                writes.pop_first();
            }
        } else {
            let past = memory.past.get(&element);
            if let Some(past) = past.and_then(|writes| writes.get(&stamp)) {
                self.fresh.push(Update {
                    at,
                    robot,
                    port,
                    element: element.clone(),
                    stamp,
                    past: past.clone(),
                });
            }
        }
        shown.insert(element, stamp);
    }

    /// Judges what was shown before `now`: what is shown at one moment is shown together.
    fn judge(&mut self, now: Time) {
        if self.fresh.first().is_none_or(|first| first.at >= now) {
            return;
        }
        for update in core::mem::take(&mut self.fresh) {
            let memory = self.memories.get(&update.port);
            let shown = memory.and_then(|memory| memory.shown.get(&update.robot));
            let is_missing = |(element, needed): &(&Element, &Stamp)| {
                shown.and_then(|shown| shown.get(*element)) < Some(*needed)
            };
            if let Some((missing, needed)) = update.past.iter().find(is_missing) {
                self.pending.push(update.violation(missing, *needed));
            }
        }
    }

    /// Reports what no fault can excuse any more.
    fn pass(&mut self, now: Time, found: &mut Vec<Violation>) {
        self.judge(now);
        self.pending.settle(now, found);
    }
}

impl Checker for Causality {
    fn properties(&self) -> &'static [&'static str] {
        &[CAUSALITY]
    }

    fn has_subject(&self, _: &str) -> bool {
        !self.memories.is_empty()
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
                if let Some(report) = Report::of(record)
                    && !self.corrupted
                {
                    self.pass(record.at, violations);
                    self.reported(&report);
                }
            }
            Event::Fault(fault) => match (record.robot, fault) {
                (Some(robot), Fault::Crash) => {
                    self.judge(Time::NEVER);
                    for memory in self.memories.values_mut() {
                        memory.shown.remove(&robot);
                    }
                }
                (_, Fault::CorruptState) => {
                    self.pass(record.at, violations);
                    if !self.memories.is_empty() && !self.corrupted {
                        self.excused.note(CAUSALITY, Excuse::Corruption);
                    }
                    self.corrupted = true;
                    self.fresh.clear();
                    self.pending
                        .retain(Excuse::Corruption, &mut self.excused, |_| false);
                }
                _ => {}
            },
            _ => {}
        }
    }

    fn advance(&mut self, now: Time, violations: &mut Vec<Violation>) {
        self.pass(now, violations);
    }
}
