//! A run from start to end: the simulation, its checkers and monitors, and the result.

use crate::engine::{InterventionError, Programs, Simulation, StartError};
use crate::scenario::{Goal, Group, Scenario};
use serde::{Deserialize, Serialize};
use starl_core::event::{Event, Name};
use starl_core::{Intervention, Record, RobotId, Time};
use starl_properties::{Excuse, Monitor, Setting, Verdict, Violation, Watch};
use std::ops::Range;

/// A scenario under way and under watch.
#[derive(Clone)]
pub struct Run {
    simulation: Simulation,
    watch: Watch,
    /// The goal is reached when the properties of the monitors from here on have come; see [`Run::set_goal`].
    goal: Option<Range<usize>>,
    failures: Vec<Failure>,
    records: Vec<Record>,
}

/// The outcome of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The application's goal was reached and no property was violated.
    Reached,
    /// The goal was reached, but a property was violated.
    Violated,
    /// The time was up before the goal was reached.
    TimedOut,
    /// A program failed, or no robot is left.
    Failed,
}

impl Outcome {
    /// The word for it in reports and traces.
    pub fn word(self) -> &'static str {
        match self {
            Outcome::Reached => "reached",
            Outcome::Violated => "violated",
            Outcome::TimedOut => "timed_out",
            Outcome::Failed => "failed",
        }
    }
}

/// A program that cannot continue.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// Since when.
    pub at: Time,
    /// On which robot.
    pub robot: RobotId,
    /// Why.
    pub text: Name,
}

impl Run {
    /// Sets up a run: see [`Simulation::new`].
    pub fn new(scenario: Scenario, programs: &Programs<'_>) -> Result<Run, StartError> {
        let checkers = starl_properties::checkers(&setting(&scenario));
        let mut simulation = Simulation::new(scenario, programs)?;
        simulation.set_recording(true);
        Ok(Run {
            simulation,
            watch: Watch::new(checkers),
            goal: None,
            failures: Vec::new(),
            records: Vec::new(),
        })
    }

    /// Has the run watched by one more; to be called before the first step.
    pub fn add_monitor(&mut self, monitor: Box<dyn Monitor>) {
        self.watch.add_monitor(monitor);
    }

    /// Sets the monitors of the scenario's [`Goal::Condition`]: the goal is reached when none of them is open. Call it
    /// before the first step. Without it such a goal is never reached.
    pub fn set_goal(&mut self, monitors: Vec<Box<dyn Monitor>>) {
        let first = self.watch.monitors();
        monitors
            .into_iter()
            .for_each(|monitor| self.add_monitor(monitor));
        self.goal = Some(first..self.watch.monitors());
    }

    fn condition_has_come(&self) -> bool {
        let mut goals = self.goal.clone().into_iter().flatten();
        self.goal.is_some() && goals.all(|monitor| !self.watch.is_open(monitor))
    }

    /// The simulation.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// Steers the simulation: see [`Simulation::apply`].
    ///
    /// # Errors
    /// The error of the intervention.
    pub fn apply(&mut self, at: Time, what: Intervention) -> Result<(), InterventionError> {
        self.simulation.apply(at, what)
    }

    /// Whether to step on several threads: see [`Simulation::set_parallel`].
    pub fn set_parallel(&mut self, parallel: bool) {
        self.simulation.set_parallel(parallel);
    }

    /// Whether to keep [`Simulation::journal`]: see [`Simulation::set_journal`].
    pub fn set_journal(&mut self, keep: bool) {
        self.simulation.set_journal(keep);
    }

    /// Steers the run as another one was steered: see [`Simulation::repeat`].
    pub fn repeat(&mut self, recorded: impl IntoIterator<Item = (Time, Intervention)>) {
        self.simulation.repeat(recorded);
    }

    /// Advances by one physics step and returns what happened, violations included.
    pub fn step(&mut self) -> &[Record] {
        let before = self.simulation.now();
        let known = self.watch.violations().len();
        self.advance();
        let violations = &self.watch.violations()[known..];
        if !violations.is_empty() {
            self.records.extend_from_slice(self.simulation.records());
            self.records
                .extend(violations.iter().map(|violation| Record {
                    // A bound may have run out, or a pose been taken, a little earlier.
                    at: violation.at.max(before),
                    robot: violation.robots.first().copied(),
                    event: Event::Violated {
                        property: violation.property.clone(),
                        text: violation.text.clone().into(),
                    },
                }));
            self.records.sort_by_key(|record| record.at);
        }
        self.records()
    }

