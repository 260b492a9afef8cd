//! The report of a search, for people and for programs.

use super::counterexample::Counterexample;
use super::search::{Case, Found, Search};
use crate::cluster::Workers;
use crate::console::{counted, grouped, rounded};
use serde::Serialize;
use starl_catalog::trial::{Extent, Subject};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The report of a test. As JSON its fields are described in `docs/reference/command.md`.
#[derive(Debug, Serialize)]
pub struct Report {
    pub targets: Vec<Target>,
    pub findings: Vec<Finding>,
    pub runs: u64,
    pub wall_seconds: f64,
    pub processor_seconds: f64,
    pub threads: usize,
    /// For people.
    #[serde(skip)]
    workers: String,
    pub runs_per_second: f64,
    pub runs_per_processor_second: f64,
    pub interrupted: bool,
}

/// A target and what came of its runs.
#[derive(Debug, Serialize)]
pub struct Target {
    pub target: String,
    pub title: String,
    pub robots: usize,
    pub profiles: Vec<Row>,
}

/// The results of the runs with one profile.
#[derive(Debug, Serialize)]
pub struct Row {
    pub profile: &'static str,
    pub runs: u64,
    pub reached: u64,
    pub timed_out: u64,
    pub violated: u64,
    pub failed: u64,
    pub wrong: u64,
    pub excused: Vec<Excused>,
}

/// The number of excused violations of a property, for one reason.
#[derive(Debug, Serialize)]
pub struct Excused {
    pub property: String,
    pub reason: &'static str,
    pub count: u64,
}

/// A way in which a target goes wrong.
#[derive(Debug, Serialize)]
pub struct Finding {
    pub target: String,
    pub property: String,
    pub times: u64,
    pub profile: &'static str,
    pub seed: u64,
    pub text: String,
    pub again: String,
    pub scenario: Option<String>,
    pub diagram: Option<String>,
    pub before: Extent,
    pub after: Extent,
    pub trials: u64,
    pub minimal: bool,
}

fn words(extent: &Extent) -> String {
    let robots = counted(extent.robots, "robot");
    let faults = counted(extent.faults, "fault");
    format!("{robots}, {faults}, {} s", rounded(extent.duration_seconds))
}

impl Finding {
    fn of(search: &Search, case: &Case, times: u64, example: &Counterexample) -> Finding {
        let path = |path: &Option<std::path::PathBuf>| {
            path.as_ref().map(|path| path.display().to_string())
        };
        let [before, after] = example.sizes.map(Extent::from);
        Finding {
            target: search.targets[case.subject].name.clone(),
            property: case.property().to_string(),
            times,
            profile: case.profile.name(),
            seed: case.seed,
            text: example.text.clone(),
            again: example.again.clone(),
            scenario: path(&example.scenario),
            diagram: path(&example.diagram),
            before,
            after,
            trials: example.trials,
            minimal: example.is_minimal,
        }
    }
}

impl Report {
    /// The report.
    pub fn of(
        search: &Search,
        found: &Found,
        counterexamples: Vec<(Case, u64, Counterexample)>,
        workers: &Workers,
        interrupted: bool,
    ) -> Report {
        let runs = found.runs();
        let per = |seconds: f64| runs as f64 / seconds.max(1e-9);
        let (wall, processors) = (found.wall.as_secs_f64(), found.cpu_seconds);
        let findings = counterexamples.iter();
        Report {
            targets: targets(search, found),
            findings: findings
                .map(|(case, times, example)| Finding::of(search, case, *times, example))
                .collect(),
            runs,
            wall_seconds: wall,
            processor_seconds: processors,
            threads: workers.count(),
            workers: workers.words(),
            runs_per_second: per(wall),
            runs_per_processor_second: per(processors),
            interrupted,
        }
    }

    /// Whether nothing went wrong, and all was run.
    pub fn is_success(&self) -> bool {
        let mut rows = self.targets.iter().flat_map(|target| &target.profiles);
        !self.interrupted && rows.all(|row| row.wrong == 0)
    }

    /// The text for people; only failures if `quiet`.
    pub fn text(&self, quiet: bool) -> String {
        let mut text = String::new();
        // Writing to a string does not fail.
        if !quiet {
            let _ = self.write_table(&mut text);
        }
        for finding in &self.findings {
            let _ = finding.write(&mut text);
        }
        text
    }

