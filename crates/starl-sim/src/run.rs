//! A run from start to end: the simulation, the checkers and monitors that watch it, and what comes
//! of it.

use crate::engine::{Programs, Simulation, StartError};
use crate::properties::{self, Checker, Kinds, Monitor, Setting, Violation, Witness};
use crate::scenario::{Bounds, Goal, Group, Scenario};
use starl_core::event::{Event, Name};
use starl_core::{Record, RobotId, Time};

/// A scenario under way and under watch.
#[derive(Clone)]
pub struct Run {
    simulation: Simulation,
    checkers: Vec<Box<dyn Checker>>,
    monitors: Vec<Box<dyn Monitor>>,
    violations: Vec<Violation>,
    failures: Vec<Failure>,
    /// The primitives that have reported something.
    used: Vec<Name>,
    records: Vec<Record>,
    /// Those of the records of the last step.
    kinds: Vec<Kinds>,
}

/// What a run has come to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

/// What the checkers and monitors say of one property.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The property.
    pub property: Name,
    /// How often it was violated.
    pub violations: usize,
    /// The first time.
    pub first: Option<Violation>,
    /// Whether it has not been violated, but would be if nothing more happened: it demands something
    /// by a time that has not come.
    pub open: bool,
    /// Whether anything took place that it speaks of: a property of a primitive that nobody used says nothing.
    pub used: bool,
}

/// A program that cannot go on.
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
        let setting = Setting::of(&scenario);
        let checkers = properties::checkers(&scenario, &setting);
        let mut simulation = Simulation::new(scenario, programs)?;
        simulation.set_recording(true);
        Ok(Run {
            simulation,
            checkers,
            monitors: Vec::new(),
            violations: Vec::new(),
            failures: Vec::new(),
            used: Vec::new(),
            records: Vec::new(),
            kinds: Vec::new(),
        })
    }

    /// Has the run watched by one more; to be called before the first step.
    pub fn add_monitor(&mut self, monitor: Box<dyn Monitor>) {
        self.monitors.push(monitor);
    }

    /// The simulation.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// Whether to step on several threads: see [`Simulation::set_parallel`].
    pub fn set_parallel(&mut self, parallel: bool) {
        self.simulation.set_parallel(parallel);
    }

    /// Whether to keep [`Simulation::journal`]: see [`Simulation::set_journal`].
    pub fn set_journal(&mut self, keep: bool) {
        self.simulation.set_journal(keep);
    }

    /// Advances by one physics step and returns what happened, violations included.
    pub fn step(&mut self) -> &[Record] {
        let before = self.simulation.now();
        let known = self.violations.len();
        self.advance();
        self.records.clear();
        self.records.extend_from_slice(self.simulation.records());
        self.records
            .extend(self.violations[known..].iter().map(|violation| Record {
                // A bound may have run out, or a pose been taken, a little earlier.
                at: violation.at.max(before),
                robot: violation.robots.first().copied(),
                event: Event::Violated {
                    property: violation.property.clone(),
                    text: violation.text.clone().into(),
                },
            }));
        if self.violations.len() > known {
            self.records.sort_by_key(|record| record.at);
        }
        &self.records
    }

    /// Advances by one physics step for those who do not want to know what happened in it.
    pub fn advance(&mut self) {
        self.simulation.step();
        let records = self.simulation.records();
        self.kinds.clear();
        self.kinds
            .extend(records.iter().map(|record| Kinds::of(&record.event)));
        for record in records {
            if let Event::Primitive { primitive, .. } = &record.event
                && !self.used.contains(primitive)
            {
                self.used.push(primitive.clone());
            }
        }
        for checker in &mut self.checkers {
            let mut heeds = checker.heeds();
            for (record, &kind) in records.iter().zip(&self.kinds) {
                if heeds.meets(kind) {
                    checker.observe(record, &mut self.violations);
                    heeds = checker.heeds();
                }
            }
            checker.advance(self.simulation.now(), &mut self.violations);
        }
        let witness = Witness::new(&self.simulation);
        for monitor in &mut self.monitors {
            monitor.observe(&witness, &mut self.violations);
        }
        self.failures
            .extend(self.simulation.records().iter().filter_map(Failure::of));
    }

    /// Whether the run has come to its end.
    pub fn is_over(&self) -> bool {
        let scenario = self.simulation.scenario();
        if self.simulation.now() >= Time::ZERO + scenario.duration {
            return true;
        }
        let progress = self.simulation.progress();
        let settled = progress.up > 0 && progress.finished + progress.failed == progress.up;
        match scenario.goal {
            Goal::AllFinished => settled,
            Goal::Duration => progress.up > 0 && progress.failed == progress.up,
        }
    }

    /// What the run has come to, once it is over.
    pub fn outcome(&self) -> Outcome {
        let progress = self.simulation.progress();
        let scenario = self.simulation.scenario();
        let reached = match scenario.goal {
            Goal::AllFinished => progress.finished == progress.up,
            Goal::Duration => self.simulation.now() >= Time::ZERO + scenario.duration,
        };
        if progress.up == 0 || progress.failed > 0 {
            Outcome::Failed
        } else if !reached {
            Outcome::TimedOut
        } else if self.violations.is_empty() {
            Outcome::Reached
        } else {
            Outcome::Violated
        }
    }

    /// All violations so far.
    pub fn violations(&self) -> &[Violation] {
        &self.violations
    }

    /// All programs so far that cannot go on.
    pub fn failures(&self) -> &[Failure] {
        &self.failures
    }

    /// What the checkers and monitors say of each property they watch.
    pub fn verdicts(&self) -> Vec<Verdict> {
        let checked = self.checkers.iter().flat_map(|checker| {
            let properties = checker.properties().iter();
            properties.map(|&property| {
                let used = self.is_used(property) && checker.has_subject(property);
                (Name::from(property), false, used)
            })
        });
        let monitored = self.monitors.iter().flat_map(|monitor| {
            let properties = monitor.properties().into_iter().enumerate();
            properties.map(|(index, property)| (property, monitor.is_open(index), true))
        });
        checked
            .chain(monitored)
            .map(|(property, open, used)| self.verdict(property, open, used))
            .collect()
    }

    /// Whether the primitive that a checker's property is called after has been used. What is called after none
    /// is about the world.
    fn is_used(&self, property: &str) -> bool {
        let primitive = property.split_once('.').map(|(primitive, _)| primitive);
        primitive.is_none_or(|primitive| self.used.iter().any(|used| used == primitive))
    }

    fn verdict(&self, property: Name, open: bool, used: bool) -> Verdict {
        let mut against = self.violations.iter().filter(|v| v.property == property);
        let first = against.next().cloned();
        let violations = usize::from(first.is_some()) + against.count();
        Verdict {
            property,
            violations,
            open: open && first.is_none(),
            used: used || first.is_some(),
            first,
        }
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

impl Setting {
    /// What a scenario says of bodies and obstacles.
    pub fn of(scenario: &Scenario) -> Setting {
        let groups = &scenario.fleet.groups;
        let body = |group: &Group| vec![group.model.body(); group.starts.len()];
        let obstacles = scenario.world.obstacles.iter();
        let walls = scenario
            .world
            .bounds
            .as_ref()
            .map_or(Vec::new(), Bounds::walls);
        Setting {
            walls: walls.len(),
            bodies: groups.iter().flat_map(body).collect(),
            obstacles: obstacles
                .map(|entry| (entry.obstacle.clone(), entry.expires))
                .chain(walls.into_iter().map(|wall| (wall, Time::NEVER)))
                .collect(),
        }
    }
}
