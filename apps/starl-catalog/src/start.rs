//! Reads scenarios and starts them with the programs they name.
//!
//! Invariant: a scenario that [`read`] returns can be started: its programs exist, are compiled if
//! they are in the StarL language, and take the parameters that it gives them.

use crate::examples::WithExamples;
use crate::language::{Findings, Programs};
use crate::programs::Registry;
use starl_core::{Program, RobotId};
use starl_lang::diagnostic::Colour;
use starl_lang::robot::Code;
use starl_sim::engine::{Complaint, StartError};
use starl_sim::read::{self, Loader, Problem, Problems, Request, Resolved};
use starl_sim::scenario::{Fleet, Goal, Group};
use starl_sim::{Run, Scenario, Simulation};
use std::fmt;

/// A scenario with its programs, ready to be started any number of times.
#[derive(Clone, Debug)]
pub struct Application {
    resolved: Resolved,
    pub(crate) programs: Programs,
    registry: Registry,
    warnings: Vec<Findings>,
}

/// All problems of a scenario and its programs.
#[derive(Clone, Debug)]
pub struct Refusal {
    /// The compiler's findings in the programs.
    pub findings: Vec<Findings>,
    /// The errors of the scenario itself.
    pub problems: Vec<Problem>,
}

/// Reads a scenario, including its programs and their parameters. Names of programs that are not files are looked
/// up in the registry.
///
/// # Errors
/// All its problems.
pub fn read(
    request: &Request,
    loader: &dyn Loader,
    registry: &Registry,
) -> Result<Application, Refusal> {
    let loader = &WithExamples(loader);
    let mut resolved = read::scenario(request, loader)?;
    let (programs, review) = Programs::compile(&mut resolved, loader);
    let mut problems: Vec<Problem> = review
        .complaints
        .into_iter()
        .map(|(group, complaint)| blame(&resolved, group, complaint))
        .collect();
    let is_broken = review.findings.iter().any(Findings::are_errors);
    let is_whole = problems.is_empty() && !is_broken;
    let mut application = Application {
        resolved,
        programs,
        registry: registry.clone(),
        warnings: review.findings,
    };
    for (index, group) in application.scenario().fleet.groups.iter().enumerate() {
        // Of programs that could not be compiled all is said already.
        let was_compiled = is_whole || !group.program.ends_with(crate::language::SUFFIX);
        if let (true, Err(complaint)) = (
            was_compiled,
            application.make(group, &application.scenario().fleet),
        ) {
            problems.push(blame(&application.resolved, index, complaint));
        }
    }
    if let (true, Goal::Condition(condition)) = (is_whole, &application.resolved.scenario.goal)
        && let Err(found) = application.programs.set_goal(condition)
    {
        let message = match found.first() {
            Some(first) => format!("{condition:?}: {}", first.message),
            None => format!(
                "{condition:?} is a condition, and no robot runs a program in the StarL language"
            ),
        };
        let help = "a goal is \"finished\", \"duration\" or a condition over the robots, such as \"forall r: r.done\"";
        problems.push(application.resolved.problem("goal", &message, Some(help)));
    }
    // An error in a value that several groups take from the scenario is reported once.
    problems.sort();
    problems.dedup();
    match problems.is_empty() && !is_broken {
        true => Ok(application),
        false => Err(Refusal {
            findings: application.warnings,
            problems,
        }),
    }
}

impl Application {
    /// The resolved scenario.
    pub fn resolved(&self) -> &Resolved {
        &self.resolved
    }

    /// The scenario.
    pub fn scenario(&self) -> &Scenario {
        &self.resolved.scenario
    }

    /// The programs in Rust that it may name.
    pub fn registry(&self) -> &Registry {
        &self.registry
    }

    /// The code of a robot's program; none if the program is not in the StarL language.
    pub fn code_of(&self, robot: RobotId) -> Option<&Code> {
        let (group, _) = self.scenario().fleet.group_of(robot)?;
        self.programs.code(group)
    }

