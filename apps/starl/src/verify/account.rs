//! The report of a judged trace, for people and for programs.

use super::Judged;
use crate::console::{counted, grouped};
use crate::report::{Breach, Excused, excused, remark};
use serde::Serialize;
use starl_core::RobotId;
use starl_core::event::Name;
use starl_properties::{Verdict, Violation};
use std::fmt::{self, Write};
use std::path::Path;

/// The report of the verdicts. As JSON its fields are described in `docs/reference/command.md`.
#[derive(Debug, Serialize)]
pub struct Account {
    pub trace: String,
    pub records: u64,
    pub end_seconds: f64,
    pub is_whole: bool,
    pub ends: Option<String>,
    pub holding: usize,
    pub violated: usize,
    pub not_judged: usize,
    pub unrecorded: Vec<Unrecorded>,
    pub properties: Vec<Property>,
}

/// A robot whose records end while it continues.
#[derive(Debug, Serialize)]
pub struct Unrecorded {
    pub robot: String,
    pub at_seconds: f64,
}

/// A property, and whether it holds.
#[derive(Debug, Serialize)]
pub struct Property {
    pub property: Name,
    pub verdict: &'static str,
    pub reason: Option<Reason>,
    pub violations: usize,
    pub first: Option<Breach>,
    pub excused: Vec<Excused>,
    pub judged_until_seconds: f64,
}

/// Why a property is not judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    Unused,
    LiveProgram,
    CutShort,
    MissingRecords,
}

impl Reason {
    fn text(self) -> &'static str {
        match self {
            Reason::Unused => "the trace does not use its primitive",
            Reason::LiveProgram => "it needs the running program",
            Reason::CutShort => "the trace ends before its bound is over",
            Reason::MissingRecords => "the trace has no records of what it is judged by",
        }
    }
}

impl Account {
    pub(super) fn of(path: &Path, judged: &Judged) -> Account {
        let name = |robot: RobotId| {
            let started = judged.header.robots.iter().map(|entry| &entry.name);
            let mut names = started.chain(&judged.joined);
            let name = names.nth(robot.index());
            name.map_or_else(|| robot.to_string(), String::clone)
        };
        let is_cut = judged.cut.is_some();
        let lost = judged.setting.unrecorded.iter();
        let unrecorded: Vec<Unrecorded> = lost
            .map(|&(robot, at)| Unrecorded {
                robot: name(robot),
                at_seconds: at.seconds(),
            })
            .collect();
        let end = judged.end.seconds();
        let lost = unrecorded.first().map_or(end, |lost| lost.at_seconds);
        let verdicts = judged.watch.verdicts().into_iter();
        let checked = verdicts.map(|verdict| {
            let until = if verdict.to_the_end { end } else { lost };
            // The simulator records everything that happens.
            let has_evidence = verdict.has_evidence || judged.setting.simulated;
            let verdict = Verdict {
                has_evidence,
                ..verdict
            };
            Property::of(verdict, is_cut, until, name)
        });
        let monitored = judged.setting.monitored.iter();
        let monitored = monitored.map(|property| {
            let against = judged.recorded.iter();
            let against = against.filter(|violation| violation.property == *property);
            Property::recorded(property, against.collect(), end, name)
        });
        let properties: Vec<Property> = checked.chain(monitored).collect();
        let count = |verdict: &str| {
            let entries = properties.iter();
            entries.filter(|entry| entry.verdict == verdict).count()
        };
        Account {
            trace: path.display().to_string(),
            records: judged.records,
            end_seconds: end,
            is_whole: !is_cut,
            ends: judged.cut.clone(),
            holding: count(HOLDS),
            violated: count(VIOLATED),
            not_judged: count(NOT_JUDGED),
            unrecorded,
            properties,
        }
    }

    /// The text for people.
    pub fn text(&self) -> String {
        let mut text = String::new();
        // Writing to a string does not fail.
        let _ = self.write(&mut text);
        text
    }

