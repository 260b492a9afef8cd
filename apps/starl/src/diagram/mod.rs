//! `starl diagram`: the messages of a run as a space-time diagram (Lamport 1978, figure 1).
//!
//! A line for each robot, time to the right; messages are arrows from line to line, lost ones end in a
//! cross; what primitives and programs report are marks; robots that are down, and partitions, are shaded.
//! The same drawing explains what `starl test` finds.

mod axis;
mod scene;
mod story;
#[cfg(test)]
mod tests;

use crate::args::{ChangeArguments, DiagramArguments};
use crate::console;
use crate::failure::Failure;
use crate::output::{Output, identity};
use crate::picture::Picture;
use crate::plot;
use crate::plot::drawing::Drawing;
use crate::replay::{inputs, open, unreadable};
use crate::target::{self, Selection};
use starl_catalog::Application;
use starl_catalog::programs::Registry;
use starl_core::{Duration, Record, Time};
use std::path::Path;
use story::Story;

/// Which part of a run is drawn.
#[derive(Clone, Copy, Debug, Default)]
pub struct Extent {
    /// How long it is; as long as is easy to read, if none is given.
    pub last: Option<Duration>,
    /// Where it ends: at the first violation, or else with the run, if nothing is given.
    pub until: Option<Time>,
}

/// A drawing of a run.
pub struct Diagram(Drawing);

impl Diagram {
    /// As SVG.
    pub fn svg(&self) -> Vec<u8> {
        plot::file(&self.0, Picture::Svg)
    }
}

/// Draws what the arguments say.
pub fn diagram(arguments: &DiagramArguments, registry: &Registry) -> Result<bool, Failure> {
    let picture = Picture::given_as(&arguments.out, "--out")?;
    let span =
        |option: &str, text: Option<&str>| text.map(|text| target::span(option, text)).transpose();
    let extent = Extent {
        last: span("--last", arguments.last.as_deref())?,
        until: span("--until", arguments.until.as_deref())?.map(|span| Time::ZERO + span),
    };
    let (output, file) = Output::create(&arguments.out)?;
    let target = Path::new(&arguments.target);
    let Diagram(drawing) = if target.extension().is_some_and(|suffix| suffix == "mcap") {
        refuse_to_overwrite(&arguments.out, target)?;
        if arguments.seed.is_some() || arguments.changes != ChangeArguments::default() {
            let message = "is drawn as it was recorded; --seed, --scenario, --robots, --duration, --set and --faults \
                           are for runs";
            return Err(Failure::file(target, message));
        }
        of_trace(target, &extent, registry)?
    } else {
        let seed = arguments.seed.clone();
        let selection = target::read(
            &arguments.changes.of(&arguments.target, seed, false),
            registry,
        )?;
        let Selection {
            application, files, ..
        } = selection;
        for path in &files {
            refuse_to_overwrite(&arguments.out, path)?;
        }
        of_run(&application, &extent)?
    };
    output.write(file, &plot::file(&drawing, picture))?;
    console::print(&format!("{}\n", arguments.out.display()))?;
    Ok(true)
}

/// A run of a scenario.
pub fn of_run(application: &Application, extent: &Extent) -> Result<Diagram, Failure> {
    let mut run = crate::run::start(application)?;
    let mut story = Story::of(application.scenario());
    while !run.is_over() && !story.is_past(extent) {
        for record in run.step() {
            story.observe(record);
        }
    }
    Ok(Diagram(scene::draw(&story, extent)))
}

/// Events that are at hand, in the order in which they happened.
pub fn of_records(application: &Application, records: &[Record]) -> Diagram {
    let mut story = Story::of(application.scenario());
    records.iter().for_each(|record| story.observe(record));
    let end = records.last().map_or(Time::ZERO, |record| record.at);
    let extent = Extent {
        last: Some(end.since(Time::ZERO)),
        until: Some(end),
    };
    Diagram(scene::draw(&story, &extent))
}

/// A run as a trace tells it.
fn of_trace(path: &Path, extent: &Extent, registry: &Registry) -> Result<Diagram, Failure> {
    let mut reader = open(path)?;
    let application = inputs(path, reader.header(), registry)?;
    let mut story = Story::of(application.scenario());
    for record in &mut reader {
        match record {
            Ok(record) => story.observe(&record),
            Err(error) if error.is_missing_end() => {
                let path = path.display();
                console::complain(&format!(
                    "{path}: the trace is incomplete, and its readable part is drawn: {error}\n"
                ));
                break;
            }
            Err(error) => return Err(unreadable(path, &error)),
        }
        if story.is_past(extent) {
            break;
        }
    }
    Ok(Diagram(scene::draw(&story, extent)))
}

fn refuse_to_overwrite(out: &Path, read: &Path) -> Result<(), Failure> {
    match identity(out) == identity(read) {
        true => Err(Failure(format!(
            "--out {}: the drawing is made from this file; name another to write to",
            out.display()
        ))),
        false => Ok(()),
    }
}