    /// The warnings of the compiler.
    pub fn warnings(&self) -> &[Findings] {
        &self.warnings
    }

    /// A run at its start, with the checkers and monitors of the scenario.
    ///
    /// # Errors
    /// Returns only errors that [`read()`] has found before.
    pub fn run(&self) -> Result<Run, StartError> {
        self.run_of(self.scenario().clone())
    }

    /// A run of another scenario whose robots run programs of this one.
    ///
    /// # Errors
    /// A group names another program, or sets parameters that it does not accept.
    pub fn run_of(&self, scenario: Scenario) -> Result<Run, StartError> {
        let monitors = match scenario.properties.program {
            true => {
                let mut monitors = self.programs.monitors(&scenario);
                monitors.extend(self.registry.monitors(&scenario.fleet));
                monitors
            }
            false => Vec::new(),
        };
        let fleet = scenario.fleet.clone();
        let mut run = Run::new(scenario, &|group| self.make(group, &fleet))?;
        monitors
            .into_iter()
            .for_each(|monitor| run.add_monitor(monitor));
        let goal = self.programs.goal(&fleet);
        if !goal.is_empty() {
            run.set_goal(goal);
        }
        Ok(run)
    }

    /// A simulation at its start, not watched.
    ///
    /// # Errors
    /// As for [`Application::run`].
    pub fn simulation(&self) -> Result<Simulation, StartError> {
        Simulation::new(self.scenario().clone(), &|group| self.program(group))
    }

    /// The fresh program of a robot, with its parameters.
    ///
    /// # Errors
    /// Fails if the robot does not exist; otherwise only with errors that [`read()`] has found
    /// before.
    pub fn program_of(&self, robot: RobotId) -> Result<Box<dyn Program>, Complaint> {
        let group = self.scenario().fleet.group_of(robot);
        let (group, _) = group.ok_or_else(|| Complaint {
            field: "robots".into(),
            message: format!("there is no robot {robot}"),
            help: String::new(),
        })?;
        self.program(group)
    }

    pub(crate) fn program(&self, group: &Group) -> Result<Box<dyn Program>, Complaint> {
        self.make(group, &self.scenario().fleet)
    }

    /// The place of a program that cannot be started, and why.
    pub fn problem(&self, error: StartError) -> Problem {
        blame(&self.resolved, error.group, error.complaint)
    }

    fn make(&self, group: &Group, fleet: &Fleet) -> Result<Box<dyn Program>, Complaint> {
        match self.programs.make(group, fleet) {
            Some(program) => Ok(Box::new(program?)),
            None => self.registry.make(group),
        }
    }
}

impl From<Problems> for Refusal {
    fn from(problems: Problems) -> Refusal {
        Refusal {
            findings: Vec::new(),
            problems: problems.0,
        }
    }
}

impl Refusal {
    /// The files in which the compiler has found errors.
    pub fn broken_files(&self) -> impl Iterator<Item = &Findings> {
        self.findings
            .iter()
            .filter(|findings| findings.are_errors())
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for findings in self.broken_files() {
            f.write_str(&findings.render(&findings.name, Colour::Off))?;
        }
        write!(f, "{}", Problems(self.problems.clone()))
    }
}

impl std::error::Error for Refusal {}

/// Names the place where what a group's program complains of was written.
fn blame(resolved: &Resolved, index: usize, complaint: Complaint) -> Problem {
    let Complaint {
        field,
        message,
        help,
    } = complaint;
    // A group without a program or parameters of its own has those of the whole scenario.
    let own = resolved.problem(&format!("robots.{index}.{field}"), "", None);
    let table = resolved.problem(&format!("robots.{index}"), "", None);
    let field = match own.place == table.place {
        true => field,
        false => format!("robots.{index}.{field}"),
    };
    let help = (!help.is_empty()).then_some(&*help);
    resolved.problem(&field, &message, help)
}
