//! The content of a space-time diagram, gathered from the records of a run.
//!
//! The trace does not contain the parts of a partition; the scenario does.

use super::Extent;
use starl_core::event::{DropReason, Event, Fault, ValueRef, borrowed};
use starl_core::{Intervention, Point, Port, Record, RobotId, Time};
use starl_sim::Scenario;
use starl_sim::engine::timeline;
use starl_sim::scenario::FaultKind;
use std::collections::{BTreeMap, VecDeque};

/// More messages and marks than these are not kept; the first go. No drawing shows as many.
const MOST: usize = 50_000;

/// The events, in the order of time.
#[derive(Default)]
pub struct Story {
    pub title: String,
    /// Robots' names, by number.
    pub robots: Vec<String>,
    pub messages: VecDeque<Message>,
    pub marks: VecDeque<Mark>,
    /// The robots that were down, from when, and until when.
    pub outages: Vec<(RobotId, Time, Time)>,
    pub partitions: Vec<Partition>,
    pub violations: Vec<Violation>,
    /// The last that was heard of the run.
    pub end: Time,
    /// The names of primitives, by port.
    pub ports: BTreeMap<Port, String>,
    /// When datagrams that are under way were sent, and for which port.
    under_way: BTreeMap<(RobotId, u32), (Time, Port)>,
    /// The parts of the partitions that are to come.
    coming: VecDeque<Vec<Vec<RobotId>>>,
    /// Robots that are to join, and where.
    joining: Vec<(String, Point)>,
}

/// A message to one robot.
#[derive(Clone, Debug)]
pub struct Message {
    pub from: RobotId,
    /// None if it is lost for all receivers.
    pub to: Option<RobotId>,
    pub sent: Time,
    /// When it came, or was lost.
    pub at: Time,
    pub port: Port,
    /// The reason why it was lost.
    pub lost: Option<DropReason>,
}

/// Something that a robot did.
#[derive(Clone, Debug)]
pub struct Mark {
    pub robot: RobotId,
    pub at: Time,
    pub text: String,
    pub kind: MarkKind,
}

/// The kind of a robot's action.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarkKind {
    /// A primitive reported something.
    Primitive(Port),
    /// An action fired, or the program reported something.
    Program,
    /// A fault set in.
    Fault,
    /// The program finished.
    End,
}

/// A time in which the network was in parts.
#[derive(Clone, Debug)]
pub struct Partition {
    pub from: Time,
    pub to: Time,
    /// All other robots form one more part.
    pub parts: Vec<Vec<RobotId>>,
}

/// A property that did not hold.
#[derive(Clone, Debug)]
pub struct Violation {
    pub at: Time,
    pub robot: Option<RobotId>,
    pub property: String,
    pub text: String,
}

impl Story {
    /// A story of which nothing has happened yet.
    pub fn of(scenario: &Scenario) -> Story {
        let robots = (0..scenario.fleet.len() as u32).map(RobotId);
        let partitions = timeline(scenario).into_iter();
        Story {
            title: scenario.title.clone(),
            robots: robots.map(|robot| scenario.fleet.name(robot)).collect(),
            coming: partitions
                .filter_map(|fault| match fault.kind {
                    FaultKind::Partition(parts) | FaultKind::OneWay(parts) => Some(parts),
                    _ => None,
                })
                .collect(),
            ..Story::default()
        }
    }

    /// Whether later events are outside the drawing.
    pub fn is_past(&self, extent: &Extent) -> bool {
        match extent.until {
            Some(until) => self.end > until,
            None => self
                .violations
                .first()
                .is_some_and(|first| self.end > first.at),
        }
    }

    /// Adds the next record.
    pub fn observe(&mut self, record: &Record) {
        let at = record.at;
        self.end = self.end.max(at);
        match (&record.event, record.robot) {
            (&Event::Sent { sequence, port, .. }, Some(robot)) => {
                self.under_way.insert((robot, sequence), (at, port));
                if self.under_way.len() > MOST {
                    self.under_way.pop_first();
                }
            }
            (&Event::Delivered { from, sequence }, to) => {
                self.message(from, sequence, to, at, None)
            }
            (
                &Event::Dropped {
                    from,
                    to,
                    sequence,
                    reason,
                },
                _,
            ) => self.message(from, sequence, to, at, Some(reason)),
            (Event::Fault(fault), None) => self.part(fault, at),
            (Event::Fault(fault), Some(robot)) => self.fault(fault, robot, at),
            (Event::Violated { property, text }, robot) => self.violations.push(Violation {
                at,
                robot,
                property: property.to_string(),
                text: text.to_string(),
            }),
            (Event::Intervention(what), None) => self.steered(what),
            (Event::Moved(pose), Some(robot)) if robot.index() == self.robots.len() => {
                let joined = |(_, place): &(String, Point)| *place == pose.position;
                if let Some(found) = self.joining.iter().position(joined) {
                    self.robots.push(self.joining.swap_remove(found).0);
                }
            }
            (event, Some(robot)) => self.mark_event(event, robot, at),
            _ => {}
        }
    }

