//! `starl explore`: every behaviour of a small fleet within bounds, and the way to a violation.
//!
//! Exit status: 0 all was explored and nothing is violated; 1 something is; 2 bad input; 3 a bound on the
//! number of states or steps, or on the time that it takes, was hit first, or someone stopped it, so that only
//! a part is proved.

mod account;
mod bounds;
mod events;
mod hints;
mod progress;
mod record;
mod replay;

use crate::args::{ExploreArguments, LogArguments, PageArguments, RunArguments};
use crate::failure::Failure;
use crate::output::Output;
use crate::outputs::refuse_to_overwrite;
use crate::run::stop_on_interrupt;
use crate::target::Selection;
use crate::{console, json, target, threads};
use account::Account;
use progress::Progress;
use record::Recording;
use starl_catalog::Application;
use starl_catalog::programs::Registry;
use starl_explore::{End, Search, Setup};
use starl_sim::scenario::Goal;
use std::fs::File;
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Instant;

/// Fleets are this large unless the command says otherwise.
const ROBOTS: usize = 3;

/// Explores what the arguments say, or goes a way that was found before.
pub fn run(arguments: &ExploreArguments, registry: &Registry) -> Result<ExitCode, Failure> {
    match (&arguments.replay, &arguments.target) {
        (Some(path), _) => replay::replay(path, arguments.diagram.as_deref(), registry),
        (None, Some(target)) => explore(target, arguments, registry),
        (None, None) => Err(Failure(
            "name what to explore: an example, a scenario file or a program; or --replay FILE"
                .into(),
        )),
    }
}

fn explore(
    target: &str,
    arguments: &ExploreArguments,
    registry: &Registry,
) -> Result<ExitCode, Failure> {
    let Selection {
        application, files, ..
    } = target::read(&as_run(target, arguments), registry)?;
    let outputs = [
        ("--save", arguments.save.as_deref()),
        ("--diagram", arguments.diagram.as_deref()),
    ];
    refuse_to_overwrite(&outputs, &files)?;
    let recording = Recording {
        robots: robots(arguments, &application)?,
        bounds: bounds::read(arguments)?,
        heartbeats: arguments.heartbeats,
        warm_up: arguments.warm_up,
    };
    let within = bounds::within(arguments)?;
    let setup = recording.setup(&application)?;
    let output = match &arguments.save {
        Some(path) => Some(Output::create(path)?),
        None => None,
    };
    let sheet = replay::sheet(arguments.diagram.as_deref())?;
    let stop = stop_on_interrupt();
    let progress = Progress::new(!arguments.quiet && !arguments.json);
    let begun = Instant::now();
    let mut search = start(&recording, setup.clone())?;
    search.set_doubting(arguments.doubt);
    let is_interrupted = || stop.load(Ordering::Relaxed);
    let is_late = || begun.elapsed().as_secs_f64() >= within.seconds();
    let threads = threads::for_runs(arguments.threads);
    search.set_parallel(threads > 1);
    threads::with(threads, || {
        while !is_interrupted() && !is_late() && search.advance().is_none() {
            progress.advance(&search.report());
        }
    })?;
    progress.clear();
    let end = search.end().cloned();
    let mut account = Account::new(
        target,
        &recording,
        setup.model.keeps_storage,
        &search.report(),
        end.as_ref(),
    );
    if end.is_none() && !is_interrupted() {
        account.run_late(&arguments.within);
    }
    if !matches!(end, Some(End::Violated(_))) {
        let is_complete = end == Some(End::Complete);
        account.hints = hints::hints(&recording.bounds, search.told(), is_complete);
        account
            .hints
            .extend(hints::unjudged(&application.unexplored_properties()));
        let is_goal = application.scenario().goal == Goal::AllFinished;
        if is_goal && !setup.model.all_finish {
            account.hints.push(hints::UNJUDGED.to_string());
        }
    }
    account.seconds = begun.elapsed().as_secs_f64();
    if let Some(End::Violated(found)) = &end {
        account.saved = Some(save(target, output, &application, &recording, found)?);
        let shown = replay::show(&recording, setup, found)?;
        if let Some(sheet) = sheet {
            shown.draw(&application, sheet)?;
        }
        account.steps = shown.lines;
    }
    if let Some(End::Contradiction(text)) = &end {
        return Err(Failure(format!("{target}: {text}")));
    }
    match (arguments.json, arguments.quiet) {
        (true, _) => json::print(&account)?,
        (false, true) => console::print(&account.violation_text())?,
        (false, false) => console::print(&account.text())?,
    }
    Ok(ExitCode::from(match end {
        Some(End::Complete) => 0,
        Some(End::Violated(_)) => 1,
        _ => 3,
    }))
}

/// A search at its start.
fn start(recording: &Recording, setup: Setup) -> Result<Search, Failure> {
    let (walk, _, violations) = recording.begin(setup)?;
    Search::from(&walk, violations)
        .map_err(|_| Failure("--robots: an exploration has room for 256 robots at most".into()))
}

/// How many robots there are.
fn robots(arguments: &ExploreArguments, application: &Application) -> Result<usize, Failure> {
    let fleet = application.scenario().fleet.len();
    match arguments.robots {
        Some(robots) if robots as usize > fleet => Err(Failure(format!(
            "--robots: the scenario has {fleet} robots; set more with --set robots.0.count={robots}"
        ))),
        Some(robots) => Ok(robots as usize),
        None => Ok(fleet.min(ROBOTS)),
    }
}

/// The same target with the same changes, as `starl run` takes it.
fn as_run(target: &str, arguments: &ExploreArguments) -> RunArguments {
    RunArguments {
        target: target.to_string(),
        scenario: arguments.scenario.clone(),
        robots: None,
        seed: arguments.seed.clone(),
        duration: None,
        set: arguments.set.clone(),
        faults: None,
        threads: None,
        trace: None,
        inputs: false,
        plot: None,
        json: arguments.json,
        quiet: arguments.quiet,
        log: LogArguments::default(),
        open: false,
        page: PageArguments::default(),
    }
}

/// Keeps the way to a violation in a file; gives its name.
fn save(
    target: &str,
    output: Option<(Output, File)>,
    application: &Application,
    recording: &Recording,
    found: &starl_explore::Counterexample,
) -> Result<String, Failure> {
    let (output, file) = match output {
        Some(output) => output,
        None => {
            let name = std::path::Path::new(target).file_stem().unwrap_or_default();
            let name = format!("{}-counterexample.json", name.display());
            Output::create(std::path::Path::new(&name))?
        }
    };
    let name = output.path().display().to_string();
    let content = record::write(&application.resolved().inputs, recording, found);
    output.write(file, content.as_bytes())?;
    Ok(name)
}
