//! The report of a sweep, for people and for programs.

use super::metrics::Shown;
use crate::cluster::Workers;
use crate::console::{command, counted, grouped, rounded};
use crate::run::quoted;
use serde::Serialize;
use starl_sweep::{Axis, Combination, Interval, Journal, Measured, Plan, Row, Summary, Task};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;

/// The report of a sweep. As JSON its fields are described in `docs/reference/command.md`.
#[derive(Debug, Serialize)]
pub struct Report {
    pub target: String,
    pub title: String,
    pub axes: Vec<Axis>,
    pub first_seed: u64,
    pub seeds: u64,
    pub profile: Option<String>,
    pub runs: u64,
    pub runs_done: u64,
    pub runs_done_before: u64,
    pub wall_seconds: f64,
    pub processor_seconds: f64,
    pub threads: usize,
    /// For people.
    #[serde(skip)]
    workers: String,
    pub interrupted: bool,
    pub out: Option<PathBuf>,
    pub journal: Option<PathBuf>,
    pub plot: Option<PathBuf>,
    /// The first run that violated a property, and the first that failed.
    pub failures: Vec<Example>,
    #[serde(flatten)]
    pub summary: Summary,
}

/// A run that violated a property or failed.
#[derive(Debug, Serialize)]
pub struct Example {
    pub number: u64,
    pub seed: u64,
    /// The properties that it violated; none if it failed.
    pub violated: Vec<String>,
    /// The command that repeats it.
    pub replay: String,
}

/// The part of a report that the rows do not tell.
pub struct Circumstances<'a> {
    pub title: String,
    /// The command that repeats a task.
    pub replay: &'a dyn Fn(&Task) -> String,
    pub done_before: u64,
    pub wall_seconds: f64,
    pub workers: &'a Workers,
    pub interrupted: bool,
    pub out: Option<PathBuf>,
    pub plot: Option<PathBuf>,
}

impl Report {
    /// The report of the rows that there are.
    pub fn of(plan: &Plan, rows: &BTreeMap<u64, Measured>, around: Circumstances<'_>) -> Report {
        let is_whole = rows.len() as u64 == plan.len();
        let processors = rows.values().map(|measured| measured.cpu_seconds);
        Report {
            target: plan.target().to_string(),
            title: around.title,
            axes: plan.axes().to_vec(),
            first_seed: plan.seeds().first(),
            seeds: plan.seeds().count(),
            profile: plan.profile().map(str::to_string),
            runs: plan.len(),
            runs_done: rows.len() as u64,
            runs_done_before: around.done_before,
            wall_seconds: around.wall_seconds,
            processor_seconds: processors.sum(),
            threads: around.workers.count(),
            workers: around.workers.words(),
            interrupted: around.interrupted,
            journal: around.out.as_deref().map(Journal::path_of),
            out: around.out.filter(|_| is_whole),
            plot: around.plot.filter(|_| is_whole),
            failures: examples(plan, rows, around.replay),
            summary: Summary::of(plan, rows),
        }
    }

    /// The text for people.
    pub fn text(&self, metrics: &[Shown]) -> String {
        let mut text = String::new();
        // Writing to a string does not fail.
        let _ = self.write(&mut text, metrics);
        text
    }

    fn write(&self, text: &mut String, metrics: &[Shown]) -> std::fmt::Result {
        let combinations = self.summary.combinations.len();
        let faults = self.profile.as_ref();
        let faults = faults.map_or(String::new(), |name| format!(", profile {name}"));
        writeln!(
            text,
            "{}: {}, {} each{faults}\n",
            self.title,
            counted(combinations, "combination"),
            counted(self.seeds as usize, "seed")
        )?;
        self.write_table(text, metrics)?;
        writeln!(
            text,
            "\nmean \u{b1} half the width of the 95 % interval; of the goal, the interval itself"
        )?;
        let outcomes = self.summary.combinations.iter();
        let (violated, failed) = outcomes.fold((0, 0), |(violated, failed), combination| {
            (violated + combination.violated, failed + combination.failed)
        });
        for (count, what) in [(violated, "violated a property"), (failed, "failed")] {
            if count > 0 {
                writeln!(text, "{} {what}", counted(count as usize, "run"))?;
            }
        }
        for Example {
            violated, replay, ..
        } in &self.failures
        {
            let what = match violated.is_empty() {
                true => "the first that failed".to_string(),
                false => format!("the first that violated {}", violated.join(" and ")),
            };
            writeln!(text, "  {what}: {replay}")?;
        }
        let runs = counted((self.runs_done - self.runs_done_before) as usize, "run");
        let per_second =
            (self.runs_done - self.runs_done_before) as f64 / self.wall_seconds.max(1e-9);
        let before = match self.runs_done_before {
            0 => String::new(),
            before => format!("; {} were done before", grouped(before)),
        };
        writeln!(
            text,
            "{runs} in {} s on {}, {} runs per second{before}",
            rounded(self.wall_seconds),
            self.workers,
            rounded(per_second)
        )?;
        for (label, path) in [("table", &self.out), ("plot", &self.plot)] {
            if let Some(path) = path {
                writeln!(text, "{label:12}{}", path.display())?;
            }
        }
        match self.interrupted {
            true => self.write_interrupted(text),
            false => Ok(()),
        }
    }

