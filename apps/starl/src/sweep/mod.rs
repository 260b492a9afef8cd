//! `starl sweep`: every combination of some fields' values with many seeds, on all cores. See
//! `docs/reference/command.md`; the work is that of the crate `starl-sweep`.

mod metrics;
mod output;
mod plot;
mod report;

pub use metrics::{Shown, shown};

use crate::args::{ChangeArguments, SweepArguments};
use crate::cluster::Workers;
use crate::console;
use crate::failure::Failure;
use crate::json;
use crate::origin::Origin;
use crate::outputs::refuse_to_overwrite;
use crate::picture::Picture;
use crate::progress::Count;
use crate::run::{command_line, stop_on_interrupt};
use crate::target::{self, Selection};
use output::Outputs;
use report::{Circumstances, Report};
use starl_catalog::programs::Registry;
use starl_sweep::{Axis, Error, Format, Journal, Measured, Plan, Runner, Seeds, Task, execute};
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::time::Instant;

/// Runs the sweep that the arguments describe; whether all of it was run.
pub fn sweep(arguments: &SweepArguments, registry: &Registry) -> Result<bool, Failure> {
    let metrics = shown(&arguments.runs.metric)?;
    let seeds: Seeds = arguments.runs.seeds.parse()?;
    let out = arguments.out.as_deref();
    let format = out.map(Format::of).transpose();
    let format = format.map_err(|error| Failure(format!("--out {error}")))?;
    let picture = arguments.plot.as_deref().map(Picture::of).transpose()?;
    let (plan, title, read) = plan(arguments, seeds, registry)?;
    if picture.is_some() && plan.axes().is_empty() {
        let message =
            "--plot: there is no axis to draw against; give a field several values with --set";
        return Err(Failure(message.to_string()));
    }
    let stop = stop_on_interrupt();
    let journal = out.map(Journal::path_of);
    let named = [
        ("--out", out),
        ("--plot", arguments.plot.as_deref()),
        ("the journal of --out", journal.as_deref()),
    ];
    refuse_to_overwrite(&named, &read)?;
    let mut workers = Workers::of(&arguments.cluster, arguments.runs.threads, &stop)?;
    let (mut outputs, mut rows) = Outputs::open(out.zip(format), &plan)?;
    let done_before = rows.len() as u64;
    let progress = Count::new(!arguments.runs.quiet && !arguments.runs.json, plan.len());
    progress.begin_at(done_before);
    let begun = Instant::now();
    let open = plan.open(&rows);
    let mut take = |row: Measured| {
        outputs.keep(&row)?;
        rows.insert(row.row.number, row);
        progress.add(1);
        Ok(())
    };
    let done = match &mut workers {
        Workers::Threads(threads) => {
            let tasks = open.into_iter().map(|number| ((), plan.task(number)));
            let runner = Runner::new(registry.clone());
            let taken = execute(tasks, &runner, *threads, &stop, |(), row| take(row));
            taken.map_err(Failure::from)
        }
        Workers::Cluster(cluster) => {
            cluster.run("sweep", &plan, &open, &stop, |row| Ok(take(row)?))
        }
    };
    progress.clear();
    done?;
    let is_whole = rows.len() as u64 == plan.len();
    let report = Report::of(
        &plan,
        &rows,
        Circumstances {
            title,
            replay: &|task| replay(arguments, task),
            done_before,
            wall_seconds: begun.elapsed().as_secs_f64(),
            workers: &workers,
            interrupted: !is_whole && stop.load(Ordering::Relaxed),
            out: arguments.out.clone(),
            plot: arguments.plot.clone(),
        },
    );
    if is_whole {
        outputs.finish(&plan, &rows)?;
        if let Some((path, picture)) = arguments.plot.as_deref().zip(picture) {
            output::save(path, &plot::file(&plan, &report, metrics[0], picture))?;
        }
    }
    match (arguments.runs.json, arguments.runs.quiet) {
        (true, _) => json::print(&report)?,
        (false, true) if is_whole => {}
        (false, _) => console::print(&report.text(&metrics))?,
    }
    Ok(is_whole)
}

/// The plan, the scenario's title, and the files that it was read from.
fn plan(
    arguments: &SweepArguments,
    seeds: Seeds,
    registry: &Registry,
) -> Result<(Plan, String, Vec<PathBuf>), Failure> {
    let axes: Result<Vec<Axis>, Error> = arguments
        .changes
        .set
        .iter()
        .map(|set| Axis::parse(set))
        .collect();
    let axes = axes?;
    let changes = ChangeArguments {
        set: axes.iter().filter_map(Axis::first_setting).collect(),
        ..arguments.changes.clone()
    };
    let quiet = arguments.runs.quiet || arguments.runs.json;
    let arguments_of_run = changes.of(&arguments.target, None, quiet);
    let Selection {
        application,
        mut files,
        origin,
    } = target::read(&arguments_of_run, registry)?;
    let axes = axes.into_iter().filter(Axis::varies);
    let plan = Plan::new(
        &arguments.target,
        &application,
        axes.collect(),
        seeds,
        arguments.runs.profile.as_deref(),
        &origin,
    );
    let plan = plan.map_err(|error| refused(error, &origin))?;
    files.extend(
        plan.inputs()
            .files
            .keys()
            .filter_map(|path| origin.path(path)),
    );
    Ok((plan, application.scenario().title.clone(), files))
}

/// The command that repeats the run of a task.
fn replay(arguments: &SweepArguments, task: &Task) -> String {
    let given = arguments.changes.set.iter();
    let is_fixed = |set: &&String| Axis::parse(set).is_ok_and(|axis| !axis.varies());
    let mut changes = arguments.changes.clone();
    changes.set = given.filter(is_fixed).cloned().collect();
    let settings = task.settings.iter();
    let settings = settings.map(|setting| format!("{}={}", setting.path, setting.value));
    changes.set.extend(settings);
    changes.robots = task.robots.clone().or(changes.robots);
    let run = changes.of(&arguments.target, None, true);
    let seed = task.seed.to_string();
    match &task.profile {
        None => command_line("run", &run, &[("--seed", &seed)]),
        Some(profile) => {
            let seeds = [
                ("--profile", &**profile),
                ("--first-seed", &seed),
                ("--seeds", "1"),
            ];
            command_line("test", &run, &seeds)
        }
    }
}

/// Prints the errors of programs, each with its lines; the failure sums them up.
pub fn refused(error: Error, origin: &Origin) -> Failure {
    match error {
        Error::Refused(refusal) => target::tell(&refusal, |findings| origin.name(findings)),
        error => error.into(),
    }
}
