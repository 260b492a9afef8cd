//! `starl run`: runs a scenario in the simulator and tells what came of it.

use crate::args::RunArguments;
use crate::failure::Failure;
use crate::output::Output;
use crate::paths::Paths;
use crate::progress::Progress;
use crate::report::{Circumstances, Report};
use crate::{console, json, plot, recording, summary, target, threads};
use starl_sim::Run;
use starl_sim::read::Resolved;
use starl_trace::{Outcome, ViewOptions, WriteError, Writer};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Runs what the arguments say; whether the goal was reached and no property violated.
pub fn run(arguments: &RunArguments) -> Result<bool, Failure> {
    let picture = arguments.plot.as_deref().map(Picture::of).transpose()?;
    let resolved = target::read(arguments)?;
    let mut outputs = Outputs::open(arguments, &resolved, picture)?;
    let threads = threads::count(arguments.threads, resolved.scenario.fleet.len());
    let mut run = start(&resolved)?;
    run.set_parallel(threads > 1);
    let shown = !arguments.quiet && !arguments.json;
    let progress = Progress::new(shown, resolved.scenario.duration);
    let stop = stop_on_interrupt();
    let begun = Instant::now();
    let driven = threads::with(threads, || drive(&mut run, &mut outputs, &progress, &stop))?;
    let wall_seconds = begun.elapsed().as_secs_f64();
    progress.clear();
    driven?;
    let report = Report::of(
        &run,
        Circumstances {
            target: arguments.target.clone(),
            replay: command_line(arguments, resolved.scenario.seed),
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
    tell(arguments, &report);
    Ok(report.is_success())
}

/// A run of what was read, at its start.
pub fn start(resolved: &Resolved) -> Result<Run, Failure> {
    starl_catalog::run(resolved.scenario.clone()).map_err(|error| {
        let field = format!("robots.{}.program", error.group);
        resolved.problem(&field, &error.message, None).into()
    })
}

/// Lets the run go on to its end, or until someone stops it.
fn drive(
    run: &mut Run,
    outputs: &mut Outputs,
    progress: &Progress,
    stop: &AtomicBool,
) -> Result<(), Failure> {
    while !run.is_over() && !stop.load(Ordering::Relaxed) {
        for record in run.step() {
            if let Some(trace) = &mut outputs.trace {
                trace
                    .writer
                    .write(record)
                    .map_err(|error| trace.output.failure(&error))?;
            }
            if let Some(plot) = &mut outputs.plot {
                plot.paths.observe(record);
            }
        }
        progress.advance(run.simulation().now());
    }
    Ok(())
}

/// Set when someone presses Ctrl-C; the second time ends the process at once.
fn stop_on_interrupt() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = stop.clone();
    // Without a handler Ctrl-C still ends the process, only less kindly.
    let _ = ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
    stop
}

fn tell(arguments: &RunArguments, report: &Report) {
    if arguments.json {
        json::print(report);
    } else if arguments.quiet {
        console::print(&summary::violations(report));
    } else {
        console::print(&summary::text(report));
    }
}

/// The kinds of picture.
#[derive(Clone, Copy)]
enum Picture {
    Svg,
    #[cfg(feature = "png")]
    Png,
}

impl Picture {
    fn of(path: &Path) -> Result<Picture, Failure> {
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("svg") => Ok(Picture::Svg),
            #[cfg(feature = "png")]
            Some("png") => Ok(Picture::Png),
            #[cfg(not(feature = "png"))]
            Some("png") => Err(Failure(format!(
                "--plot {}: this build draws no PNG; name a file ending in .svg",
                path.display()
            ))),
            _ => Err(Failure(format!(
                "--plot {}: the name must end in .svg or .png",
                path.display()
            ))),
        }
    }
}

/// What is written besides the summary.
struct Outputs {
    trace: Option<TraceOutput>,
    plot: Option<PlotOutput>,
}

struct TraceOutput {
    output: Output,
    writer: Writer<File>,
}

struct PlotOutput {
    output: Output,
    file: File,
    picture: Picture,
    paths: Paths,
}

impl Outputs {
    fn open(
        arguments: &RunArguments,
        resolved: &Resolved,
        picture: Option<Picture>,
    ) -> Result<Outputs, Failure> {
        if arguments.trace.is_some() && arguments.trace == arguments.plot {
            return Err(Failure(
                "--trace and --plot name the same file; name two".to_string(),
            ));
        }
        let trace = |path: &PathBuf| -> Result<TraceOutput, Failure> {
            let (output, file) = Output::create(path)?;
            let header = recording::header(resolved);
            let writer = Writer::new(file, &header, &ViewOptions::default())
                .map_err(|error| output.failure(&error))?;
            Ok(TraceOutput { output, writer })
        };
        let plot = |(path, picture): (&PathBuf, Picture)| -> Result<PlotOutput, Failure> {
            let (output, file) = Output::create(path)?;
            Ok(PlotOutput {
                output,
                file,
                picture,
                paths: Paths::new(&resolved.scenario),
            })
        };
        Ok(Outputs {
            trace: arguments.trace.as_ref().map(trace).transpose()?,
            plot: arguments.plot.as_ref().zip(picture).map(plot).transpose()?,
        })
    }

    fn finish(self, run: &Run, report: &Report) -> Result<(), Failure> {
        if let Some(TraceOutput { output, writer }) = self.trace {
            let simulation = run.simulation();
            let outcome = Outcome {
                outcome: report.outcome.word().to_string(),
                digest: simulation.digest().value(),
                end: simulation.now(),
            };
            writer
                .finish(&outcome)
                .map_err(|error| output.failure(&error))?;
            output.commit()?;
        }
        if let Some(PlotOutput {
            output,
            file,
            picture,
            paths,
        }) = self.plot
        {
            let data = paths.finish(report);
            let content = match picture {
                Picture::Svg => plot::svg(&data).into_bytes(),
                #[cfg(feature = "png")]
                Picture::Png => plot::png(&data),
            };
            output.write(file, &content)?;
        }
        Ok(())
    }
}

impl Output {
    fn failure(&self, error: &WriteError) -> Failure {
        Failure::file(self.path(), error)
    }
}

/// A command line that does the same run again.
fn command_line(arguments: &RunArguments, seed: u64) -> String {
    let mut words = vec![
        "starl".to_string(),
        "run".to_string(),
        quoted(&arguments.target),
    ];
    let mut option = |name: &str, value: &str| {
        words.push(name.to_string());
        words.push(quoted(value));
    };
    if let Some(robots) = &arguments.robots {
        option("--robots", robots);
    }
    option("--seed", &seed.to_string());
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
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_=.,/:+@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        return word.to_string();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}
