//! The causal past of a failure: the faults, lost messages and actions that it can depend on.
//!
//! An event happened before another if it came earlier on the same robot, or if it came before the sending of a message
//! that was delivered there (Lamport 1978, "Time, Clocks, and the Ordering of Events in a Distributed System"). Robots
//! also sense each other, which is left out.

use crate::Run;
use crate::trial::Finding;
use starl_core::event::{DropReason, Event};
use starl_core::{Record, RobotId};
use std::collections::{BTreeMap, BTreeSet};

/// The kinds of events in the causal past of a failure.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cause(BTreeSet<Kind>);

/// A kind of event that can cause a failure.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    /// A fault, or its end.
    Fault(String),
    /// A message between robots of the causal past was lost, for this reason.
    Lost(&'static str),
    /// A datagram arrived twice.
    Duplicate,
    /// An action of a program, or an event of its own.
    Action(String),
    /// A primitive, and an event of it.
    Primitive(String, String),
}

/// The events of a run as far as causal pasts need them.
#[derive(Default)]
pub struct History {
    /// By robot, in order.
    robots: Vec<Vec<Step>>,
    /// How many steps the sender had before it sent a datagram.
    sent: BTreeMap<(RobotId, u32), usize>,
    /// Each kind once; steps name it by its place.
    kinds: Vec<Kind>,
    places: BTreeMap<Kind, usize>,
    /// Lost datagrams: sender, its number, the receiver, and the reason.
    lost: Vec<(RobotId, u32, Option<RobotId>, &'static str)>,
}

enum Step {
    Kind(usize),
    Delivered(RobotId, u32),
}

impl Cause {
    /// Whether this is the same kind of causal past as `whole`, or a part of it: there is no fault, loss or action in it
    /// that is not in the other one too.
    pub fn is_part_of(&self, whole: &Cause) -> bool {
        self.0.is_subset(&whole.0)
    }
}

impl History {
    /// Takes in the next events.
    pub fn observe(&mut self, records: &[Record]) {
        for record in records {
            self.take(record);
        }
    }

    fn take(&mut self, record: &Record) {
        match (&record.event, record.robot) {
            (&Event::Sent { sequence, .. }, Some(robot)) => {
                // This also makes room for a robot that only sends.
                let before = self.steps(robot).len();
                self.sent.insert((robot, sequence), before);
            }
            (&Event::Delivered { from, sequence }, Some(robot)) => {
                self.steps(robot).push(Step::Delivered(from, sequence));
            }
            (
                &Event::Dropped {
                    from,
                    to,
                    sequence,
                    reason,
                },
                _,
            ) => {
                if let Some(reason) = word(reason) {
                    self.lost.push((from, sequence, to, reason));
                }
            }
            (event, Some(robot)) => {
                if let Some(kind) = Kind::of(event) {
                    let place = self.place(kind);
                    self.steps(robot).push(Step::Kind(place));
                }
            }
            _ => {}
        }
    }

    fn steps(&mut self, robot: RobotId) -> &mut Vec<Step> {
        if self.robots.len() <= robot.index() {
            self.robots.resize_with(robot.index() + 1, Vec::new);
        }
        &mut self.robots[robot.index()]
    }

    fn place(&mut self, kind: Kind) -> usize {
        if let Some(&place) = self.places.get(&kind) {
            return place;
        }
        self.kinds.push(kind.clone());
        self.places.insert(kind, self.kinds.len() - 1);
        self.kinds.len() - 1
    }

    /// The cause of a failure that has just come.
    pub fn cause(&self, run: &Run, finding: &Finding) -> Cause {
        let concerned: Vec<RobotId> = match finding {
            Finding::Violated(_) => {
                let first = run.violations().first();
                first.map_or(Vec::new(), |violation| violation.robots.clone())
            }
            Finding::Failed => {
                let first = run.failures().first();
                first.map(|failure| failure.robot).into_iter().collect()
            }
            Finding::Unreached => Vec::new(),
        };
        // The primitive that a property is about, as in `mutex.safety`.
        let about = finding.name().split_once('.').map_or("", |(name, _)| name);
        let mut kinds = self.past(&concerned);
        kinds.retain(|kind| !matches!(kind, Kind::Primitive(name, _) if name != about));
        Cause(kinds)
    }

    /// The kinds of events in the causal past of the present moment on these robots; on all robots if none is named.
    fn past(&self, concerned: &[RobotId]) -> BTreeSet<Kind> {
        let mut kinds = BTreeSet::new();
        let mut heard = BTreeSet::new();
        // By robot, how many of its steps are in the past; none if the robot is not.
        let mut until: Vec<Option<usize>> = vec![None; self.robots.len()];
        let all = 0..self.robots.len();
        let mut work: Vec<(usize, usize)> = all
            .filter(|&robot| concerned.is_empty() || concerned.contains(&RobotId(robot as u32)))
            .map(|robot| (robot, self.robots[robot].len()))
            .collect();
        while let Some((robot, end)) = work.pop() {
            let begin = until[robot].unwrap_or(0);
            until[robot] = Some(begin.max(end));
            for step in self.robots[robot].get(begin..end).unwrap_or_default() {
                match *step {
                    Step::Kind(place) => {
                        kinds.insert(self.kinds[place].clone());
                    }
                    Step::Delivered(from, sequence) => {
                        if !heard.insert((robot, from, sequence)) {
                            kinds.insert(Kind::Duplicate);
                        }
                        if let Some(&before) = self.sent.get(&(from, sequence)) {
                            work.push((from.index(), before));
                        }
                    }
                }
            }
        }
        let last = |robot: RobotId| until.get(robot.index()).copied().flatten();
        for &(from, sequence, to, reason) in &self.lost {
            let sent = self.sent.get(&(from, sequence));
            let was_sent = last(from)
                .zip(sent)
                .is_some_and(|(last, &sent)| sent <= last);
            if was_sent && to.is_none_or(|to| last(to).is_some()) {
                kinds.insert(Kind::Lost(reason));
            }
        }
        kinds
    }
}

impl Kind {
    fn of(event: &Event) -> Option<Kind> {
        Some(match event {
            Event::Fault(fault) => Kind::Fault(fault.to_string()),
            Event::Action(name) | Event::Program { name, .. } => Kind::Action(name.to_string()),
            Event::Collided { .. } => Kind::Action("collided".to_string()),
            Event::Finished => Kind::Action("finished".to_string()),
            Event::Failed(_) => Kind::Action("failed".to_string()),
            Event::Primitive { event, .. } => {
                Kind::Primitive(event.primitive().to_string(), event.name().to_string())
            }
            _ => return None,
        })
    }
}

/// The kind of trouble that loses a datagram; none for a receiver that is down, which has a fault of its own.
fn word(reason: DropReason) -> Option<&'static str> {
    match reason {
        DropReason::Loss => Some("loss"),
        DropReason::Range => Some("range"),
        DropReason::Partition => Some("partition"),
        DropReason::Bandwidth => Some("bandwidth"),
        DropReason::Size => Some("size"),
        DropReason::Down => None,
    }
}
