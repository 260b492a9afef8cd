//! `--log`: shows the robots' log while they run, on the error stream.

use crate::args::{LogArguments, Shown};
use crate::console;
use crate::failure::Failure;
use crate::progress::Progress;
use starl_core::event::{Event, Level};
use starl_core::{Record, RobotId};
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
    /// The robots whose lines are shown; all if none are named.
    only: Option<Vec<RobotId>>,
    width: usize,
}

impl Log {
    /// The log that the arguments ask for, if they do.
    ///
    /// # Errors
    /// If they name a robot that the fleet does not have.
    pub fn of(arguments: &LogArguments, fleet: &Fleet) -> Result<Option<Log>, Failure> {
        let Some(level) = arguments.log else {
            return Ok(None);
        };
        let robots = || (0..fleet.len() as u32).map(RobotId);
        let find = |name: &String| {
            let found = robots().find(|&robot| fleet.name(robot) == *name);
            found.ok_or_else(|| {
                let names: Vec<String> = robots().map(|robot| fleet.name(robot)).collect();
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                let help = suggest::help(name, &names, "the robots are").unwrap_or_default();
                Failure(format!("--log-robots: there is no robot {name}; {help}"))
            })
        };
        let only = match &arguments.log_robots[..] {
            [] => None,
            names => Some(names.iter().map(find).collect::<Result<Vec<_>, _>>()?),
        };
        let named = only
            .as_ref()
            .map_or_else(|| robots().take(100).collect(), Vec::clone);
        let width = named
            .iter()
            .map(|&robot| fleet.name(robot).chars().count())
            .max();
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
        let is_wanted = self.only.as_ref().is_none_or(|only| only.contains(&robot));
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
