//! Breakpoints: conditions at which a run stops for inspection.
//!
//! They belong to the session, not to the run: they do not change the run, and stay when the session returns to a
//! snapshot.

mod names;

use super::diagnostic::Diagnostic;
use super::inspect::language_program;
use super::open::Refused;
use crate::Application;
use crate::language::FleetCondition;
use names::Names;
use serde::{Deserialize, Serialize};
use starl_core::event::Event;
use starl_core::{Record, RobotId};
use starl_lang::machine::Fault;
use starl_sim::{Run, Simulation};
use std::collections::BTreeMap;

/// Where a run stops.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Breakpoint {
    /// An action fires.
    Action {
        /// Its name; of an action in a role `role.name`.
        name: String,
        /// On which robot; any if none is given.
        robot: Option<RobotId>,
    },
    /// A datagram is delivered.
    Message {
        /// The message that it carries; any datagram if none is given.
        name: Option<String>,
        /// To which robot; any if none is given.
        robot: Option<RobotId>,
    },
    /// A condition over robots becomes true.
    When {
        /// A Bool of the StarL language, as in a property.
        expression: String,
    },
}

/// Why a run has stopped.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stopped {
    /// Which breakpoint, by its place in the list.
    pub breakpoint: usize,
    /// When that happened, seconds.
    pub at: f64,
    /// On which robot; none if it is about the fleet.
    pub robot: Option<u32>,
    /// A description.
    pub text: String,
}

/// Breakpoints that are watched.
#[derive(Clone, Default)]
pub(super) struct Breakpoints {
    all: Vec<Breakpoint>,
    /// The conditions, each with the place of its breakpoint in the list.
    conditions: Vec<(usize, Watched)>,
}

/// A condition, and of which robots it was true when it was asked last, or could not be evaluated.
#[derive(Clone)]
struct Watched {
    condition: FleetCondition,
    met: BTreeMap<Option<RobotId>, Option<Fault>>,
}

impl Breakpoints {
    /// Breakpoints of a run as it is now: a condition that is true already has to become false before it is met.
    pub fn new(
        all: Vec<Breakpoint>,
        application: &Application,
        run: &Run,
    ) -> Result<Self, Refused> {
        let mut conditions = Vec::new();
        let names = Names::of(application);
        for (place, breakpoint) in all.iter().enumerate() {
            match breakpoint {
                Breakpoint::Action { name, robot } => {
                    names.check_action(name)?;
                    check_robot(*robot, run)?;
                }
                Breakpoint::Message { name, robot } => {
                    name.iter().try_for_each(|name| names.check_message(name))?;
                    check_robot(*robot, run)?;
                }
                Breakpoint::When { expression } => {
                    let found = compiled(place, expression, application)?;
                    conditions.extend(found.into_iter().map(|condition| {
                        let met = BTreeMap::new();
                        (place, Watched { condition, met })
                    }));
                }
            }
        }
        let mut breakpoints = Breakpoints { all, conditions };
        breakpoints.look_anew(run);
        Ok(breakpoints)
    }

    /// Whether there are none.
    pub fn are_none(&self) -> bool {
        self.all.is_empty()
    }

    /// Restarts the evaluation at another moment of the run.
    pub fn look_anew(&mut self, run: &Run) {
        for (_, watched) in &mut self.conditions {
            watched.met.clear();
            watched.look(run.simulation());
        }
    }

    /// The part of a step that stops the run: the first matching record, else a condition. Call it after each
    /// step.
    pub fn look(&mut self, run: &Run, records: &[Record]) -> Option<Stopped> {
        let simulation = run.simulation();
        let mut stopped = records
            .iter()
            .find_map(|record| self.stopped_by(simulation, record));
        for (place, watched) in &mut self.conditions {
            let Some((robot, failure)) = watched.look(simulation) else {
                continue;
            };
            let Some(Breakpoint::When { expression }) = self.all.get(*place) else {
                continue;
            };
            stopped.get_or_insert_with(|| Stopped {
                breakpoint: *place,
                at: simulation.now().seconds(),
                robot: robot.map(|robot| robot.0),
                text: match failure {
                    None => format!("{}{expression} has become true", of(simulation, robot)),
                    Some(reason) => format!(
                        "{}{expression} cannot be evaluated: {reason}",
                        of(simulation, robot)
                    ),
                },
            });
        }
        stopped
    }

