//! The report of an exploration, for people and as JSON. `docs/reference/command.md` describes the
//! keys.

use super::record::Recording;
use crate::console::{counted, grouped, rounded};
use serde::Serialize;
use starl_core::Duration;
use starl_explore::{Bounds, Clocks, End, Report};
use std::fmt::Write;

/// The report.
#[derive(Debug, Serialize)]
pub struct Account {
    target: String,
    outcome: &'static str,
    robots: usize,
    bounds: BoundsInWords,
    states: u32,
    transitions: u64,
    depth: u32,
    terminal_states: u64,
    robot_states: usize,
    checker_states: usize,
    memory_bytes: usize,
    compared_turns: u64,
    /// How often programs asked to move.
    ignored_motions: u64,
    /// Wall-clock seconds.
    pub seconds: f64,
    /// The time that it was given, where that was up before all was explored.
    within: Option<String>,
    /// Suggestions for other explorations.
    pub hints: Vec<String>,
    violation: Option<Violation>,
    #[serde(skip)]
    is_shortest_first: bool,
    /// The way to the violation, line by line.
    pub steps: Vec<String>,
    /// Where it is kept.
    pub saved: Option<String>,
}

#[derive(Debug, Serialize)]
struct BoundsInWords {
    losses: u8,
    duplicates: u8,
    any_copies: bool,
    crashes: u8,
    suspicions: u8,
    /// None where time bounds them.
    timers: Option<u8>,
    heartbeats: bool,
    storage: bool,
    tick_seconds: Option<f64>,
    time_seconds: Option<f64>,
    skew_ticks: Option<u16>,
    delay_ticks: Option<u8>,
    warm_up_ticks: Option<u16>,
    depth: Option<u32>,
    most_states: u32,
}

#[derive(Debug, Serialize)]
struct Violation {
    property: String,
    text: String,
    steps: usize,
}

impl Account {
    /// Of a search that has ended, or was stopped.
    pub fn new(
        target: &str,
        recording: &Recording,
        storage: bool,
        report: &Report,
        end: Option<&End>,
    ) -> Account {
        let violation = match end {
            Some(End::Violated(found)) => Some(Violation {
                property: found.violation.property.to_string(),
                text: found.violation.text.clone(),
                steps: found.steps.len(),
            }),
            _ => None,
        };
        Account {
            target: target.to_string(),
            outcome: match end {
                Some(End::Complete) => "complete",
                Some(End::Violated(_)) => "violated",
                Some(End::Depth) => "depth_bound",
                Some(End::Full) => "state_bound",
                Some(End::Contradiction(_)) => "contradiction",
                None => "interrupted",
            },
            robots: recording.robots,
            bounds: BoundsInWords::of(recording, storage),
            states: report.states,
            transitions: report.transitions,
            depth: report.depth,
            terminal_states: report.terminal,
            robot_states: report.robot_states,
            checker_states: report.checker_states,
            memory_bytes: report.bytes,
            compared_turns: report.compared,
            ignored_motions: report.motions,
            seconds: 0.0,
            within: None,
            hints: Vec::new(),
            violation,
            is_shortest_first: recording.bounds.is_shortest_first(),
            steps: Vec::new(),
            saved: None,
        }
    }

    /// The time was up before all was explored.
    pub fn run_late(&mut self, within: &str) {
        self.outcome = "time_bound";
        self.within = Some(within.to_string());
    }

    /// All of it, for a person.
    pub fn text(&self) -> String {
        let mut text = String::new();
        let mut line = |label: &str, content: String| {
            // Writing to a text cannot fail.
            let _ = writeln!(text, "{label:<13}{content}");
        };
        line(
            "explored",
            format!("{}, {}", self.target, counted(self.robots, "robot")),
        );
        line("bounds", self.bounds.text());
        line("states", grouped(self.states.into()));
        line("transitions", grouped(self.transitions));
        line("depth", counted(self.depth as usize, "step"));
        line(
            "ends",
            counted(self.terminal_states as usize, "state") + " without a next step",
        );
        let per_second = f64::from(self.states) / self.seconds.max(1e-6);
        line(
            "time",
            format!(
                "{} s, {} states a second, {} MiB",
                rounded(self.seconds),
                rounded(per_second),
                self.memory_bytes >> 20
            ),
        );
        if self.compared_turns > 0 {
            line(
                "merging",
                format!(
                    "{} compared turns of robots agree",
                    grouped(self.compared_turns)
                ),
            );
        }
        if self.ignored_motions > 0 {
            line(
                "motion",
                "robots stand still; their programs requested motion".into(),
            );
        }
        line("outcome", self.verdict());
        for hint in &self.hints {
            line("note", hint.clone());
        }
        text + &self.violation_text()
    }

