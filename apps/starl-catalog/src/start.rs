//! Reads scenarios and starts them with the programs they name.
//!
//! Invariant: a scenario that [`read`] returns can be started: its programs exist and take the
//! parameters that it gives them.

use crate::parameters::Complaint;
use crate::programs;
use starl_core::Program;
use starl_sim::engine::StartError;
use starl_sim::read::{self, Loader, Problem, Problems, Request, Resolved};
use starl_sim::scenario::Group;
use starl_sim::{Run, Scenario, Simulation};

/// Reads a scenario, its programs and their parameters included.
///
/// # Errors
/// All that is wrong with it.
pub fn read(request: &Request, loader: &dyn Loader) -> Result<Resolved, Problems> {
    let resolved = read::scenario(request, loader)?;
    let groups = resolved.scenario.fleet.groups.iter().enumerate();
    let mut problems: Vec<Problem> = groups
        .filter_map(|(index, group)| {
            let complaint = programs::make(group).err()?;
            Some(blame(&resolved, index, complaint))
        })
        .collect();
    // What several groups have from the scenario is wrong once.
    problems.sort();
    problems.dedup();
    match problems.is_empty() {
        true => Ok(resolved),
        false => Err(Problems(problems)),
    }
}

/// A scenario at its start, under watch.
///
/// # Errors
/// Where it was not [`read()`] here: a group whose program cannot be made.
pub fn run(scenario: Scenario) -> Result<Run, StartError> {
    Run::new(scenario, &make)
}

/// A scenario at its start, not watched.
///
/// # Errors
/// As for [`run`].
pub fn simulation(scenario: Scenario) -> Result<Simulation, StartError> {
    Simulation::new(scenario, &make)
}

fn make(group: &Group) -> Result<Box<dyn Program>, String> {
    programs::make(group).map_err(|complaint| complaint.message)
}

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
    resolved.problem(&field, &message, Some(&help))
}