    fn stopped_by(&self, simulation: &Simulation, record: &Record) -> Option<Stopped> {
        let robot = record.robot?;
        let mut all = self.all.iter().enumerate();
        let (breakpoint, text) = match &record.event {
            Event::Action(fired) => all.find_map(|(place, breakpoint)| match breakpoint {
                Breakpoint::Action { name, robot: on } => {
                    let is_met = **name == **fired && on.is_none_or(|on| on == robot);
                    is_met.then(|| (place, format!("action {fired}")))
                }
                _ => None,
            }),
            Event::Delivered { from, sequence } => {
                all.find_map(|(place, breakpoint)| match breakpoint {
                    Breakpoint::Message { name, robot: to } if to.is_none_or(|to| to == robot) => {
                        let carried = message(simulation, robot, *from, *sequence);
                        let is_met = name.is_none() || name.as_deref() == carried;
                        let what = carried.unwrap_or("datagram");
                        let sender = simulation.scenario().fleet.name(*from);
                        is_met.then(|| (place, format!("{what} from {sender}")))
                    }
                    _ => None,
                })
            }
            _ => None,
        }?;
        Some(Stopped {
            breakpoint,
            at: record.at.seconds(),
            robot: Some(robot.0),
            text: of(simulation, Some(robot)) + &text,
        })
    }
}

impl Watched {
    /// Asks again; gives a robot of which it has become true or cannot be evaluated any more, and then why.
    fn look(&mut self, simulation: &Simulation) -> Option<(Option<RobotId>, Option<Fault>)> {
        let asked = self.condition.ask(simulation).into_iter();
        let met: BTreeMap<_, _> = asked
            .filter_map(|(robot, truth)| match truth {
                Ok(true) => Some((robot, None)),
                Ok(false) => None,
                Err(reason) => Some((robot, Some(reason))),
            })
            .collect();
        let mut new = met
            .iter()
            .filter(|(robot, _)| !self.met.contains_key(*robot));
        let new = new.next().map(|(robot, failure)| (*robot, failure.clone()));
        self.met = met;
        new
    }
}

fn check_robot(robot: Option<RobotId>, run: &Run) -> Result<(), Refused> {
    match robot {
        Some(robot) if robot.index() >= run.simulation().robots().len() => {
            Err(format!("there is no robot {robot}").into())
        }
        _ => Ok(()),
    }
}

fn compiled(
    place: usize,
    expression: &str,
    application: &Application,
) -> Result<Vec<FleetCondition>, Refused> {
    application
        .programs
        .conditions(expression)
        .map_err(|found| {
            let diagnostics: Vec<_> = Diagnostic::of_condition(place, expression, &found).collect();
            let message = match diagnostics.first() {
                Some(first) => format!("{expression}: {}", first.message),
                None => "no robot runs a program in the StarL language, which a condition is about"
                    .to_string(),
            };
            Refused {
                message,
                diagnostics,
            }
        })
}

/// The message that a datagram carried which has just arrived, as the receiver's program knows it.
fn message(simulation: &Simulation, robot: RobotId, from: RobotId, sequence: u32) -> Option<&str> {
    let code = language_program(simulation, robot)?.code();
    code.message_in(simulation.arrived(from, sequence)?)
}

/// The robots concerned.
fn of(simulation: &Simulation, robot: Option<RobotId>) -> String {
    robot.map_or(String::new(), |robot| {
        format!("{}: ", simulation.scenario().fleet.name(robot))
    })
}
