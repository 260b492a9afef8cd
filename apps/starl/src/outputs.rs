//! What a run writes besides its summary: a trace and a picture.

use crate::args::RunArguments;
use crate::failure::Failure;
use crate::output::{Output, identity};
use crate::paths::Paths;
use crate::report::Report;
use crate::{plot, recording};
use starl_core::Record;
use starl_properties::Setting;
use starl_sim::Run;
use starl_sim::read::Resolved;
use starl_trace::{Outcome, ViewOptions, WriteError, Writer};
use std::fs::File;
use std::path::{Path, PathBuf};

/// The kinds of picture.
#[derive(Clone, Copy)]
pub enum Picture {
    Svg,
    #[cfg(feature = "png")]
    Png,
}

impl Picture {
    /// The kind that a file is to hold, by its name.
    pub fn of(path: &Path) -> Result<Picture, Failure> {
        Picture::given_as(path, "--plot")
    }

    /// The same for a file that another option names.
    pub fn given_as(path: &Path, option: &str) -> Result<Picture, Failure> {
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("svg") => Ok(Picture::Svg),
            #[cfg(feature = "png")]
            Some("png") => Ok(Picture::Png),
            #[cfg(not(feature = "png"))]
            Some("png") => Err(Failure(format!(
                "{option} {}: this build draws no PNG; name a file ending in .svg",
                path.display()
            ))),
            _ => Err(Failure(format!(
                "{option} {}: the name must end in .svg or .png",
                path.display()
            ))),
        }
    }
}

/// The files being written.
pub struct Outputs {
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
    /// Opens what the arguments ask for; `read` are the files that the run was read from.
    pub fn open(
        arguments: &RunArguments,
        resolved: &Resolved,
        setting: &Setting,
        read: &[PathBuf],
        picture: Option<Picture>,
    ) -> Result<Outputs, Failure> {
        refuse_to_overwrite(arguments, read)?;
        let trace = |path: &PathBuf| -> Result<TraceOutput, Failure> {
            let (output, file) = Output::create(path)?;
            let header = recording::header(resolved, setting);
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

    /// Takes in what happened next.
    pub fn observe(&mut self, record: &Record) -> Result<(), Failure> {
        if let Some(TraceOutput { output, writer }) = &mut self.trace {
            writer
                .write(record)
                .map_err(|error| output.failure(&error))?;
        }
        if let Some(plot) = &mut self.plot {
            plot.paths.observe(record);
        }
        Ok(())
    }

    /// Completes the files and gives them their names.
    pub fn finish(self, run: &Run, report: &Report) -> Result<(), Failure> {
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

/// Whether the outputs are files of their own: not one another, and nothing that was read.
fn refuse_to_overwrite(arguments: &RunArguments, read: &[PathBuf]) -> Result<(), Failure> {
    let trace = arguments.trace.as_deref().map(identity);
    let plot = arguments.plot.as_deref().map(identity);
    if trace.is_some() && trace == plot {
        return Err(Failure(
            "--trace and --plot name the same file; name two".to_string(),
        ));
    }
    for path in read {
        let is_read = identity(path);
        for (option, written) in [("--trace", &trace), ("--plot", &plot)] {
            if written.as_ref() == Some(&is_read) {
                return Err(Failure(format!(
                    "{option} {}: the run reads this file; name another to write to",
                    path.display()
                )));
            }
        }
    }
    Ok(())
}

impl Output {
    fn failure(&self, error: &WriteError) -> Failure {
        Failure::file(self.path(), error)
    }
}