    fn write_table(&self, text: &mut String) -> std::fmt::Result {
        for target in &self.targets {
            let robots = counted(target.robots, "robot");
            writeln!(text, "{} ({}, {robots})", target.title, target.target)?;
            writeln!(
                text,
                "  {:12} {:>10} {:>10} {:>10} {:>10} {:>10}",
                "profile", "runs", "reached", "timed out", "violated", "failed"
            )?;
            for row in &target.profiles {
                let numbers = [
                    row.runs,
                    row.reached,
                    row.timed_out,
                    row.violated,
                    row.failed,
                ];
                let [runs, reached, timed_out, violated, failed] = numbers.map(grouped);
                let wrong = if row.wrong > 0 { "  <" } else { "" };
                writeln!(
                    text,
                    "  {:12} {runs:>10} {reached:>10} {timed_out:>10} {violated:>10} {failed:>10}{wrong}",
                    row.profile
                )?;
                row.write_excused(text)?;
            }
        }
        let interrupted = if self.interrupted {
            "interrupted after "
        } else {
            ""
        };
        writeln!(
            text,
            "{interrupted}{} in {} s on {}: {} runs per second, {} per second of a core",
            counted(self.runs as usize, "run"),
            rounded(self.wall_seconds),
            self.workers,
            rounded(self.runs_per_second),
            rounded(self.runs_per_processor_second)
        )
    }
}

impl Row {
    /// The excuses, by reason.
    fn write_excused(&self, text: &mut String) -> std::fmt::Result {
        let mut reasons: BTreeMap<&str, u64> = BTreeMap::new();
        for Excused { reason, count, .. } in &self.excused {
            *reasons.entry(reason).or_default() += count;
        }
        for (reason, count) in reasons {
            writeln!(text, "    {} excused: {reason}", grouped(count))?;
        }
        Ok(())
    }
}

impl Finding {
    fn write(&self, text: &mut String) -> std::fmt::Result {
        let what = match self.property.as_str() {
            "unreached" => "the goal was not reached".to_string(),
            "failed" => "a program failed".to_string(),
            property => format!("{property} was violated"),
        };
        writeln!(
            text,
            "\n{}: {what} in {}, first with {}, seed {}",
            self.target,
            counted(self.times as usize, "run"),
            self.profile,
            self.seed
        )?;
        writeln!(text, "  {}", self.text)?;
        match &self.scenario {
            Some(path) => {
                let end = if self.minimal {
                    ""
                } else {
                    ", and might be smaller still"
                };
                writeln!(
                    text,
                    "  shrunk from {} to {} in {} tries{end}",
                    words(&self.before),
                    words(&self.after),
                    grouped(self.trials)
                )?;
                writeln!(
                    text,
                    "  to see it: {} run {}",
                    crate::console::command(),
                    crate::run::quoted(path)
                )?;
            }
            None => {
                let why = match self.trials {
                    0 => "",
                    _ => "it did not fail again when run from its own scenario; ",
                };
                writeln!(text, "  {why}to find it again: {}", self.again)?;
            }
        }
        if let Some(diagram) = &self.diagram {
            writeln!(text, "  drawn:     {diagram}")?;
        }
        Ok(())
    }
}

fn targets(search: &Search, found: &Found) -> Vec<Target> {
    let subjects = search.targets.iter().zip(search.campaign.subjects());
    let target = |(index, (target, subject)): (usize, (&super::subject::Target, &Subject))| {
        let scenario = subject.application.scenario();
        let rows = search.campaign.settings().profiles.iter().map(|&profile| {
            let tally = found.tallies.get(&(index, profile));
            let tally = tally.cloned().unwrap_or_default();
            let excused = tally.excused.into_iter();
            Row {
                profile: profile.name(),
                runs: tally.runs,
                reached: tally.reached,
                timed_out: tally.timed_out,
                violated: tally.violated,
                failed: tally.failed,
                wrong: tally.wrong,
                excused: excused
                    .map(|((property, excuse), count)| Excused {
                        property: property.to_string(),
                        reason: excuse.text(),
                        count,
                    })
                    .collect(),
            }
        });
        Target {
            target: target.name.clone(),
            title: scenario.title.clone(),
            robots: scenario.fleet.len(),
            profiles: rows.collect(),
        }
    };
    subjects.enumerate().map(target).collect()
}
