//! Opens a scenario with its programs from files in memory: chooses the scenario and the program, and applies the
//! changes.

use super::diagnostic::{Diagnostic, SCENARIO_SUFFIX};
use super::files::{Beside, Files};
use crate::examples::{self, DEFAULT_SCENARIO, EXAMPLES, Example};
use crate::language::SUFFIX;
use crate::programs::Registry;
use crate::{Application, read};
use serde::{Deserialize, Serialize};
use starl_lang::check::{NoLibraries, check};
use starl_sim::engine::InterventionError;
use starl_sim::read::{Override, Problem, Request, Source, suggest};
use starl_trace::WriteError;
use std::collections::BTreeMap;

/// The target to open, and changes of it. Each corresponds to an option of `starl run`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Options {
    /// The path of a scenario among the files, or an example's name. By default the only scenario among the
    /// files; if there is none, an empty floor with a few robots.
    pub scenario: Option<String>,
    /// The path of a program, or the name of one in Rust, that replaces the scenario's. If there is no scenario, by
    /// default the only program among the files.
    pub program: Option<String>,
    /// Another seed, a whole number as text.
    pub seed: Option<String>,
    /// Another duration, as `30s`.
    pub duration: Option<String>,
    /// Another fleet: `create=2,drone=2`.
    pub robots: Option<String>,
    /// Fields of the scenario to set: `network.loss=0.2`.
    pub set: Vec<String>,
    /// The path of a file with faults to add.
    pub faults: Option<String>,
}

/// Why files cannot be opened.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Refused {
    /// The whole as one text.
    pub message: String,
    /// The single problems, warnings included; none where files or options are not as they should be.
    pub diagnostics: Vec<Diagnostic>,
}

impl From<String> for Refused {
    fn from(message: String) -> Refused {
        Refused {
            message,
            diagnostics: Vec::new(),
        }
    }
}

/// An error that concerns no place in a file.
macro_rules! plain {
    ($($error:ty),*) => {$(
        impl From<$error> for Refused {
            fn from(error: $error) -> Refused {
                error.to_string().into()
            }
        }
    )*};
}

plain!(Problem, InterventionError, WriteError);

/// The opened target.
pub(crate) struct Opened {
    pub application: Application,
    /// The path that names of files in the scenario start from.
    pub path: String,
    /// The names that programs have everywhere, by those that they have here.
    pub global_names: BTreeMap<String, String>,
    /// The warnings of the compiler.
    pub warnings: Vec<Diagnostic>,
}

/// Reads the scenario that the options name, with its programs.
pub(crate) fn open(
    files: &Files,
    options: &Options,
    registry: &Registry,
) -> Result<Opened, Refused> {
    let (source, example) = scenario(files, options)?;
    let is_default = source.name == DEFAULT_NAME && example.is_none();
    let path = match example.is_some() || is_default {
        true => String::new(),
        false => source.name.clone(),
    };
    let beside = match example {
        Some(example) => Beside::example(files, example),
        None => Beside::new(files, &path),
    };
    let mut overrides = Vec::new();
    let program = match &options.program {
        None if is_default => Some(only_program(files)?),
        named => named.clone(),
    };
    if let Some(program) = program {
        let key = match files.has(&program) {
            true => beside.name(&program),
            false => program,
        };
        let change = |field, value: &str| Override::named("program", field, value);
        overrides.push(change("program", &key));
        // The scenario's parameters were meant for its own program.
        if !names(&source, &beside, &key) {
            overrides.push(change("parameters", "{}"));
        }
        if is_default {
            let stem = key.rsplit('/').next().unwrap_or(&key);
            let stem = stem.strip_suffix(SUFFIX).unwrap_or(stem);
            overrides.push(change("title", &format!("'{}'", stem.replace('\'', " "))));
        }
    }
    for assignment in &options.set {
        overrides.push(Override::set(assignment)?);
    }
    let mut set = |name: &str, value: &Option<String>| {
        overrides.extend(value.iter().map(|value| Override::named(name, name, value)));
    };
    set("seed", &options.seed);
    set("duration", &options.duration);
    let faults = options.faults.as_ref().map(|path| {
        let text = files.text(path);
        text.map(|text| Source::new(path, text))
            .map_err(|reason| format!("{path}: {reason}"))
    });
    let request = Request {
        overrides,
        robots: options.robots.clone(),
        faults: faults.transpose()?,
        ..Request::new(source.clone())
    };
    match read(&request, &beside, registry) {
        Ok(application) => Ok(Opened {
            warnings: Diagnostic::of_warnings(&application, &beside),
            application,
            path: path.clone(),
            global_names: example.map_or(BTreeMap::new(), |example| {
                let own = example.programs().filter(|own| !files.has(own));
                own.map(|own| (own.to_string(), example.global_name(own)))
                    .collect()
            }),
        }),
        Err(refusal) => Err(Refused {
            message: refusal.to_string().trim_end().to_string(),
            diagnostics: Diagnostic::of_refusal(refusal, &beside),
        }),
    }
}

const DEFAULT_NAME: &str = "the default scenario";

fn scenario(
    files: &Files,
    options: &Options,
) -> Result<(Source, Option<&'static Example>), Refused> {
    let text = |path: &str| match files.text(path) {
        Ok(text) => Ok((Source::new(path, text), None)),
        Err(reason) => Err(format!("{path}: {reason}").into()),
    };
    if let Some(name) = &options.scenario {
        return match (files.has(name), examples::find(name)) {
            (true, _) => text(name),
            (false, Some(example)) => Ok((example.source(), Some(example))),
            (false, None) => {
                let names: Vec<&str> = EXAMPLES.iter().map(|example| example.name).collect();
                let help = suggest::help(name, &names, "the examples are").unwrap_or_default();
                Err(format!("{name}: there is no file or example called this; {help}").into())
            }
        };
    }
    let all: Vec<&str> = files
        .ending_with(SCENARIO_SUFFIX)
        .filter(|&path| options.faults.as_deref() != Some(path))
        .collect();
    match all[..] {
        [] => Ok((Source::new(DEFAULT_NAME, DEFAULT_SCENARIO), None)),
        [path] => text(path),
        _ => {
            let all = all.join(", ");
            Err(format!("there are several scenarios; set `scenario` to one of {all}").into())
        }
    }
}

/// The only program among the files that is not a library.
fn only_program(files: &Files) -> Result<String, Refused> {
    let is_program = |path: &&str| {
        let text = files.text(path).unwrap_or_default();
        !check(text, &NoLibraries).program.is_library
    };
    let all: Vec<&str> = files.ending_with(SUFFIX).filter(is_program).collect();
    match all[..] {
        [] => {
            let message = "there is neither a scenario nor a program among the files";
            Err(message.to_string().into())
        }
        [path] => Ok(path.to_string()),
        _ => {
            let all = all.join(", ");
            Err(format!("there are several programs; set `program` to one of {all}").into())
        }
    }
}

/// Whether some group of the scenario names this program already.
fn names(source: &Source, beside: &Beside<'_>, key: &str) -> bool {
    // The problems of the scenario are reported when it is opened.
    let read = starl_sim::read::scenario(&Request::new(source.clone()), beside);
    read.is_ok_and(|read| {
        let mut groups = read.scenario.fleet.groups.iter();
        groups.any(|group| group.program == key)
    })
}