    /// The violation and the way there, if there is one.
    pub fn violation_text(&self) -> String {
        let Some(violation) = &self.violation else {
            return String::new();
        };
        let mut text = format!("\n{}: {}\n\n", violation.property, violation.text);
        for line in &self.steps {
            text.push_str(line);
            text.push('\n');
        }
        if let Some(saved) = &self.saved {
            let _ = write!(
                text,
                "\nkept in {saved}; to replay it: {} explore --replay {saved}\n",
                crate::console::command()
            );
        }
        text
    }

    /// How far an incomplete search has come.
    fn covered(&self) -> String {
        let within = match self.is_shortest_first {
            true => format!(
                "within {} from the start",
                counted(self.depth.saturating_sub(1) as usize, "step")
            ),
            false => "in the states so far".into(),
        };
        format!(
            "nothing is violated {within}. Allow more, or bound more: fewer robots (--robots 2), \
             no timers (--timers 0), fewer faults, fewer turns (--set parameters.NAME=1)",
        )
    }

    fn verdict(&self) -> String {
        match (self.outcome, &self.violation) {
            ("complete", _) => "complete: no behaviour within the bounds violates anything".into(),
            (_, Some(violation)) => format!(
                "violated: {} after {}; {}",
                violation.property,
                counted(violation.steps, "step"),
                match self.is_shortest_first {
                    true => "there is no shorter path",
                    false => "none of them can be omitted",
                }
            ),
            ("depth_bound", _) => format!(
                "NOT complete: nothing is violated up to --depth {}, and there are states beyond",
                self.depth
            ),
            ("state_bound", _) => format!(
                "NOT complete: there are more states than --most-states {}; {}",
                self.bounds.most_states,
                self.covered()
            ),
            ("time_bound", _) => format!(
                "NOT complete: stopped after --within {}; {}",
                self.within.as_deref().unwrap_or_default(),
                self.covered()
            ),
            _ => "NOT complete: interrupted".into(),
        }
    }
}

impl BoundsInWords {
    fn of(recording: &Recording, storage: bool) -> BoundsInWords {
        let Recording {
            bounds,
            heartbeats,
            warm_up,
            ..
        } = *recording;
        let (tick, time, skew, delay) = match bounds.clocks {
            Clocks::Still => (None, None, None, None),
            Clocks::Ticking {
                tick,
                ticks,
                skew,
                delay,
            } => (
                Some(tick),
                Some(tick * u64::from(ticks - warm_up.unwrap_or_default().min(ticks))),
                Some(skew),
                delay,
            ),
        };
        BoundsInWords {
            losses: bounds.losses,
            duplicates: bounds.duplicates,
            any_copies: bounds.any_copies,
            crashes: bounds.crashes,
            suspicions: bounds.suspicions,
            timers: tick.is_none().then_some(bounds.timers),
            heartbeats,
            storage,
            tick_seconds: tick.map(Duration::seconds),
            time_seconds: time.map(Duration::seconds),
            skew_ticks: skew,
            delay_ticks: delay,
            warm_up_ticks: warm_up,
            depth: bounds.depth,
            most_states: bounds.most_states,
        }
    }

    fn text(&self) -> String {
        let mut parts: Vec<String> = [
            (self.losses, "loss", "losses"),
            (self.duplicates, "duplicate", "duplicates"),
            (self.crashes, "crash", "crashes"),
            (self.suspicions, "suspicion", "suspicions"),
        ]
        .into_iter()
        .filter(|part| part.0 > 0)
        .map(|(count, one, many)| match count {
            1 => format!("1 {one}"),
            count => format!("{count} {many}"),
        })
        .collect();
        if self.any_copies {
            parts.push("any losses and copies".into());
        }
        match (self.timers, self.tick_seconds, self.time_seconds) {
            (Some(timers), ..) => parts.push(match timers {
                Bounds::ANY_NUMBER => "any timers".into(),
                1 => "1 timer that fires".into(),
                timers => format!("{timers} timers that fire"),
            }),
            (_, Some(tick), Some(time)) => parts.push(format!(
                "{time} s in ticks of {tick} s, clocks at most {} ticks apart",
                self.skew_ticks.unwrap_or_default()
            )),
            _ => {}
        }
        let delay = self.delay_ticks;
        parts.extend(delay.map(|delay| format!("delays of {delay} ticks")));
        parts.extend(self.warm_up_ticks.map(|ticks| match ticks {
            0 => "after a warm-up".to_string(),
            ticks => format!("after a warm-up of {ticks} ticks"),
        }));
        if !self.heartbeats {
            parts.push("no heartbeats".into());
        }
        if self.storage {
            parts.push("robots with storage".into());
        }
        parts.extend(self.depth.map(|depth| format!("{depth} steps")));
        format!("at most {}", parts.join(", "))
    }
}
