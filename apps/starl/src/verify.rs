//! `starl verify`: judges the properties of a run by its trace alone, whichever host wrote it.
//!
//! Each record is shown to the checkers of every run, in the steps in which a simulator would show them. Properties
//! that cannot be judged are reported with the reason. Where the records of a robot end while it continues, properties of
//! the whole fleet are judged up to there, and contacts and paths of the other robots to the end. A run of the simulator is also held to the laws of its world.

mod account;
mod laws;

use crate::args::VerifyArguments;
use crate::failure::Failure;
use crate::replay::{self, open, unreadable};
use crate::{console, json};
use account::Account;
use starl_catalog::Application;
use starl_catalog::programs::Registry;
use starl_core::event::{Event, Fault, Name};
use starl_core::motion::{Body, Workspace};
use starl_core::{Intervention, Record, RobotId, Time};
use starl_properties::{Checker, Setting, Violation, Watch, checkers};
use starl_trace::{Header, TraceError};
use std::path::Path;

/// The read part of a trace, and the verdicts of the checkers.
struct Judged {
    header: Header,
    setting: Setting,
    watch: Watch,
    /// The names of robots that joined.
    joined: Vec<String>,
    /// Violations of properties that were watched on the running programs, as the host recorded them.
    recorded: Vec<Violation>,
    records: u64,
    /// Up to when there are records.
    end: Time,
    /// Why the trace ends before its run did; none where it does not.
    cut: Option<String>,
}

/// Judges a trace; whether nothing is violated.
pub fn verify(arguments: &VerifyArguments, registry: &Registry) -> Result<bool, Failure> {
    let path = arguments.trace.as_path();
    let account = Account::of(path, &judge(path, registry)?);
    match arguments.json {
        true => json::print(&account)?,
        false => console::print(&account.text())?,
    }
    Ok(account.violated == 0)
}

fn judge(path: &Path, registry: &Registry) -> Result<Judged, Failure> {
    let mut reader = open(path)?;
    let header = reader.header().clone();
    let recorded = replay::inputs(path, &header, registry).ok();
    let setting = setting(path, &header, recorded.as_ref())?;
    if let Some(robot) = setting.only {
        let name = header
            .robots
            .get(robot.index())
            .map_or("one robot", |robot| &robot.name);
        return Err(Failure::file(
            path,
            format!(
                "holds the records of {name} alone; `starl fleet merge` joins the traces of a fleet"
            ),
        ));
    }
    let simulated = recorded.filter(|_| setting.simulated);
    let laws = simulated.map_or_else(Vec::new, |run| laws::of(run.scenario()));
    let mut steps = Steps::new(&setting, laws);
    let mut recorded = Vec::new();
    let mut joined = Vec::new();
    let (mut records, mut end, mut cut) = (0, Time::ZERO, None);
    for record in &mut reader {
        let record = match record {
            Ok(record) => record,
            Err(error @ (TraceError::Truncated(_) | TraceError::NoEnd(_))) => {
                cut = Some(error.to_string());
                break;
            }
            Err(error) => return Err(unreadable(path, &error)),
        };
        records += 1;
        end = end.max(record.at);
        if let Event::Intervention(what) = &record.event
            && let Intervention::Join { name, .. } = &**what
        {
            joined.push(name.clone());
        }
        if let Event::Violated { property, text } = &record.event {
            if setting.monitored.contains(property) {
                recorded.push(violation(&record, property, text));
            }
        } else {
            steps.take(record);
        }
    }
    match reader.summary() {
        Some(summary) => end = summary.outcome.end,
        None if cut.is_none() => cut = Some(TraceError::NoEnd(reader.progress()).to_string()),
        None => {}
    }
    Ok(Judged {
        watch: steps.finish(end),
        header,
        setting,
        joined,
        recorded,
        records,
        end,
        cut,
    })
}

fn violation(record: &Record, property: &Name, text: &str) -> Violation {
    Violation {
        property: property.clone(),
        at: record.at,
        robots: record.robot.into_iter().collect(),
        text: text.to_string(),
    }
}

/// The setting: that of the host, or that of the recorded inputs, or the robots and obstacles with the usual
/// bounds.
fn setting(
    path: &Path,
    header: &Header,
    recorded: Option<&Application>,
) -> Result<Setting, Failure> {
    if !header.setting.is_empty() {
        let setting: Setting = serde_json::from_str(&header.setting).map_err(|error| {
            Failure::file(path, format!("the attachment starl/setting.json: {error}"))
        })?;
        return match setting.step.is_zero() {
            true => Err(Failure::file(
                path,
                "the attachment starl/setting.json: `step` must be greater than 0",
            )),
            false => Ok(setting),
        };
    }
    let run = recorded.and_then(|application| application.run().ok());
    Ok(run.map_or_else(|| of_world(header), |run| run.setting()))
}

fn of_world(header: &Header) -> Setting {
    let bodies = header.robots.iter().map(|robot| Body {
        radius: robot.radius,
        height: robot.height,
        workspace: match robot.flies {
            true => Workspace::Air { lowest: 0.0 },
            false => Workspace::Ground,
        },
    });
    let obstacles = header.obstacles.iter();
    Setting {
        bodies: bodies.collect(),
        obstacles: obstacles
            .map(|obstacle| (obstacle.clone(), Time::NEVER))
            .collect(),
        ..Setting::default()
    }
}

/// Shows records to checkers as a simulator does: those of a step together, then that the step is over.
struct Steps {
    watch: Watch,
    step: u64,
    /// The number of the step under way, and its records.
    number: u64,
    records: Vec<Record>,
    /// The moments from which records of a robot are missing, the last one first.
    unrecorded: Vec<(RobotId, Time)>,
}

impl Steps {
    fn new(setting: &Setting, laws: Vec<Box<dyn Checker>>) -> Steps {
        let mut judges = checkers(setting);
        judges.extend(laws);
        Steps {
            watch: Watch::new(judges),
            step: setting.step.0,
            number: 0,
            records: Vec::new(),
            unrecorded: setting.unrecorded.iter().copied().rev().collect(),
        }
    }

    fn take(&mut self, record: Record) {
        self.lose_until(record.at);
        let number = record.at.0 / self.step;
        // Datagrams dropped in a sender's queue are recorded ahead of their time.
        if number > self.number && !matches!(record.event, Event::Dropped { .. }) {
            self.close(Time(number.saturating_mul(self.step)));
            self.number = number;
        }
        self.records.push(record);
    }

    /// Ends the records of the robots that are not recorded beyond this time.
    fn lose_until(&mut self, now: Time) {
        while let Some((robot, at)) = self.unrecorded.pop_if(|(_, at)| *at <= now) {
            self.lose(robot, at);
        }
    }

    /// The records of a robot end. Its body may be anywhere, and nothing is known of its commands.
    fn lose(&mut self, robot: RobotId, at: Time) {
        self.close(at);
        self.number = at.0 / self.step;
        self.watch.lack_robots();
        let body = (
            None,
            Event::Intervention(Intervention::Leave(vec![robot]).into()),
        );
        let commands = (Some(robot), Event::Fault(Fault::Crash));
        let records = [body, commands].map(|(robot, event)| Record { at, robot, event });
        self.records.extend(records);
    }

    fn close(&mut self, now: Time) {
        self.watch.observe(&self.records, now);
        self.records.clear();
    }

    fn finish(mut self, end: Time) -> Watch {
        self.lose_until(end);
        self.close(end);
        self.watch
    }
}
