//! `--log`: shows the robots' log while they run, on the error stream.

use crate::args::{LogArguments, Shown};
use crate::console;
use crate::failure::Failure;
use crate::progress::Progress;
use starl_core::event::{Event, Level};
use starl_core::{Intervention, Record, RobotId};
use starl_sim::Scenario;
use starl_sim::read::suggest;
use starl_sim::scenario::Fleet;
use std::fmt::Write;

impl Shown {
    fn least(self) -> Level {
        match self {
            Shown::Debug => Level::Debug,
            Shown::Info => Level::Info,
            Shown::Warning => Level::Warning,
            Shown::Error => Level::Error,
        }
    }
}

/// Shows lines of the log during the run.
pub struct Log {
    least: Level,
    /// The names of the robots whose lines are shown; all if none are named.
    only: Option<Vec<String>>,
    width: usize,
}

impl Log {
    /// The log that the arguments ask for, if they do.
    ///
    /// # Errors
    /// If they name a robot that the fleet does not have.
    pub fn of(arguments: &LogArguments, scenario: &Scenario) -> Result<Option<Log>, Failure> {
        let Some(level) = arguments.log else {
            return Ok(None);
        };
        let fleet = &scenario.fleet;
        let started = (0..fleet.len() as u32).map(|robot| fleet.name(RobotId(robot)));
        let joining = scenario
            .events
            .iter()
            .filter_map(|event| match &event.what {
                Intervention::Join { name, .. } => Some(name.clone()),
                _ => None,
            });
        let names: Vec<String> = started.chain(joining).collect();
        for name in &arguments.log_robots {
            if !names.contains(name) {
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                let help = suggest::help(name, &names, "the robots are").unwrap_or_default();
                let text = format!("--log-robots: there is no robot {name}; {help}");
                return Err(Failure(text));
            }
        }
        let named = &arguments.log_robots;
        let only = (!named.is_empty()).then(|| named.clone());
        let shown = only.as_ref().unwrap_or(&names).iter().take(100);
        let width = shown.map(|name| name.chars().count()).max();
        Ok(Some(Log {
            least: level.least(),
            only,
            width: width.unwrap_or(0).min(24),
        }))
    }

    /// Shows the record if it is a line that was asked for.
    pub fn observe(&self, record: &Record, fleet: &Fleet, progress: &Progress) {
        let (level, text, robot) = match (&record.event, record.robot) {
            (Event::Log { level, text }, Some(robot)) => (*level, text, robot),
            (Event::Failed(text), Some(robot)) => (Level::Error, text, robot),
            _ => return,
        };
        let only = self.only.as_ref();
        let is_wanted = only.is_none_or(|only| only.contains(&fleet.name(robot)));
        if level < self.least || !is_wanted {
            return;
        }
        let mut line = String::new();
        let width = self.width;
        let _ = write!(
            line,
            "{:>9.3} s  {:width$}  ",
            record.at.seconds(),
            fleet.name(robot)
        );
        line += match level {
            Level::Debug => "debug: ",
            Level::Info => "",
            Level::Warning => "warning: ",
            Level::Error => "error: ",
        };
        line += text;
        line.push('\n');
        progress.above(|| console::complain(&line));
    }
}
