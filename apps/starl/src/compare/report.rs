//! The report of a comparison, for people and for programs.

use crate::args::ChangeArguments;
use crate::console::{command, counted, grouped, rounded};
use crate::run::quoted;
use crate::sweep::Shown;
use serde::Serialize;
use starl_sweep::{Comparison, Difference, Interval, Pair, Seeds};
use std::fmt::Write;

/// More changed seeds are only counted.
const MOST_LISTED: usize = 10;

/// The report of a comparison. As JSON its fields are described in `docs/reference/command.md`.
#[derive(Debug, Serialize)]
pub struct Report {
    pub a: Side,
    pub b: Side,
    pub first_seed: u64,
    pub seeds: u64,
    pub profile: Option<String>,
    pub wall_seconds: f64,
    pub threads: usize,
    pub interrupted: bool,
    pub worse: usize,
    #[serde(flatten)]
    pub comparison: Comparison,
}

/// A version.
#[derive(Clone, Debug, Serialize)]
pub struct Side {
    /// The target and the fields that are set, as arguments of `starl run`.
    pub arguments: String,
}

/// The part of a report that the rows do not tell.
pub struct Circumstances {
    pub sides: [Side; 2],
    pub seeds: Seeds,
    pub profile: Option<String>,
    pub wall_seconds: f64,
    pub threads: usize,
}

impl Side {
    /// The arguments of `starl run` for a version.
    pub fn new(target: &str, set: &[String], changes: &ChangeArguments) -> Side {
        let mut words = vec![quoted(target)];
        let faults = changes
            .faults
            .as_ref()
            .map(|path| path.display().to_string());
        let options = [
            ("--scenario", changes.scenario.clone()),
            ("--robots", changes.robots.clone()),
            ("--duration", changes.duration.clone()),
            ("--faults", faults),
        ];
        let sets = changes.set.iter().chain(set);
        let sets = sets.map(|set| ("--set", Some(set.clone())));
        for (option, value) in options.into_iter().chain(sets) {
            words.extend(value.map(|value| format!("{option} {}", quoted(&value))));
        }
        Side {
            arguments: words.join(" "),
        }
    }
}

impl Report {
    /// The report of a comparison.
    pub fn of(comparison: Comparison, around: Circumstances) -> Report {
        let [a, b] = around.sides;
        Report {
            a,
            b,
            first_seed: around.seeds.first(),
            seeds: around.seeds.count(),
            profile: around.profile,
            wall_seconds: around.wall_seconds,
            threads: around.threads,
            interrupted: comparison.pairs < around.seeds.count(),
            worse: comparison.worse(),
            comparison,
        }
    }

    /// Whether all seeds were run and none became worse.
    pub fn is_success(&self) -> bool {
        !self.interrupted && self.worse == 0
    }

    /// The text for people; only seeds that became worse if `quiet`.
    pub fn text(&self, metrics: Option<&[Shown]>, quiet: bool) -> String {
        let mut text = String::new();
        // Writing to a string does not fail.
        if !quiet {
            let _ = self.write_table(&mut text, metrics);
        }
        let _ = self.write_changed(&mut text, quiet);
        text
    }

