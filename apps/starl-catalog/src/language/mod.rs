//! Programs in the StarL language: found, compiled, given their parameters and watched.
//!
//! A program is known by its path relative to the scenario that names it. It is compiled once, however
//! many robots run it.

mod condition;
mod invariant;
mod monitor;
mod source;
mod values;

pub use condition::FleetCondition;
pub use source::Findings;

use invariant::ProgramInvariant;
use monitor::ProgramMonitor;
use source::Compiled;
use starl_core::{Port, RobotId};
use starl_explore::Invariant;
use starl_lang::diagnostic::Diagnostic;
use starl_lang::machine::Claim;
use starl_lang::robot::{Code, RobotProgram};
use starl_properties::Monitor;
use starl_sim::Scenario;
use starl_sim::engine::Complaint;
use starl_sim::read::{Loader, Resolved};
use starl_sim::scenario::{Fleet, Group};
use std::collections::{BTreeMap, BTreeSet};

/// The suffix of a program's file; any other name is that of a program of the catalog.
pub const SUFFIX: &str = ".starl";

/// The compiled programs of a scenario, by path.
#[derive(Clone, Debug, Default)]
pub struct Programs(BTreeMap<String, Compiled>);

/// The findings about the programs of a scenario.
#[derive(Clone, Debug, Default)]
pub struct Review {
    /// The errors of files, each with the group that names the program.
    pub complaints: Vec<(usize, Complaint)>,
    /// The findings of the compiler, including warnings.
    pub findings: Vec<Findings>,
}

impl Programs {
    /// Loads and compiles the programs that the groups of a scenario name.
    pub fn compile(resolved: &mut Resolved, loader: &dyn Loader) -> (Programs, Review) {
        let (mut programs, mut review) = (Programs::default(), Review::default());
        let mut named = BTreeMap::new();
        for (index, group) in resolved.scenario.fleet.groups.iter().enumerate() {
            if group.program.ends_with(SUFFIX) {
                named.entry(group.program.clone()).or_insert(index);
            }
        }
        for (path, group) in named {
            match source::compile(&path, resolved, loader) {
                Ok((compiled, findings)) => {
                    review.findings.extend(findings);
                    programs.0.extend(compiled.map(|compiled| (path, compiled)));
                }
                Err(error) => {
                    let complaint = Complaint {
                        field: "program".to_string(),
                        message: error.to_string(),
                        help: String::new(),
                    };
                    review.complaints.push((group, complaint));
                }
            }
        }
        (programs, review)
    }

    /// Makes the program of a group of robots; none if the group names no program of this language.
    ///
    /// # Errors
    /// If the program does not take the parameters as they are.
    pub fn make(&self, group: &Group, fleet: &Fleet) -> Option<Result<RobotProgram, Complaint>> {
        Some(values::program(self.code(group)?, group, fleet))
    }

    /// The monitors of the properties that the programs declare.
    pub fn monitors(&self, scenario: &Scenario) -> Vec<Box<dyn Monitor>> {
        let named = self.named(&scenario.fleet);
        let monitors =
            named.filter_map(|(name, code, robots)| ProgramMonitor::new(name, code, robots));
        monitors
            .map(|monitor| Box::new(monitor) as Box<dyn Monitor>)
            .collect()
    }

    /// The properties of the programs for every state of the first `count` robots.
    pub fn invariants(&self, scenario: &Scenario, count: usize) -> Vec<Box<dyn Invariant>> {
        let named = self.named(&scenario.fleet);
        let invariants = named.filter_map(|(name, code, mut robots)| {
            robots.retain(|robot| robot.index() < count);
            ProgramInvariant::new(name, code, robots)
        });
        invariants
            .map(|invariant| Box::new(invariant) as Box<dyn Invariant>)
            .collect()
    }

    /// The names of the properties that are about more than single states.
    pub fn properties_of_paths(&self, scenario: &Scenario) -> Vec<String> {
        let named = self.named(&scenario.fleet);
        let names = named.flat_map(|(name, code, _)| {
            let properties = code.program().bytecode().properties.iter();
            let of_paths =
                properties.filter(|property| !matches!(property.claim, Claim::Always(_)));
            let names = of_paths.map(|property| format!("{name}.{}", property.name));
            names.collect::<Vec<_>>()
        });
        names.collect()
    }

