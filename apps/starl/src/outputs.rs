//! The files of a run besides its summary: a trace and a picture.

use crate::args::RunArguments;
use crate::failure::Failure;
use crate::output::{Output, identity};
use crate::paths::Paths;
use crate::picture::Picture;
use crate::plot;
use crate::report::Report;
use crate::trace_output::TraceOutput;
use starl_core::Record;
use starl_properties::Setting;
use starl_sim::read::Resolved;
use starl_sim::{Run, Simulation};
use starl_trace::Outcome;
use std::fs::File;
use std::path::{Path, PathBuf};

/// The files being written.
pub struct Outputs {
    trace: Option<TraceOutput>,
    plot: Option<PlotOutput>,
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
        let named = [
            ("--trace", arguments.trace.as_deref()),
            ("--plot", arguments.plot.as_deref()),
        ];
        refuse_to_overwrite(&named, read)?;
        let plot = |(path, picture): (&PathBuf, Picture)| -> Result<PlotOutput, Failure> {
            let (output, file) = Output::create(path)?;
            Ok(PlotOutput {
                output,
                file,
                picture,
                paths: Paths::new(&resolved.scenario),
            })
        };
        let plot = arguments.plot.as_ref().zip(picture).map(plot).transpose()?;
        // Last, since it takes the place of what was there at once.
        let trace = arguments.trace.as_deref();
        let trace =
            trace.map(|path| TraceOutput::create(path, resolved, setting, arguments.inputs));
        Ok(Outputs {
            trace: trace.transpose()?,
            plot,
        })
    }

    /// Adds the next record.
    pub fn observe(&mut self, record: &Record) -> Result<(), Failure> {
        if let Some(trace) = &mut self.trace {
            trace.write(record)?;
        }
        if let Some(plot) = &mut self.plot {
            plot.paths.observe(record);
        }
        Ok(())
    }

    /// Adds the state of the run after a step, when all records of the step have been observed.
    pub fn advance(&mut self, simulation: &Simulation) -> Result<(), Failure> {
        match &mut self.trace {
            Some(trace) => trace.advance(simulation.journal(), simulation.now()),
            None => Ok(()),
        }
    }

    /// Completes the files.
    pub fn finish(self, run: &Run, report: &Report) -> Result<(), Failure> {
        if let Some(trace) = self.trace {
            let simulation = run.simulation();
            let outcome = Outcome {
                outcome: report.outcome.word().to_string(),
                digest: simulation.digest().value(),
                end: simulation.now(),
            };
            trace.finish(&outcome)?;
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

/// Whether the outputs, each with its option, are files of their own: not one another, and nothing that was read.
pub fn refuse_to_overwrite(
    outputs: &[(&str, Option<&Path>)],
    read: &[PathBuf],
) -> Result<(), Failure> {
    let outputs = outputs.iter();
    let outputs = outputs.filter_map(|(option, path)| Some((*option, identity((*path)?))));
    let outputs: Vec<(&str, PathBuf)> = outputs.collect();
    for (index, (option, path)) in outputs.iter().enumerate() {
        if let Some((other, _)) = outputs[..index].iter().find(|(_, other)| other == path) {
            return Err(Failure(format!(
                "{other} and {option} name the same file; name two"
            )));
        }
    }
    for path in read {
        let is_read = identity(path);
        if let Some((option, _)) = outputs.iter().find(|(_, written)| *written == is_read) {
            return Err(Failure(format!(
                "{option} {}: the run reads this file; name another to write to",
                path.display()
            )));
        }
    }
    Ok(())
}