    fn write_interrupted(&self, text: &mut String) -> std::fmt::Result {
        writeln!(
            text,
            "interrupted after {} of {} runs",
            grouped(self.runs_done),
            grouped(self.runs)
        )?;
        match &self.journal {
            Some(journal) => {
                let arguments = std::env::args().skip(1).map(|word| quoted(&word));
                let again: Vec<String> = [command()].into_iter().chain(arguments).collect();
                writeln!(text, "saved       {}", journal.display())?;
                writeln!(text, "  to continue: {}", again.join(" "))
            }
            None => writeln!(
                text,
                "nothing was saved; with --out FILE a sweep continues where it stopped"
            ),
        }
    }

    fn write_table(&self, text: &mut String, metrics: &[Shown]) -> std::fmt::Result {
        let mut header: Vec<String> = self.axes.iter().map(|axis| axis.field.clone()).collect();
        header.push("runs".to_string());
        header.extend(metrics.iter().map(|metric| metric.name().to_string()));
        let mut table = vec![header];
        for combination in &self.summary.combinations {
            let mut row: Vec<String> = self
                .axes
                .iter()
                .map(|axis| combination.values[&axis.field].clone())
                .collect();
            row.push(grouped(combination.runs));
            row.extend(metrics.iter().map(|metric| cell(combination, *metric)));
            table.push(row);
        }
        let width = |column: usize| {
            let cells = table.iter().map(|row| row[column].chars().count());
            cells.max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..table[0].len()).map(width).collect();
        for row in &table {
            let cells = row.iter().zip(&widths);
            let cells: Vec<String> = cells
                .map(|(cell, width)| format!("{cell:>width$}"))
                .collect();
            writeln!(text, "{}", cells.join("  "))?;
        }
        Ok(())
    }
}

/// The number of a combination, with its interval; a dash where there is none.
fn cell(combination: &Combination, metric: Shown) -> String {
    let Some(interval) = interval(combination, metric) else {
        return "-".to_string();
    };
    let Interval {
        estimate,
        low,
        high,
    } = interval;
    match (metric, low, high) {
        (Shown::Goal, Some(low), Some(high)) => {
            format!("{estimate:.0} % ({low:.0} to {high:.0})")
        }
        (_, Some(low), Some(high)) => {
            format!(
                "{} \u{b1} {}",
                rounded(estimate),
                rounded((high - low) / 2.0)
            )
        }
        _ => rounded(estimate),
    }
}

/// The number of a combination as it is shown: shares in percent.
pub fn interval(combination: &Combination, metric: Shown) -> Option<Interval> {
    let percent = |share: f64| share * 100.0;
    match metric {
        Shown::Goal => combination.goal.map(|goal| Interval {
            estimate: percent(goal.estimate),
            low: goal.low.map(percent),
            high: goal.high.map(percent),
        }),
        Shown::Mean(metric) => combination.metrics.get(metric.name).copied().flatten(),
    }
}

/// The first run that violated a property, and the first that failed.
fn examples(
    plan: &Plan,
    rows: &BTreeMap<u64, Measured>,
    replay: &dyn Fn(&Task) -> String,
) -> Vec<Example> {
    let first = |is: &dyn Fn(&Row) -> bool| {
        let mut rows = rows.values().map(|measured| &measured.row);
        rows.find(|row| is(row))
    };
    let violated = first(&|row| !row.violated.is_empty());
    let failed = first(&|row| row.outcome == "failed" && row.violated.is_empty());
    let example = |row: &Row| Example {
        number: row.number,
        seed: row.seed,
        violated: row.violated.clone(),
        replay: replay(&plan.task(row.number)),
    };
    violated.into_iter().chain(failed).map(example).collect()
}