    fn write(&self, text: &mut String) -> fmt::Result {
        let end = format!("{:.3} s", self.end_seconds);
        writeln!(
            text,
            "{}: {}, up to {end}",
            self.trace,
            counted(self.records as usize, "record")
        )?;
        if let Some(ends) = &self.ends {
            writeln!(text, "{ends}")?;
        }
        for Unrecorded { robot, at_seconds } in &self.unrecorded {
            writeln!(
                text,
                "{robot}: its records end at {at_seconds:.3} s, but it continued"
            )?;
        }
        let used = || {
            let entries = self.properties.iter();
            entries.filter(|entry| entry.reason != Some(Reason::Unused))
        };
        let names = used().map(|entry| entry.property.len());
        let width = names.max().unwrap_or(0).max(8);
        writeln!(text, "\n{:width$}  verdict", "property")?;
        for entry in used() {
            let Property {
                property, verdict, ..
            } = entry;
            match (entry.reason, entry.violations) {
                (Some(reason), _) => {
                    writeln!(text, "{property:width$}  not judged: {}", reason.text())?;
                }
                (None, 0) => {
                    let until = match entry.judged_until_seconds < self.end_seconds {
                        true => format!(" until {:.3} s", entry.judged_until_seconds),
                        false => String::new(),
                    };
                    let remark = remark(&entry.excused);
                    writeln!(text, "{property:width$}  {verdict}{until}{remark}")?;
                }
                (None, 1) => writeln!(text, "{property:width$}  VIOLATED")?,
                (None, many) => writeln!(
                    text,
                    "{property:width$}  VIOLATED {} times",
                    grouped(many as u64)
                )?,
            }
        }
        match self.properties.len() - used().count() {
            0 => {}
            1 => writeln!(text, "1 more property does not apply (unused primitive)")?,
            many => writeln!(
                text,
                "{many} more properties do not apply (unused primitives)"
            )?,
        }
        for Property {
            property, first, ..
        } in &self.properties
        {
            let Some(Breach {
                at_seconds,
                robots,
                text: what,
            }) = first
            else {
                continue;
            };
            write!(text, "\nviolated: {property} at {at_seconds:.3} s")?;
            if !robots.is_empty() {
                write!(text, " by {}", robots.join(", "))?;
            }
            writeln!(text, "\n  {what}")?;
        }
        Ok(())
    }
}

const HOLDS: &str = "holds";
const VIOLATED: &str = "violated";
const NOT_JUDGED: &str = "not_judged";

impl Property {
    fn of(
        verdict: Verdict,
        is_cut: bool,
        until: f64,
        name: impl Fn(RobotId) -> String,
    ) -> Property {
        let is_violated = verdict.first.is_some();
        let reason = if is_violated {
            None
        } else if !verdict.used {
            Some(Reason::Unused)
        } else if !verdict.has_evidence {
            Some(Reason::MissingRecords)
        } else if (is_cut || !verdict.to_the_end) && verdict.owed {
            Some(Reason::CutShort)
        } else {
            None
        };
        Property {
            property: verdict.property,
            verdict: match (is_violated, reason) {
                (true, _) => VIOLATED,
                (_, Some(_)) => NOT_JUDGED,
                (_, None) => HOLDS,
            },
            reason,
            violations: verdict.violations,
            first: verdict.first.map(|first| Breach::of(&first, name)),
            excused: excused(&verdict.excused),
            judged_until_seconds: until,
        }
    }

    /// A property that was watched on the running programs: violated, if the host recorded that.
    fn recorded(
        property: &Name,
        against: Vec<&Violation>,
        until: f64,
        name: impl Fn(RobotId) -> String,
    ) -> Property {
        let is_violated = !against.is_empty();
        Property {
            property: property.clone(),
            verdict: if is_violated { VIOLATED } else { NOT_JUDGED },
            reason: (!is_violated).then_some(Reason::LiveProgram),
            violations: against.len(),
            first: against.first().map(|first| Breach::of(first, name)),
            excused: Vec::new(),
            judged_until_seconds: until,
        }
    }
}
