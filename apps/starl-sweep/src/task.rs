//! A task: one run as plain data, and the function from a task to its row.
//!
//! Invariant: a row depends on its task alone, and not on the machine, the process, the threads or the tasks before.

use crate::axis::option;
use crate::{Error, Row};
use serde::{Deserialize, Serialize};
use starl_catalog::programs::Registry;
use starl_catalog::{Application, Refusal, trial};
use starl_core::Duration;
use starl_sim::engine::StartError;
use starl_sim::profile::Profile;
use starl_sim::read::{self, Inputs, Override, Request, suggest};
use starl_sim::{Run, Scenario};
use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// One run, as plain data. Tasks of one plan share the texts of scenario and programs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Task {
    /// Its place in the plan.
    pub number: u64,
    /// The scenario with the files that it names.
    pub inputs: Arc<Inputs>,
    /// The fields that the combination sets.
    pub settings: Vec<Override>,
    /// The fleet that the combination sets, as `--robots` has it.
    pub robots: Option<String>,
    /// The profile of faults.
    pub profile: Option<String>,
    /// Decides every random draw, start places included.
    pub seed: u64,
}

impl Task {
    /// The scenario to read; without the seed if `seeded` is false.
    pub(crate) fn request(&self, seeded: bool) -> Request {
        let mut request = self.inputs.request.clone();
        request.overrides.extend_from_slice(&self.settings);
        if seeded {
            let seed = self.seed.to_string();
            request
                .overrides
                .push(Override::named("--seed", "seed", &seed));
        }
        request.robots = self.robots.clone().or(request.robots);
        request
    }

    /// Whether both read the same scenario, up to the seed.
    fn is_like(&self, other: &Task) -> bool {
        let same_inputs = Arc::ptr_eq(&self.inputs, &other.inputs) || self.inputs == other.inputs;
        same_inputs
            && (&self.settings, &self.robots) == (&other.settings, &other.robots)
            && self.profile.is_some() == other.profile.is_some()
    }
}

/// Runs a task of programs that StarL ships with, or that are written in the language.
///
/// # Errors
/// If the scenario or its programs have errors, which [`Plan::new`](crate::Plan::new) finds before.
pub fn run_task(task: &Task) -> Result<Row, Error> {
    Runner::new(Registry::default()).run(task)
}

/// Runs tasks, and compiles the programs of a combination once for all its seeds.
pub struct Runner {
    registry: Registry,
    kept: Mutex<VecDeque<(Task, Cell)>>,
}

/// Several threads may need a combination at once; the first of them prepares it.
type Cell = Arc<OnceLock<Result<Prepared, Arc<Error>>>>;

/// The number of combinations that are kept: tasks are in order, and threads are never far apart.
const MOST_KEPT: usize = 8;

/// A combination that is read and compiled.
struct Prepared {
    application: Application,
    /// Faults of a profile set in within this time.
    span: Duration,
}

impl Runner {
    /// A runner of programs of the language and of the registry.
    pub fn new(registry: Registry) -> Runner {
        Runner {
            registry,
            kept: Mutex::default(),
        }
    }

    /// Runs a task to its end.
    ///
    /// # Errors
    /// As for [`run_task`].
    pub fn run(&self, task: &Task) -> Result<Row, Error> {
        let never = AtomicBool::new(false);
        let row = self.run_unless(task, &never)?;
        Ok(row.unwrap_or_else(|| unreachable!("it was not stopped")))
    }

    /// Runs a task to its end; none if `stop` was set before.
    ///
    /// # Errors
    /// As for [`run_task`].
    pub fn run_unless(&self, task: &Task, stop: &AtomicBool) -> Result<Option<Row>, Error> {
        let cell = self.cell(task);
        let prepared = cell.get_or_init(|| self.prepare(task).map_err(Arc::new));
        let prepared = prepared.as_ref().map_err(again)?;
        let Prepared { application, span } = prepared;
        let run = application.run_of(scenario(task, *span)?);
        let mut run = run.map_err(|error| start_error(application, error))?;
        Ok(finish(&mut run, task, stop))
    }

    fn cell(&self, task: &Task) -> Cell {
        // A thread that panicked leaves the list whole.
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, cell)) = kept.iter().find(|(known, _)| known.is_like(task)) {
            return cell.clone();
        }
        if kept.len() == MOST_KEPT {
            kept.pop_front();
        }
        let cell = Cell::default();
        kept.push_back((task.clone(), cell.clone()));
        cell
    }

    fn prepare(&self, task: &Task) -> Result<Prepared, Error> {
        let application = starl_catalog::read(&task.request(false), &*task.inputs, &self.registry)?;
        let span = match task.profile {
            None => Duration::ZERO,
            Some(_) => {
                let subject = trial::Subject::new(&application, false);
                subject
                    .map_err(|error| start_error(&application, error))?
                    .span()
            }
        };
        Ok(Prepared { application, span })
    }
}

/// The scenario of a task, with the faults of its profile listed.
fn scenario(task: &Task, span: Duration) -> Result<Scenario, Error> {
    // Start places are drawn from the seed while the scenario is read.
    let resolved = read::scenario(&task.request(true), &*task.inputs).map_err(Refusal::from)?;
    Ok(
        match task.profile.as_deref().map(named_profile).transpose()? {
            Some(profile) => profile.apply(&resolved.scenario, span, task.seed),
            None => resolved.scenario,
        },
    )
}

/// Names the place of a program that cannot be started.
pub(crate) fn start_error(application: &Application, error: StartError) -> Error {
    Error::Problem(application.problem(error))
}

/// The profile of this name.
pub(crate) fn named_profile(name: &str) -> Result<Profile, Error> {
    Profile::by_name(name).ok_or_else(|| {
        let known = Profile::ALL.map(Profile::name);
        let help = suggest::help(name, &known, "there are").unwrap_or_default();
        Error::option(
            &format!("--profile {name}"),
            "there is no such profile",
            &help,
        )
    })
}

fn finish(run: &mut Run, task: &Task, stop: &AtomicBool) -> Option<Row> {
    let mut counts = crate::row::Counts::default();
    while !run.is_over() {
        if stop.load(Ordering::Relaxed) {
            return None;
        }
        run.advance();
        counts.observe(run.simulation().records());
    }
    Some(Row::of(run, (task.number, task.seed), counts))
}

/// The same error again, for another task of a combination.
fn again(error: &Arc<Error>) -> Error {
    match &**error {
        Error::Refused(refusal) => Error::Refused(refusal.clone()),
        Error::Problem(problem) => Error::Problem(problem.clone()),
        Error::File { path, message } => Error::file(path, message.clone()),
    }
}

/// The field that a combination sets, as an override.
pub(crate) fn setting(field: &str, value: &str) -> Override {
    Override::named(&option(field), field, value)
}
