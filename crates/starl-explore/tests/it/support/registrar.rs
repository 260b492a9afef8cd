//! Robots that register, and a checker of their lists.

use starl_core::event::agreement::ListId;
use starl_core::event::{PrimitiveEvent, RegistrationEvent};
use starl_core::{Event, Primitives, Program, Record, Robot, RobotId, Time};
use starl_primitives::Registration;
use starl_primitives::registration::Options;
use starl_properties::{Checker, Violation};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Registers at its first activation.
#[derive(Clone, Debug, Primitives)]
pub struct Registrar {
    registration: Registration,
    is_registered: bool,
}

impl Registrar {
    /// Robots that register with all others.
    pub fn new(options: Options) -> Registrar {
        Registrar {
            registration: Registration::new("registration", options),
            is_registered: false,
        }
    }
}

impl Program for Registrar {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if !self.is_registered {
            self.is_registered = true;
            self.registration.register(robot, None);
        }
    }

    fn write_state(&self, text: &mut dyn Write) -> bool {
        write!(text, "{self:?}").is_ok()
    }
}

/// Lists of one name are equal, and of two robots that show lists with each other both show the same.
#[derive(Clone, Debug, Default)]
pub struct Agreement {
    lists: BTreeMap<ListId, Vec<RobotId>>,
    shown: BTreeMap<RobotId, ListId>,
}

impl Checker for Agreement {
    fn properties(&self) -> &'static [&'static str] {
        &["agreement"]
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        let Some(robot) = record.robot else { return };
        match &record.event {
            Event::Fault(_) => {
                self.shown.remove(&robot);
            }
            // A robot that has promised another list shows none.
            Event::Primitive {
                event:
                    PrimitiveEvent::Registration(
                        RegistrationEvent::Lose
                        | RegistrationEvent::Propose { .. }
                        | RegistrationEvent::Accept { .. },
                    ),
                ..
            } => {
                self.shown.remove(&robot);
            }
            Event::Primitive {
                event: PrimitiveEvent::Registration(RegistrationEvent::Agree { list, members }),
                ..
            } => {
                let name = *list;
                let known = self.lists.entry(name).or_insert_with(|| members.to_vec());
                let is_known = known == members;
                self.shown.insert(robot, name);
                let differs = |other: &&RobotId| {
                    let shown = self.shown.get(other);
                    let of_both = |shown: &ListId| self.lists[shown].contains(&robot);
                    shown.is_some_and(|shown| *shown != name && of_both(shown))
                };
                if let Some(other) = members.iter().find(differs).filter(|_| is_known) {
                    violations.push(violation(record.at, robot, *other, "shows another list"));
                } else if !is_known {
                    violations.push(violation(record.at, robot, robot, "shows what is no list"));
                }
            }
            _ => {}
        }
    }
}

fn violation(at: Time, robot: RobotId, other: RobotId, text: &str) -> Violation {
    Violation {
        property: "agreement".into(),
        at,
        robots: vec![robot, other],
        text: text.into(),
    }
}
