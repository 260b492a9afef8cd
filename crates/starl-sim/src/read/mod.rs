//! Reads a scenario: a TOML text, the files that it names, and the changes of the command line.
//!
//! Invariant: a returned scenario is complete and consistent, so the engine need not check it. Every problem is
//! reported with file, line and field; no input is ignored or clamped. This module reads no files: a [`Loader`]
//! provides those that the scenario names, and their contents are kept, so that [`again`] reads the same scenario
//! without it.

mod change;
mod contents;
mod curve;
mod event;
mod fault;
mod fleet;
mod grid;
mod inputs;
mod names;
mod network;
mod obstacle;
mod occupancy;
mod order;
mod parameter;
mod place;
mod placing;
mod reach;
mod robots_option;
pub mod schema;
mod settings;
mod start;
mod world;
mod world_file;

pub use crate::fields::{OneLine, Place, Problem, Problems, Quantity, suggest};
pub use inputs::{Content, Inputs, Loader, Override, Request, Source};

use crate::Scenario;
use crate::fields::schema::Dimension;
use crate::fields::{path, report, section, tree, value};
use inputs::Recorder;
use path::Path;
use report::{Origin, Report};
use section::Section;
use starl_core::Duration;
use std::collections::BTreeMap;
use tree::{Node, Table, Value};

/// A scenario that was read.
#[derive(Clone, Debug)]
pub struct Resolved {
    /// The scenario.
    pub scenario: Scenario,
    /// All inputs that it was read from.
    pub inputs: Inputs,
    places: BTreeMap<String, Place>,
}

/// Whether a text is a number with a unit that is known.
pub(crate) fn is_quantity(text: &str) -> bool {
    parameter::quantity(text).is_some()
}

/// A duration in the form of scenarios, `250ms`; none if the text is invalid.
pub fn duration(text: &str) -> Option<Duration> {
    let (dimension, seconds) = Quantity::split(text)?.in_si()?;
    let is_span = dimension == Dimension::Time && seconds >= 0.0 && seconds.is_finite();
    is_span.then(|| Duration::from_seconds_f64(seconds))
}

/// Reads a scenario.
///
/// # Errors
/// All problems of the scenario.
pub fn scenario(request: &Request, loader: &dyn Loader) -> Result<Resolved, Problems> {
    let files = Recorder::new(loader);
    let report = Report::default();
    let Some(root) = assemble(request, &report) else {
        return Err(failure(report));
    };
    let path = Path::ROOT;
    let section = Section::root(&root, &path, schema::SCENARIO, &report);
    let scenario = settings::read(section, request, &files);
    let mut places = BTreeMap::new();
    note_places(&root, "", &report, &mut places);
    let scenario = match scenario {
        Some(scenario) => report.finish(scenario)?,
        None => return Err(failure(report)),
    };
    let inputs = Inputs {
        request: request.clone(),
        files: files.brought(),
    };
    Ok(Resolved {
        scenario,
        inputs,
        places,
    })
}

/// Reads a scenario again from its recorded inputs.
///
/// # Errors
/// All problems of the inputs, if they were changed or come from another version.
pub fn again(inputs: &Inputs) -> Result<Resolved, Problems> {
    scenario(&inputs.request, inputs)
}

impl Resolved {
    /// Keeps one more file that the scenario leads to, such as its program, among the inputs, so that
    /// the scenario can be read again without the loader that brought it.
    pub fn keep(&mut self, path: &str, bytes: &[u8]) {
        let content = Content::of(bytes);
        self.inputs.files.insert(path.to_string(), content);
    }

    /// A problem with a field that only a host can see, such as a program it does not know; blamed
    /// on the place where the field, or else the table around it, was written.
    pub fn problem(&self, field: &str, message: &str, help: Option<&str>) -> Problem {
        let mut path = field;
        let place = loop {
            if let Some(place) = self.places.get(path) {
                break place.clone();
            }
            path = path.rsplit_once('.').map_or("", |(above, _)| above);
            if path.is_empty() {
                let name = self.inputs.request.source.name.clone();
                break Place::File {
                    name,
                    line: 1,
                    column: 1,
                };
            }
        };
        let (field, message) = (field.to_string(), message.to_string());
        Problem {
            place,
            field,
            message,
            help: help.map(str::to_string),
        }
    }
}

/// The tree of the scenario with everything that the request changes of it; none if the text is not
/// even TOML.
fn assemble(request: &Request, report: &Report) -> Option<Node> {
    let Source { name, text } = &request.source;
    let root = tree::parse_document(text, report.file(name, text), report);
    let faults = request
        .faults
        .as_ref()
        .map(|Source { name, text }| tree::parse_document(text, report.file(name, text), report));
    let mut root = root?;
    if let Some(faults) = faults {
        change::add_faults(&mut root, faults?, report);
    }
    for change in &request.overrides {
        let origin = report.option(&change.option);
        change::set(&mut root, &change.path, &change.value, origin, report);
    }
    Some(root)
}

/// The problems of an input that could not be read to its end.
fn failure(report: Report) -> Problems {
    match report.finish(()) {
        Err(problems) => problems,
        Ok(()) => unreachable!("reading ends early only after a problem is reported"),
    }
}

/// Notes where each field was written, so that hosts can blame it too.
fn note_places(node: &Node, path: &str, report: &Report, places: &mut BTreeMap<String, Place>) {
    let below = |name: &str| {
        if path.is_empty() {
            name.to_string()
        } else {
            format!("{path}.{name}")
        }
    };
    match &node.value {
        Value::Table(table) => {
            for (name, entry) in table as &Table {
                note_places(&entry.node, &below(name), report, places);
            }
        }
        Value::List(list) if list.len() <= LONGEST_NOTED => {
            for (index, node) in list.iter().enumerate() {
                note_places(node, &below(&index.to_string()), report, places);
            }
        }
        _ => {}
    }
    if !path.is_empty() {
        places.insert(path.to_string(), report.place(node.origin));
    }
}

/// Elements of longer lists are not noted one by one: those are coordinates, not fields.
const LONGEST_NOTED: usize = 64;

/// Something with the place it was written at, for checks that come later.
#[derive(Clone, Debug)]
struct Placed<T> {
    value: T,
    origin: Origin,
    field: String,
}

impl<T> Placed<T> {
    /// A value of a world file, which has no fields.
    fn in_file(origin: Origin, value: T) -> Placed<T> {
        Placed {
            value,
            origin,
            field: String::new(),
        }
    }

    /// A value that was written in this field.
    fn at(table: Section<'_>, field: &str, value: T) -> Placed<T> {
        Placed {
            value,
            origin: table.origin_of(field),
            field: table.path_of(field),
        }
    }
}
