//! Finds the target of `starl run TARGET`, and reads it with the changes of the command line.

use crate::args::RunArguments;
use crate::console;
use crate::failure::Failure;
use crate::origin::Origin;
use starl_catalog::disk;
use starl_catalog::examples::{self, DEFAULT_SCENARIO, EXAMPLES};
use starl_catalog::language::{Findings, SUFFIX};
use starl_catalog::programs::Registry;
use starl_catalog::{Application, Refusal};
use starl_core::{Duration, FileError, file};
use starl_sim::read::{Inputs, Override, Request, Source, suggest};
use std::path::{Path, PathBuf};

/// The target: a scenario, perhaps with another program.
struct Target {
    scenario: Source,
    /// Where the files that it names come from.
    origin: Origin,
    /// The replacement of the scenario's own program, by the command line.
    program: Option<PathBuf>,
}

/// The target that was read, and its source.
pub struct Selection {
    /// The scenario and its programs, checked to the last field.
    pub application: Application,
    /// The files on disk that it was read from.
    pub files: Vec<PathBuf>,
    /// The origin of the files that the scenario names.
    pub origin: Origin,
}

/// Reads what the arguments name.
pub fn read(arguments: &RunArguments, registry: &Registry) -> Result<Selection, Failure> {
    let Target {
        scenario,
        origin,
        program,
    } = find(arguments)?;
    let faults = match &arguments.faults {
        Some(path) => Some(Source::new(path.display().to_string(), text(path)?)),
        None => None,
    };
    let key = program.as_deref().map(|program| origin.key(program));
    let mut overrides = match &key {
        Some(key) => replacing(&arguments.target, key, &scenario, &origin),
        None => Vec::new(),
    };
    overrides.extend(changes(arguments)?);
    let request = Request {
        overrides,
        robots: arguments.robots.clone(),
        faults,
        ..Request::new(scenario)
    };
    let application = starl_catalog::read(&request, &origin, registry)
        .map_err(|refusal| tell(&refusal, |findings| origin.name(findings)))?;
    if let Some(key) = key {
        check_that_it_runs(&arguments.target, &key, &application)?;
    }
    if !arguments.quiet {
        warn(&application, &origin);
    }
    let files = files(arguments, &origin, &application.resolved().inputs);
    Ok(Selection {
        application,
        files,
        origin,
    })
}

/// The files on disk that a run was read from; none of an example's, which are part of the command.
fn files(arguments: &RunArguments, origin: &Origin, inputs: &Inputs) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = arguments.faults.iter().cloned().collect();
    files.extend(inputs.files.keys().filter_map(|path| origin.path(path)));
    files.extend(origin.scenario().map(Path::to_path_buf));
    files
}

/// Prints each warning once.
fn warn(application: &Application, origin: &Origin) {
    for findings in application.warnings() {
        let text = findings.render(&origin.name(findings), console::colour_of_errors());
        console::complain(&text);
    }
    for (field, reason) in application.scenario().idle_fields() {
        console::complain(&format!("warning: {field}: {reason}\n"));
    }
}

/// Prints the errors of programs, each with its lines; the failure sums them up.
pub fn refused(refusal: Refusal) -> Failure {
    tell(&refusal, |findings| findings.name.clone())
}

/// The same, where `name` is what a file is called.
pub fn tell(refusal: &Refusal, name: impl Fn(&Findings) -> String) -> Failure {
    let mut sums = Vec::new();
    for findings in refusal.broken_files() {
        let name = name(findings);
        console::complain(&findings.render(&name, console::colour_of_errors()));
        let errors = console::counted(findings.errors(), "error");
        sums.push(format!("{name}: {errors}"));
    }
    sums.extend(refusal.problems.iter().map(ToString::to_string));
    Failure(sums.join("\n"))
}

/// Puts a program in place of the scenario's own. The scenario's parameters were meant for that, so they go with it.
fn replacing(target: &str, key: &str, scenario: &Source, origin: &Origin) -> Vec<Override> {
    let mut overrides = vec![Override::named(target, "program", key)];
    if !names(scenario, origin, key) {
        overrides.push(Override::named(target, "parameters", "{}"));
    }
    if origin.is_default() {
        let title = Path::new(key).file_stem().unwrap_or_default();
        let title = format!("'{}'", title.display());
        overrides.push(Override::named(target, "title", &title));
    }
    overrides
}

/// Whether some group of the scenario names this program already.
fn names(scenario: &Source, origin: &Origin, key: &str) -> bool {
    // Errors of the scenario are reported when it is read completely.
    let read = starl_sim::read::scenario(&Request::new(scenario.clone()), origin);
    read.is_ok_and(|read| {
        let mut groups = read.scenario.fleet.groups.iter();
        groups.any(|group| group.program == key)
    })
}

