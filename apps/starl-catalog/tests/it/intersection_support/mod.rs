//! Runs of the intersection: what its cars did, read from the records.

use crate::support::Case;
use starl_core::event::{MutexEvent, PrimitiveEvent};
use starl_core::{Event, RobotId, Time, Value};
use starl_sim::{Outcome, Run};
use std::collections::{BTreeMap, BTreeSet};

/// The result of a run.
#[derive(Debug, Default)]
pub struct Traffic {
    /// When each car left the last critical zone of its way, and with how much delay, in the order of these times.
    pub through: Vec<(Time, RobotId, f64)>,
    /// The last reports of the cars whether they are stuck.
    pub stuck: BTreeMap<RobotId, bool>,
    /// The critical zones that each car holds by the mutex: time, car, and whether it was entered or released.
    pub locks: Vec<(Time, RobotId, Lock)>,
    /// The violated properties, with the observations.
    pub violations: Vec<String>,
    /// Which properties these are.
    pub violated: BTreeSet<String>,
    pub outcome: Option<Outcome>,
}

/// A change of a lock.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Lock {
    Held(String),
    Released(String),
}

/// Runs an example of this name with settings and faults (the text of a file).
pub fn drive(example: &str, sets: &[&str], faults: &str) -> Traffic {
    let case = Case {
        example,
        robots: None,
        sets,
        seed: None,
        faults,
    };
    let mut run = case.start();
    let mut traffic = Traffic::default();
    while !run.is_over() {
        for record in run.step() {
            traffic.note(record.at, record.robot, &record.event);
        }
    }
    traffic.conclude(&run);
    traffic
}

impl Traffic {
    fn note(&mut self, at: Time, robot: Option<RobotId>, event: &Event) {
        let Some(robot) = robot else { return };
        match event {
            Event::Program { name, fields } => match (&**name, fields.first()) {
                ("through", Some((_, Value::Float(delay)))) => {
                    self.through.push((at, robot, *delay));
                }
                ("stuck", Some((_, Value::Bool(stuck)))) => {
                    self.stuck.insert(robot, *stuck);
                }
                _ => {}
            },
            Event::Primitive {
                event: PrimitiveEvent::Mutex(event),
                ..
            } => {
                let lock = match event {
                    MutexEvent::Enter { resource, .. } => Lock::Held(resource.to_string()),
                    MutexEvent::Release { resource } => Lock::Released(resource.to_string()),
                    _ => return,
                };
                self.locks.push((at, robot, lock));
            }
            _ => {}
        }
    }

    fn conclude(&mut self, run: &Run) {
        self.outcome = Some(run.outcome());
        let violations = run.violations().iter();
        let properties = violations.clone();
        self.violated = properties
            .map(|violation| violation.property.to_string())
            .collect();
        self.violations = violations
            .map(|violation| format!("{violation:?}"))
            .collect();
        let failures = run.failures().iter();
        self.violations
            .extend(failures.map(|failure| format!("{failure:?}")));
    }

    /// The cars that hold zones, at each moment at which one gets a zone. No two of them hold the same zone.
    pub fn holders(&self) -> Vec<Vec<RobotId>> {
        let mut held: BTreeMap<&str, RobotId> = BTreeMap::new();
        let mut moments = Vec::new();
        for (at, robot, lock) in &self.locks {
            match lock {
                Lock::Held(zone) => {
                    let other = held.insert(zone, *robot);
                    assert_eq!(other, None, "{zone} at {at} is {robot}'s too");
                    let mut holders: Vec<RobotId> = held.values().copied().collect();
                    holders.sort();
                    holders.dedup();
                    moments.push(holders);
                }
                Lock::Released(zone) => {
                    held.remove(zone.as_str());
                }
            }
        }
        moments
    }

    /// The cars that are through, in the order of their numbers.
    pub fn passed(&self) -> Vec<u32> {
        let mut passed: Vec<u32> = self.through.iter().map(|car| car.1.0).collect();
        passed.sort();
        passed
    }

    /// The cars that know at the end that they are stuck.
    pub fn stuck_at_the_end(&self) -> Vec<u32> {
        let stuck = self.stuck.iter().filter(|(_, stuck)| **stuck);
        stuck.map(|(robot, _)| robot.0).collect()
    }

    /// Cars per minute, from the first arrival to the last exit.
    pub fn per_minute(&self) -> f64 {
        let last = self.through.last().map_or(0.0, |car| car.0.seconds());
        self.through.len() as f64 * 60.0 / last
    }

    /// Mean and greatest delay, seconds.
    pub fn delays(&self) -> (f64, f64) {
        let delays = self.through.iter().map(|car| car.2);
        let sum: f64 = delays.clone().sum();
        (sum / self.through.len() as f64, delays.fold(0.0, f64::max))
    }
}
