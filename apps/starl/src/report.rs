//! The report of a run that has ended, for people and for programs.

use serde::{Serialize, Serializer};
use starl_catalog::session::{Messages, Progress};
use starl_core::RobotId;
use starl_core::event::Name;
use starl_properties::{Excuse, Violation};
use starl_sim::scenario::Goal;
use starl_sim::{Outcome, Run, Scenario};

/// The report of a run. As JSON its fields are described in `docs/reference/command.md`.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    pub target: String,
    pub title: String,
    pub seed: u64,
    /// The condition of success: `all_finished`, or `duration` where the run is only to last.
    pub goal: String,
    pub outcome: Ending,
    pub digest: String,
    pub sim_seconds: f64,
    pub wall_seconds: f64,
    pub speed_factor: f64,
    pub threads: usize,
    pub progress: Progress,
    pub messages: Messages,
    pub collisions: u64,
    pub properties: Vec<Property>,
    pub failures: Vec<Failed>,
    pub robots: Vec<Robot>,
    pub trace: Option<String>,
    pub plot: Option<String>,
    pub replay: String,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// It ended.
    Over(Outcome),
    /// Someone stopped it.
    Interrupted,
}

/// A property that was checked.
#[derive(Clone, Debug, Serialize)]
pub struct Property {
    pub property: Name,
    pub verdict: &'static str,
    pub violations: usize,
    pub first: Option<Breach>,
    pub excused: Vec<Excused>,
}

/// The number of excused violations of a property, for one reason.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Excused {
    pub reason: &'static str,
    pub count: u64,
}

/// The verdict on a property of a primitive that the run did not use.
pub const UNUSED: &str = "unused";

/// The verdict on a property whose demand has not come, and is not too late.
const OPEN: &str = "open";

/// The goal of a run that is only to last.
const LASTS: &str = "duration";

/// A violation of a property.
#[derive(Clone, Debug, Serialize)]
pub struct Breach {
    pub at_seconds: f64,
    pub robots: Vec<String>,
    pub text: String,
}

/// A program that could not continue.
#[derive(Clone, Debug, Serialize)]
pub struct Failed {
    pub at_seconds: f64,
    pub robot: String,
    pub text: String,
}

/// The results of one robot.
#[derive(Clone, Debug, Serialize)]
pub struct Robot {
    pub id: u32,
    pub name: String,
    pub model: &'static str,
    pub distance_m: f64,
    pub way_points: u32,
    /// How many commands its ReachAvoid gave up.
    pub gave_up: u32,
    /// How many datagrams it sent.
    pub sent: u32,
}

/// The part of a report that the simulation does not know.
pub struct Circumstances {
    pub target: String,
    pub replay: String,
    pub interrupted: bool,
    pub wall_seconds: f64,
    pub threads: usize,
    pub trace: Option<String>,
    pub plot: Option<String>,
}

impl Ending {
    /// How a run ended, or how far it was when it was interrupted.
    pub fn of(run: &Run, interrupted: bool) -> Ending {
        match interrupted && !run.is_over() {
            true => Ending::Interrupted,
            false => Ending::Over(run.outcome()),
        }
    }

    /// The word for it in JSON and in traces.
    pub fn word(self) -> &'static str {
        match self {
            Ending::Over(outcome) => outcome.word(),
            Ending::Interrupted => "interrupted",
        }
    }
}

impl Serialize for Ending {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.word())
    }
}