/// Refuses a program that no robot would run: every group of the scenario names another.
fn check_that_it_runs(target: &str, key: &str, application: &Application) -> Result<(), Failure> {
    let groups = &application.scenario().fleet.groups;
    if groups.iter().any(|group| group.program == key) {
        return Ok(());
    }
    let scenario = &application.resolved().inputs.request.source.name;
    Err(Failure(format!(
        "{target}: no robot of {scenario} would run this: all its groups name programs of their own; \
         take another scenario, or name it with --set robots.0.program={key}"
    )))
}

/// The changes that the command line makes, in the order of their power: the options with names of
/// their own come last.
fn changes(arguments: &RunArguments) -> Result<Vec<Override>, Failure> {
    let mut overrides = Vec::new();
    for assignment in &arguments.set {
        overrides.push(Override::set(assignment)?);
    }
    if let Some(seed) = &arguments.seed {
        overrides.push(Override::named("--seed", "seed", seed));
    }
    if let Some(duration) = &arguments.duration {
        overrides.push(Override::named("--duration", "duration", duration));
    }
    Ok(overrides)
}

fn find(arguments: &RunArguments) -> Result<Target, Failure> {
    let target = arguments.target.as_str();
    if target.ends_with(SUFFIX) && examples::find(target).is_none() {
        return with_program(arguments);
    }
    if arguments.scenario.is_some() {
        return Err(Failure(format!(
            "--scenario: {target} is a scenario itself; name a program, a file ending in {SUFFIX}"
        )));
    }
    let (scenario, origin) = scenario(target)?;
    Ok(Target {
        scenario,
        origin,
        program: None,
    })
}

/// A program with the scenario that is named, or else lies beside it, or else the one that is there
/// for all.
fn with_program(arguments: &RunArguments) -> Result<Target, Failure> {
    let program = PathBuf::from(&arguments.target);
    // A message about a program that cannot be read is to name it and not its scenario.
    text(&program)?;
    let beside = program.with_extension("toml");
    let (source, origin) = match &arguments.scenario {
        Some(named) => scenario(named)?,
        None if beside.is_file() => scenario(&beside.display().to_string())?,
        None => (
            Source::new("the default scenario", DEFAULT_SCENARIO),
            Origin::none(),
        ),
    };
    if arguments.scenario.is_none() && !arguments.quiet {
        console::complain(&format!("scenario: {}\n", source.name));
    }
    Ok(Target {
        scenario: source,
        origin: origin.with_program(&program),
        program: Some(program),
    })
}

/// The scenario of an example, or one in a file.
fn scenario(name: &str) -> Result<(Source, Origin), Failure> {
    if let Some(example) = examples::find(name) {
        return Ok((example.source(), Origin::example(example)));
    }
    let path = Path::new(name);
    if !path.exists() {
        return Err(no_example(name, "scenario file"));
    }
    if path.is_dir() {
        return Err(Failure::file(
            path,
            "is a folder; name the scenario file in it",
        ));
    }
    Ok((Source::new(name, text(path)?), Origin::file(path)))
}

/// Neither an example nor a file of the other kind goes by this name. A path names no example.
pub fn no_example(name: &str, other: &str) -> Failure {
    let path = Path::new(name);
    if name.contains('/') || path.extension().is_some() {
        return unreadable(path, &FileError::Missing);
    }
    let beside = ["toml", "starl"].map(|extension| path.with_extension(extension));
    if let Some(file) = beside.iter().find(|file| file.exists()) {
        return Failure(format!(
            "{name}: there is no example called this; did you mean the file {}?",
            file.display()
        ));
    }
    let names: Vec<&str> = EXAMPLES.iter().map(|example| example.name).collect();
    let help = suggest::help(name, &names, "the examples are");
    let help = help.unwrap_or_else(|| format!("`{} list` names the examples", console::command()));
    Failure(format!(
        "{name}: there is no example or {other} called this; {help}"
    ))
}

/// A time as scenarios have it, from an option.
pub fn span(option: &str, text: &str) -> Result<Duration, Failure> {
    starl_sim::read::duration(text).ok_or_else(|| {
        Failure(format!(
            "{option} {text}: is not a time; write one such as 500ms or 2s"
        ))
    })
}

/// How traces begin, as all files in MCAP do.
const TRACE: &[u8] = b"\x89MCAP";

/// The text of a file.
pub fn text(path: &Path) -> Result<String, Failure> {
    let bytes = disk::read(path).map_err(|error| unreadable(path, &error))?;
    if bytes.starts_with(TRACE) {
        let message = "is a trace; `starl replay`, `view`, `verify` and `diagram` read traces";
        return Err(Failure::file(path, message));
    }
    let text = file::text(&bytes).map_err(|error| unreadable(path, &error))?;
    Ok(text.to_string())
}

fn unreadable(path: &Path, error: &FileError) -> Failure {
    match error {
        FileError::NotText { line } => {
            let name = path.display();
            Failure(format!(
                "{name}:{line}: is not text in UTF-8; save it as that"
            ))
        }
        _ => Failure::file(path, format!("cannot be read: {error}; check the path")),
    }
}