    fn steered(&mut self, what: &Intervention) {
        match what {
            Intervention::Fault(FaultKind::Partition(parts) | FaultKind::OneWay(parts)) => {
                self.coming.push_front(parts.clone());
            }
            Intervention::Join { name, pose, .. } => {
                self.joining.push((name.clone(), pose.position));
            }
            _ => {}
        }
    }

    fn mark_event(&mut self, event: &Event, robot: RobotId, at: Time) {
        let (text, kind) = match event {
            Event::Primitive { port, event } => {
                self.ports
                    .entry(*port)
                    .or_insert_with(|| event.primitive().to_string());
                let text = with_fields(event.name(), &event.fields());
                (text, MarkKind::Primitive(*port))
            }
            Event::Action(name) => (name.to_string(), MarkKind::Program),
            Event::Program { name, fields } => {
                (with_fields(name, &borrowed(fields)), MarkKind::Program)
            }
            Event::Finished => ("finished".to_string(), MarkKind::End),
            Event::Failed(_) => ("failed".to_string(), MarkKind::Fault),
            _ => return,
        };
        self.mark(robot, at, text, kind);
    }

    fn mark(&mut self, robot: RobotId, at: Time, text: String, kind: MarkKind) {
        self.marks.push_back(Mark {
            robot,
            at,
            text,
            kind,
        });
        if self.marks.len() > MOST {
            self.marks.pop_front();
        }
    }

    fn message(
        &mut self,
        from: RobotId,
        sequence: u32,
        to: Option<RobotId>,
        at: Time,
        lost: Option<DropReason>,
    ) {
        if let Some(&(sent, port)) = self.under_way.get(&(from, sequence)) {
            self.messages.push_back(Message {
                from,
                to,
                sent,
                at,
                port,
                lost,
            });
            if self.messages.len() > MOST {
                self.messages.pop_front();
            }
        }
    }

    fn part(&mut self, fault: &Fault, at: Time) {
        if let Some(last) = self.partitions.last_mut() {
            last.to = last.to.min(at);
        }
        if fault.parts() {
            self.partitions.push(Partition {
                from: at,
                to: Time::NEVER,
                parts: self.coming.pop_front().unwrap_or_default(),
            });
        }
    }

    fn fault(&mut self, fault: &Fault, robot: RobotId, at: Time) {
        match fault {
            Fault::Crash => self.outages.push((robot, at, Time::NEVER)),
            Fault::Restart => {
                let mut outages = self.outages.iter_mut().rev();
                if let Some((_, _, to)) = outages.find(|outage| outage.0 == robot) {
                    *to = (*to).min(at);
                }
            }
            _ => {}
        }
        self.mark(robot, at, fault.to_string(), MarkKind::Fault);
    }

    /// The part of a partition that a robot is in, from 0.
    pub fn part_of(&self, partition: &Partition, robot: RobotId) -> usize {
        let parts = &partition.parts;
        let found = parts.iter().position(|part| part.contains(&robot));
        found.unwrap_or(parts.len())
    }
}

/// The name of an event, with the values that fit on a label.
fn with_fields(name: &str, fields: &[(&str, ValueRef<'_>)]) -> String {
    let shown = fields.iter().filter_map(|(_, value)| short(*value));
    let words: Vec<String> = std::iter::once(name.to_string()).chain(shown).collect();
    let text = words.join(" ");
    match text.chars().count() > LONGEST {
        true => text.chars().take(LONGEST - 1).chain(['\u{2026}']).collect(),
        false => text,
    }
}

/// Longest label, letters.
const LONGEST: usize = 26;

fn short(value: ValueRef<'_>) -> Option<String> {
    match value {
        ValueRef::Text(text) => Some(text.to_string()),
        ValueRef::Robot(robot) => Some(robot.to_string()),
        ValueRef::Int(number) if number.unsigned_abs() < 100_000 => Some(number.to_string()),
        ValueRef::Bool(flag) => Some(flag.to_string()),
        ValueRef::Robots(robots) => {
            let names: Vec<String> = robots.iter().map(RobotId::to_string).collect();
            Some(format!("{{{}}}", names.join(" ")))
        }
        _ => None,
    }
}