impl Report {
    /// The report of a run.
    pub fn of(run: &Run, circumstances: Circumstances) -> Report {
        let simulation = run.simulation();
        let scenario = simulation.scenario();
        let sim_seconds = simulation.now().seconds();
        let Circumstances {
            target,
            replay,
            interrupted,
            wall_seconds,
            threads,
            trace,
            plot,
        } = circumstances;
        Report {
            target,
            title: scenario.title.clone(),
            seed: scenario.seed,
            goal: match &scenario.goal {
                Goal::AllFinished => "all_finished".to_string(),
                Goal::Duration => LASTS.to_string(),
                Goal::Condition(condition) => condition.clone(),
            },
            outcome: Ending::of(run, interrupted),
            digest: simulation.digest().to_string(),
            sim_seconds,
            wall_seconds,
            speed_factor: sim_seconds / wall_seconds.max(1e-9),
            threads,
            progress: Progress::of(simulation),
            messages: Messages::of(simulation),
            collisions: simulation.tally().collisions,
            properties: properties(run, scenario),
            failures: failures(run, scenario),
            robots: robots(run, scenario),
            trace,
            plot,
            replay,
        }
    }

    /// Whether there was nothing to achieve but to last.
    pub fn only_lasts(&self) -> bool {
        self.goal == LASTS
    }

    /// The open properties: a condition that they demand is still false.
    pub fn open(&self) -> impl Iterator<Item = &str> {
        let open = self
            .properties
            .iter()
            .filter(|property| property.verdict == OPEN);
        open.map(|property| &*property.property)
    }

    /// Whether the goal was reached and no property was violated.
    pub fn is_success(&self) -> bool {
        self.outcome == Ending::Over(Outcome::Reached)
    }
}

impl Breach {
    /// A violation, told with the names of robots.
    pub fn of(violation: &Violation, name: impl Fn(RobotId) -> String) -> Breach {
        Breach {
            at_seconds: violation.at.seconds(),
            robots: violation.robots.iter().copied().map(name).collect(),
            text: violation.text.clone(),
        }
    }
}

fn properties(run: &Run, scenario: &Scenario) -> Vec<Property> {
    let property = |verdict: starl_properties::Verdict| Property {
        property: verdict.property,
        verdict: match (verdict.violations, verdict.open, verdict.used) {
            (0, _, false) => UNUSED,
            (0, false, _) => "holds",
            (0, true, _) => OPEN,
            _ => "violated",
        },
        violations: verdict.violations,
        first: verdict
            .first
            .map(|violation| Breach::of(&violation, |robot| scenario.fleet.name(robot))),
        excused: excused(&verdict.excused),
    };
    run.verdicts().into_iter().map(property).collect()
}

/// The excuses, for people and programs.
pub fn excused(excused: &[(Excuse, u64)]) -> Vec<Excused> {
    let counted = excused.iter().map(|(excuse, count)| Excused {
        reason: excuse.text(),
        count: *count,
    });
    counted.collect()
}

/// The excuses as a remark on a verdict; empty if there are none.
pub fn remark(excused: &[Excused]) -> String {
    let total: u64 = excused.iter().map(|excused| excused.count).sum();
    let reasons: Vec<String> = excused
        .iter()
        .map(|Excused { reason, count }| match excused.len() {
            1 => (*reason).to_string(),
            _ => format!("{reason} ({count})"),
        })
        .collect();
    match total {
        0 => String::new(),
        _ => format!("; {total} excused: {}", reasons.join(", ")),
    }
}

fn failures(run: &Run, scenario: &Scenario) -> Vec<Failed> {
    let failed = |failure: &starl_sim::Failure| Failed {
        at_seconds: failure.at.seconds(),
        robot: scenario.fleet.name(failure.robot),
        text: failure.text.to_string(),
    };
    run.failures().iter().map(failed).collect()
}

fn robots(run: &Run, scenario: &Scenario) -> Vec<Robot> {
    let simulation = run.simulation();
    let mut robots = Vec::new();
    for group in &scenario.fleet.groups {
        for _ in &group.starts {
            let id = RobotId(robots.len() as u32);
            robots.push(Robot {
                id: id.0,
                name: scenario.fleet.name(id),
                model: group.model.name(),
                distance_m: simulation.distance(id),
                way_points: simulation.way_points(id),
                gave_up: simulation.gave_up(id),
                sent: simulation.sent(id),
            });
        }
    }
    robots
}