    fn write_table(&self, text: &mut String, metrics: Option<&[Shown]>) -> std::fmt::Result {
        writeln!(text, "A  {}\nB  {}", self.a.arguments, self.b.arguments)?;
        let Comparison {
            pairs,
            identical,
            goal,
            metrics: differences,
            ..
        } = &self.comparison;
        let interrupted = if self.interrupted {
            "interrupted after "
        } else {
            ""
        };
        let faults = self.profile.as_ref();
        let faults = faults.map_or(String::new(), |name| format!(" with profile {name}"));
        writeln!(
            text,
            "{interrupted}{}{faults} in {} s on {}; {} identical\n",
            counted(*pairs as usize, "seed"),
            rounded(self.wall_seconds),
            counted(self.threads, "thread"),
            match *identical {
                1 => "1 run is".to_string(),
                many => format!("{} runs are", grouped(many)),
            }
        )?;
        let mut rows = vec![["", "A", "B", "B \u{2212} A", "95 % interval"].map(str::to_string)];
        let is_shown = |name: &str| match metrics {
            Some(metrics) => metrics.iter().any(|metric| metric.name() == name),
            None => true,
        };
        if is_shown(Shown::Goal.name()) {
            let percent =
                |count: u64| format!("{:.0} %", 100.0 * count as f64 / (*pairs).max(1) as f64);
            let difference = goal.difference.map(|interval| scaled(interval, 100.0));
            let [difference, ends] = told(difference, " %");
            let name = "goal reached".to_string();
            rows.push([name, percent(goal.a), percent(goal.b), difference, ends]);
        }
        let is_something = |difference: &&Difference| {
            metrics.is_some() || !difference.difference.is_none_or(is_zero)
        };
        let shown = differences
            .iter()
            .filter(|difference| is_shown(difference.metric));
        for difference in shown.filter(is_something) {
            let number = |mean: Option<f64>| mean.map_or("-".to_string(), rounded);
            let [change, ends] = told(difference.difference, "");
            let (a, b) = (number(difference.a), number(difference.b));
            rows.push([difference.metric.to_string(), a, b, change, ends]);
        }
        for [name, a, b, change, ends] in rows {
            writeln!(text, "{name:22} {a:>9} {b:>9} {change:>10}  {ends}")?;
        }
        Ok(())
    }

    fn write_changed(&self, text: &mut String, quiet: bool) -> std::fmt::Result {
        let all = &self.comparison.changed;
        if !quiet {
            writeln!(
                text,
                "\n{} changed the outcome, {} of them for the worse",
                counted(all.len(), "seed"),
                grouped(self.worse as u64)
            )?;
        }
        // Those that became worse come first.
        let worse = all.iter().filter(|pair| pair.is_worse);
        let others = all.iter().filter(|pair| !pair.is_worse && !quiet);
        let listed: Vec<&Pair> = worse.chain(others).collect();
        for pair in listed.iter().take(MOST_LISTED) {
            let outcome = |outcome: &str, violated: &[String]| match violated {
                [] => outcome.replace('_', " "),
                violated => format!("{} ({})", outcome.replace('_', " "), violated.join(", ")),
            };
            let (a, b) = (
                outcome(&pair.a, &pair.violated_by_a),
                outcome(&pair.b, &pair.violated_by_b),
            );
            let mark = if pair.is_worse { "  <" } else { "" };
            writeln!(text, "  seed {}: {a} \u{2192} {b}{mark}", pair.seed)?;
        }
        if listed.len() > MOST_LISTED {
            let more = grouped((listed.len() - MOST_LISTED) as u64);
            writeln!(text, "  {more} more; --json lists all")?;
        }
        match listed.first() {
            // A run has no profile, so this would be another one.
            Some(first) if self.profile.is_none() => {
                let Side { arguments } = &self.b;
                let command = command();
                writeln!(
                    text,
                    "  to see one: {command} run {arguments} --seed {}",
                    first.seed
                )
            }
            _ => Ok(()),
        }
    }
}

/// Whether no run differs.
fn is_zero(interval: Interval) -> bool {
    let ends = [interval.low, interval.high];
    interval.estimate == 0.0 && ends.into_iter().flatten().all(|end| end == 0.0)
}

fn scaled(interval: Interval, by: f64) -> Interval {
    Interval {
        estimate: interval.estimate * by,
        low: interval.low.map(|low| low * by),
        high: interval.high.map(|high| high * by),
    }
}

/// A difference and the ends of its interval, with a star where that excludes zero.
fn told(difference: Option<Interval>, unit: &str) -> [String; 2] {
    let Some(interval) = difference else {
        return ["-".to_string(), String::new()];
    };
    let ends = match (interval.low, interval.high) {
        (Some(low), Some(high)) => {
            let star = if interval.excludes_zero() { " *" } else { "" };
            format!("{} to {}{star}", signed(low), signed(high))
        }
        _ => String::new(),
    };
    [format!("{}{unit}", signed(interval.estimate)), ends]
}

/// A number with its sign.
fn signed(number: f64) -> String {
    match rounded(number.abs()) {
        text if number < 0.0 => format!("\u{2212}{text}"),
        text if number > 0.0 => format!("+{text}"),
        text => text,
    }
}
