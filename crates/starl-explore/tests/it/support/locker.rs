//! Robots that each enter a critical section once, and a checker of their reports.

use starl_core::event::{Fault, MutexEvent, PrimitiveEvent};
use starl_core::{Event, Primitives, Program, Record, Robot, RobotId};
use starl_primitives::Mutex;
use starl_primitives::mutex::{Options, Resources};
use starl_properties::{Checker, Violation};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Asks for its resources, gives them back at the activation after it got them, and finishes.
#[derive(Clone, Debug, Primitives)]
pub struct Locker {
    mutex: Mutex,
    /// By robot.
    wanted: Vec<Vec<&'static str>>,
    stage: u8,
}

impl Locker {
    /// Each robot asks for the resources with its number.
    pub fn new(wanted: &[&[&'static str]], options: Options) -> Locker {
        Locker {
            mutex: Mutex::new("lock", None, options),
            wanted: wanted.iter().map(|set| set.to_vec()).collect(),
            stage: 0,
        }
    }
}

impl Program for Locker {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        let wanted: Resources = match self.wanted.get(robot.id().index()) {
            Some(wanted) => wanted.iter().map(|&name| name.into()).collect(),
            None => Resources::new(),
        };
        match self.stage {
            0 => {
                self.mutex.acquire(robot, wanted).expect("it holds nothing");
                self.stage = 1;
            }
            1 if self.mutex.holds(&wanted) => {
                self.mutex.release(robot, &wanted);
                self.stage = 2;
                robot.finish();
            }
            _ => {}
        }
    }

    fn write_state(&self, text: &mut dyn Write) -> bool {
        write!(text, "{:?} {}", self.mutex, self.stage).is_ok()
    }
}

/// No resource is held by two robots.
#[derive(Clone, Debug, Default)]
pub struct Exclusion(BTreeMap<String, RobotId>);

impl Checker for Exclusion {
    fn properties(&self) -> &'static [&'static str] {
        &["exclusion"]
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        let Some(robot) = record.robot else { return };
        match &record.event {
            Event::Fault(Fault::Crash) => self.0.retain(|_, holder| *holder != robot),
            Event::Primitive {
                event: PrimitiveEvent::Mutex(event),
                ..
            } => match event {
                MutexEvent::Enter { resource, .. } => {
                    let before = self.0.insert(resource.to_string(), robot);
                    if let Some(holder) = before.filter(|holder| *holder != robot) {
                        violations.push(Violation {
                            property: "exclusion".into(),
                            at: record.at,
                            robots: vec![holder, robot],
                            text: format!("robots {holder} and {robot} hold {resource}"),
                        });
                    }
                }
                MutexEvent::Release { resource } | MutexEvent::Expire { resource } => {
                    self.0.remove(&**resource);
                }
                MutexEvent::Acquire { .. }
                | MutexEvent::Withdraw { .. }
                | MutexEvent::Ready { .. } => {}
            },
            _ => {}
        }
    }
}