    /// The records of the last [`Run::step`], including violations.
    pub fn records(&self) -> &[Record] {
        match self.records.is_empty() {
            true => self.simulation.records(),
            false => &self.records,
        }
    }

    /// Advances by one physics step without returning its records.
    pub fn advance(&mut self) {
        self.records.clear();
        self.simulation.step();
        let records = self.simulation.records();
        self.watch.observe(records, self.simulation.now());
        self.watch.witness(&self.simulation);
        self.failures
            .extend(self.simulation.records().iter().filter_map(Failure::of));
    }

    /// Whether the run has ended.
    pub fn is_over(&self) -> bool {
        let scenario = self.simulation.scenario();
        if self.simulation.now() >= Time::ZERO + scenario.duration {
            return true;
        }
        let progress = self.simulation.progress();
        let settled = progress.up > 0 && progress.finished + progress.failed == progress.up;
        let all_failed = progress.up > 0 && progress.failed == progress.up;
        match scenario.goal {
            Goal::AllFinished => settled,
            Goal::Duration => all_failed,
            Goal::Condition(_) => all_failed || self.condition_has_come(),
        }
    }

    /// The outcome of the run, once it is over.
    pub fn outcome(&self) -> Outcome {
        let progress = self.simulation.progress();
        let scenario = self.simulation.scenario();
        let reached = match scenario.goal {
            Goal::AllFinished => progress.finished == progress.up,
            Goal::Duration => self.simulation.now() >= Time::ZERO + scenario.duration,
            Goal::Condition(_) => self.condition_has_come(),
        };
        if progress.up == 0 || progress.failed > 0 {
            Outcome::Failed
        } else if !reached {
            Outcome::TimedOut
        } else if self.watch.violations().is_empty() {
            Outcome::Reached
        } else {
            Outcome::Violated
        }
    }

    /// All violations so far.
    pub fn violations(&self) -> &[Violation] {
        self.watch.violations()
    }

    /// How often something was excused that speaks against a property, and why.
    pub fn excused(&self) -> Vec<(Name, Excuse, u64)> {
        self.watch.excused()
    }

    /// The setting of the checkers, which a trace contains so that others can judge it.
    pub fn setting(&self) -> Setting {
        Setting {
            monitored: self.watch.monitored().collect(),
            ..setting(self.simulation.scenario())
        }
    }

    /// All programs so far that cannot continue.
    pub fn failures(&self) -> &[Failure] {
        &self.failures
    }

    /// The verdicts of checkers and monitors on each property.
    pub fn verdicts(&self) -> Vec<Verdict> {
        self.watch.verdicts()
    }
}

impl Failure {
    fn of(record: &Record) -> Option<Failure> {
        match &record.event {
            Event::Failed(text) => Some(Failure {
                at: record.at,
                robot: record.robot?,
                text: text.clone(),
            }),
            _ => None,
        }
    }
}

/// The setting of a simulated run: bodies, obstacles and the checks. For records of another host, say so in
/// [`Setting::simulated`].
pub fn setting(scenario: &Scenario) -> Setting {
    let groups = &scenario.fleet.groups;
    let body = |group: &Group| vec![group.model.body(); group.starts.len()];
    let obstacles = scenario.world.obstacles.iter();
    let walls = scenario.world.walls();
    let drifts = groups.iter().map(|group| group.clock.drift_ppm);
    Setting {
        walls: walls.len(),
        bodies: groups.iter().flat_map(body).collect(),
        obstacles: obstacles
            .map(|entry| (entry.obstacle.clone(), entry.expires))
            .chain(walls.into_iter().map(|wall| (wall, Time::NEVER)))
            .collect(),
        properties: scenario.properties,
        monitored: Vec::new(),
        step: scenario.physics.step,
        pose_period: scenario.trace.pose_period,
        estimate_period: scenario.positioning.period,
        keeps_storage: scenario.storage.kept,
        only: None,
        unrecorded: Vec::new(),
        simulated: true,
        position_noise: scenario.positioning.position_noise,
        clock_drift: drifts.fold(0.0, f64::max) * 1e-6,
    }
}
