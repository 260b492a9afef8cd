//! Goes the way to a violation step by step, and tells what happens on it.

use super::{events, record};
use crate::console;
use crate::failure::Failure;
use starl_explore::{STUCK, Setup, Step, Walk};
use starl_sim::properties::Violation;
use std::path::Path;
use std::process::ExitCode;

/// A way that was gone.
pub struct Shown {
    /// The account of it, line by line.
    pub lines: Vec<String>,
    /// Whether what was violated is violated again.
    pub again: bool,
}

/// `starl explore --replay`: exit status 1 where the violation shows again, 0 where it does not.
pub fn replay(path: &Path) -> Result<ExitCode, Failure> {
    let (kept, setup) = record::read(path)?;
    let wanted = Violation {
        property: kept.property.into(),
        at: starl_core::Time::ZERO,
        robots: Vec::new(),
        text: kept.text,
    };
    let shown = show(setup, &kept.steps, &wanted)?;
    let mut text = shown.lines.join("\n");
    text.push_str(&match shown.again {
        true => format!("\n\nviolated again: {}: {}\n", wanted.property, wanted.text),
        false => format!("\n\n{} is not violated any more\n", wanted.property),
    });
    console::print(&text)?;
    Ok(ExitCode::from(u8::from(shown.again)))
}

/// Goes the way.
pub fn show(setup: Setup, steps: &[Step], wanted: &Violation) -> Result<Shown, Failure> {
    let (mut walk, moment) = Walk::start(setup);
    let mut shown = Shown {
        lines: vec!["start".to_string()],
        again: false,
    };
    let take = |shown: &mut Shown, moment: starl_explore::Moment| {
        let lines = moment.records.iter().filter_map(events::line);
        shown
            .lines
            .extend(lines.map(|line| format!("      {line}")));
        let is_wanted = |violation: &Violation| violation.property == wanted.property;
        shown.again |= moment.violations.iter().any(is_wanted);
    };
    take(&mut shown, moment);
    for (number, step) in steps.iter().enumerate() {
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
    if wanted.property == STUCK {
        shown.again = walk.stuck().is_some();
    }
    Ok(shown)
}
