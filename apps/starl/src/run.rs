//! `starl run`: runs a scenario in the simulator and reports the result.

use crate::args::{PageArguments, RunArguments};
use crate::failure::Failure;
use crate::log::Log;
use crate::outputs::Outputs;
use crate::picture::Picture;
use crate::progress::Progress;
use crate::report::{Circumstances, Report};
use crate::target::Selection;
use crate::{console, json, summary, target, threads};
use starl_catalog::Application;
use starl_catalog::programs::Registry;
use starl_sim::Run;
use starl_sim::engine::StartError;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Runs what the arguments say; whether the goal was reached and no property violated.
pub fn run(arguments: &RunArguments, registry: &Registry) -> Result<bool, Failure> {
    if arguments.page != PageArguments::default() {
        let options = "--port, --no-browser and --page";
        return Err(Failure(format!(
            "{options} say how --open shows the run; add --open"
        )));
    }
    let picture = arguments.plot.as_deref().map(Picture::of).transpose()?;
    let Selection {
        application, files, ..
    } = target::read(arguments, registry)?;
    let scenario = application.scenario();
    let stop = stop_on_interrupt();
    let mut run = start(&application)?;
    let setting = run.setting();
    let threads = threads::count(arguments.threads, scenario.fleet.len());
    run.set_parallel(threads > 1);
    run.set_journal(arguments.inputs);
    let mut outputs = Outputs::open(arguments, application.resolved(), &setting, &files, picture)?;
    let shown = !arguments.quiet && !arguments.json;
    let progress = Progress::new(shown, scenario.duration);
    let log = Log::of(&arguments.log, scenario)?;
    let begun = Instant::now();
    let driven = threads::with(threads, || {
        drive(&mut run, &mut outputs, log.as_ref(), &progress, &stop)
    })?;
    let wall_seconds = begun.elapsed().as_secs_f64();
    progress.clear();
    driven?;
    let report = Report::of(
        &run,
        Circumstances {
            target: arguments.target.clone(),
            replay: command_line("run", arguments, &[("--seed", &scenario.seed.to_string())]),
            interrupted: stop.load(Ordering::Relaxed),
            wall_seconds,
            threads,
            trace: arguments
                .trace
                .as_ref()
                .map(|path| path.display().to_string()),
            plot: arguments
                .plot
                .as_ref()
                .map(|path| path.display().to_string()),
        },
    );
    outputs.finish(&run, &report)?;
    tell(arguments, &report)?;
    Ok(report.is_success())
}

/// A run of the application, at its start.
pub fn start(application: &Application) -> Result<Run, Failure> {
    let run = application.run();
    run.map_err(|error| start_error(application, error))
}

/// Names the place of a program that cannot be started.
pub fn start_error(application: &Application, error: StartError) -> Failure {
    application.problem(error).into()
}

/// Lets the run continue to its end, or until someone stops it.
fn drive(
    run: &mut Run,
    outputs: &mut Outputs,
    log: Option<&Log>,
    progress: &Progress,
    stop: &AtomicBool,
) -> Result<(), Failure> {
    while !run.is_over() && !stop.load(Ordering::Relaxed) {
        run.step();
        for record in run.records() {
            outputs.observe(record)?;
            if let Some(log) = log {
                log.observe(record, &run.simulation().scenario().fleet, progress);
            }
        }
        outputs.advance(run.simulation())?;
        progress.advance(run.simulation().now());
    }
    Ok(())
}

/// Set when someone presses Ctrl-C or asks the process to end; the second time ends it at once.
pub fn stop_on_interrupt() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = stop.clone();
    on_interrupt(move || flag.store(true, Ordering::Relaxed));
    stop
}

/// Does this when someone presses Ctrl-C or asks the process to end; the second time ends it at once.
pub fn on_interrupt(stop: impl Fn() + Send + 'static) {
    let mut is_second = false;
    // Without a handler Ctrl-C still ends the process, only less kindly.
    let _ = ctrlc::set_handler(move || {
        if is_second {
            std::process::exit(130);
        }
        is_second = true;
        stop();
    });
}

fn tell(arguments: &RunArguments, report: &Report) -> Result<(), Failure> {
    if arguments.json {
        json::print(report)
    } else if arguments.quiet {
        console::print(&summary::violations(report))
    } else {
        console::print(&summary::text(report))
    }
}

/// A command line that repeats one run by `starl run`, or by another command that has its options.
pub fn command_line(name: &str, arguments: &RunArguments, seeds: &[(&str, &str)]) -> String {
    let mut words = vec![
        console::command(),
        name.to_string(),
        quoted(&arguments.target),
    ];
    let mut option = |name: &str, value: &str| {
        words.push(name.to_string());
        words.push(quoted(value));
    };
    if let Some(scenario) = &arguments.scenario {
        option("--scenario", scenario);
    }
    if let Some(robots) = &arguments.robots {
        option("--robots", robots);
    }
    for (name, value) in seeds {
        option(name, value);
    }
    if let Some(duration) = &arguments.duration {
        option("--duration", duration);
    }
    for assignment in &arguments.set {
        option("--set", assignment);
    }
    if let Some(faults) = &arguments.faults {
        option("--faults", &faults.display().to_string());
    }
    words.join(" ")
}

/// A word as a shell takes it.
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_=.,/:+@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        return word.to_string();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}
