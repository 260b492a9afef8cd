//! Follows the path to a violation step by step, and prints its events.

use super::record::Recording;
use super::{events, record};
use crate::console::{self, counted};
use crate::diagram;
use crate::failure::Failure;
use crate::output::Output;
use starl_catalog::Application;
use starl_catalog::programs::Registry;
use starl_core::{Event, Record, Time};
use starl_explore::{Counterexample, STUCK, Setup};
use starl_properties::Violation;
use std::fs::File;
use std::path::Path;
use std::process::ExitCode;

/// A path that was followed.
pub struct Shown {
    /// The account of it, line by line.
    pub lines: Vec<String>,
    /// Its events, a second to a step.
    records: Vec<Record>,
    /// Whether the property is violated again.
    pub again: bool,
}

impl Shown {
    /// Draws it into a file that was opened already.
    pub fn draw(&self, application: &Application, sheet: Sheet) -> Result<(), Failure> {
        let diagram = diagram::of_records(application, &self.records);
        let (output, file) = sheet;
        output.write(file, &diagram.svg())
    }
}

/// Where a drawing goes.
pub type Sheet = (Output, File);

/// Opens the file of the drawing, if one is requested.
pub fn sheet(path: Option<&Path>) -> Result<Option<Sheet>, Failure> {
    let Some(path) = path else { return Ok(None) };
    match path.extension().is_some_and(|suffix| suffix == "svg") {
        true => Output::create(path).map(Some),
        false => Err(Failure::file(
            path,
            "name a file that ends in .svg for --diagram",
        )),
    }
}

/// `starl explore --replay`: exit status 1 where the violation shows again, 0 where it does not.
pub fn replay(
    path: &Path,
    drawing: Option<&Path>,
    registry: &Registry,
) -> Result<ExitCode, Failure> {
    let (kept, application, setup) = record::read(path, registry)?;
    let sheet = sheet(drawing)?;
    let wanted = Violation {
        property: kept.property.into(),
        at: Time::ZERO,
        robots: Vec::new(),
        text: kept.text,
    };
    let found = Counterexample {
        steps: kept.steps,
        violation: wanted,
    };
    let shown = show(&kept.recording, setup, &found)?;
    if let Some(sheet) = sheet {
        shown.draw(&application, sheet)?;
    }
    let wanted = found.violation;
    let mut text = shown.lines.join("\n");
    text.push_str(&match shown.again {
        true => format!("\n\nviolated again: {}: {}\n", wanted.property, wanted.text),
        false => format!("\n\n{} is not violated any more\n", wanted.property),
    });
    console::print(&text)?;
    Ok(ExitCode::from(u8::from(shown.again)))
}

/// Goes the way.
pub fn show(recording: &Recording, setup: Setup, found: &Counterexample) -> Result<Shown, Failure> {
    let wanted = &found.violation;
    let (mut walk, steps, violations) = recording.begin(setup)?;
    let mut lines = vec!["start".to_string()];
    if recording.warm_up.is_some() {
        lines.push(format!("      {} of the warm-up", counted(steps, "step")));
    }
    let mut shown = Shown {
        lines,
        records: Vec::new(),
        again: violations
            .iter()
            .any(|violation| violation.property == wanted.property),
    };
    let take = |shown: &mut Shown, moment: starl_explore::Moment| {
        let lines = moment.records.iter().filter_map(events::line);
        shown
            .lines
            .extend(lines.map(|line| format!("      {line}")));
        let is_wanted = |violation: &Violation| violation.property == wanted.property;
        shown.again |= moment.violations.iter().any(is_wanted);
        shown.records.extend(moment.records);
    };
    for (number, step) in found.steps.iter().enumerate() {
        let number = number + 1;
        let moment = walk.step(step).map_err(|impossible| {
            Failure(format!(
                "step {number}, {step}, cannot be taken any more: {impossible}; the programs or \
                 primitives have changed since"
            ))
        })?;
        shown.lines.push(format!("{number:>4}. {step}"));
        take(&mut shown, moment);
    }
    shown.records.push(Record {
        at: shown.records.last().map_or(Time::ZERO, |record| record.at),
        robot: wanted.robots.first().copied(),
        event: Event::Violated {
            property: wanted.property.clone(),
            text: wanted.text.clone().into(),
        },
    });
    if wanted.property == STUCK {
        shown.again = walk.stuck().is_some();
    }
    Ok(shown)
}