    /// The condition for the robots of each program for which it has no errors.
    ///
    /// # Errors
    /// The errors for the first program, if there are errors for all; positions are bytes of the text. Empty if there
    /// is no program.
    pub fn conditions(&self, condition: &str) -> Result<Vec<FleetCondition>, Vec<Diagnostic>> {
        self.each_that_can(|path, compiled| FleetCondition::new(path, compiled, condition))
    }

    /// Sets the condition that is the goal of runs, for each program for which it has no errors.
    ///
    /// # Errors
    /// As for [`Programs::conditions`].
    pub fn set_goal(&mut self, condition: &str) -> Result<(), Vec<Diagnostic>> {
        let codes = self.each_that_can(|path, compiled| {
            Ok((path.to_string(), condition::code_with(compiled, condition)?))
        })?;
        for (path, code) in codes {
            if let Some(compiled) = self.0.get_mut(&path) {
                compiled.goal = Some(code);
            }
        }
        Ok(())
    }

    /// The monitors of a run's goal, if one was set.
    pub fn goal(&self, fleet: &Fleet) -> Vec<Box<dyn Monitor>> {
        let mut monitors: Vec<Box<dyn Monitor>> = Vec::new();
        for (path, compiled) in &self.0 {
            if let Some(code) = &compiled.goal {
                let qualifier = (self.0.len() > 1).then_some(compiled.name.as_str());
                let monitor = ProgramMonitor::of_goal(qualifier, code, members(fleet, path));
                monitors.push(Box::new(monitor));
            }
        }
        monitors
    }

    /// Makes something of each program where that is possible; gives the errors of the first one if of none.
    fn each_that_can<T>(
        &self,
        make: impl Fn(&str, &Compiled) -> Result<T, Vec<Diagnostic>>,
    ) -> Result<Vec<T>, Vec<Diagnostic>> {
        let (made, problems): (Vec<_>, Vec<_>) =
            (self.0.iter().map(|(path, compiled)| make(path, compiled))).partition(Result::is_ok);
        match made.is_empty() {
            true => Err(problems
                .into_iter()
                .find_map(Result::err)
                .unwrap_or_default()),
            false => Ok(made.into_iter().flatten().collect()),
        }
    }

    /// The code of a group's program; none if the group names no program of this language.
    pub fn code(&self, group: &Group) -> Option<&Code> {
        Some(&self.0.get(&group.program)?.code)
    }

    /// The code of the programs.
    pub fn codes(&self) -> impl Iterator<Item = &Code> {
        self.0.values().map(|compiled| &compiled.code)
    }

    /// Where the programs' failure detectors listen.
    pub fn detectors(&self) -> BTreeSet<Port> {
        let codes = self.0.values().map(|compiled| &compiled.code);
        codes.filter_map(Code::detector).collect()
    }

    /// Whether an action of some program waits for time to pass.
    pub fn wait_for_time(&self) -> bool {
        self.0
            .values()
            .any(|compiled| compiled.code.waits_for_time())
    }

    /// Each program with the name that its properties begin with, and the robots that run it.
    fn named(&self, fleet: &Fleet) -> impl Iterator<Item = (&str, &Code, Vec<RobotId>)> {
        self.0.iter().map(|(path, compiled)| {
            let same = self.0.values().filter(|other| other.name == compiled.name);
            let qualifier = match same.count() {
                1 => &compiled.name,
                _ => path,
            };
            (qualifier.as_str(), &compiled.code, members(fleet, path))
        })
    }
}

/// The robots that run a program.
fn members(fleet: &Fleet, path: &str) -> Vec<RobotId> {
    let programs = fleet.groups.iter().flat_map(|group| {
        let program = group.program.as_str();
        group.starts.iter().map(move |_| program)
    });
    let robots = programs.zip(0..).filter(|(program, _)| *program == path);
    robots.map(|(_, number)| RobotId(number)).collect()
}
