//! Finds what `starl run TARGET` means, and reads it with all that the command line changes.

use crate::args::RunArguments;
use crate::failure::Failure;
use crate::output::reason;
use starl_catalog::examples::{self, EXAMPLES};
use starl_sim::read::{Loader, Override, Request, Resolved, Source, suggest};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Reads the scenario that the arguments name, checked to its last field, programs included.
pub fn read(arguments: &RunArguments) -> Result<Resolved, Failure> {
    let (source, loader) = find(&arguments.target)?;
    let faults = match &arguments.faults {
        Some(path) => Some(Source::new(path.display().to_string(), text(path)?)),
        None => None,
    };
    let request = Request {
        overrides: overrides(arguments)?,
        robots: arguments.robots.clone(),
        faults,
        ..Request::new(source)
    };
    Ok(starl_catalog::read(&request, &*loader)?)
}

/// The files that the scenario was read from; none of an example's, which are part of the command.
pub fn files(arguments: &RunArguments, resolved: &Resolved) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = arguments.faults.iter().cloned().collect();
    if examples::find(&arguments.target).is_none() {
        let scenario = PathBuf::from(&arguments.target);
        let named = resolved.inputs.files.keys();
        files.extend(named.map(|path| scenario.with_file_name(path)));
        files.push(scenario);
    }
    files
}

/// The changes that the command line makes, in the order of their power: the options with names of
/// their own come last.
fn overrides(arguments: &RunArguments) -> Result<Vec<Override>, Failure> {
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

fn find(target: &str) -> Result<(Source, Box<dyn Loader>), Failure> {
    if let Some(example) = examples::find(target) {
        return Ok((example.source(), Box::new(*example)));
    }
    let path = Path::new(target);
    if !path.exists() {
        let names: Vec<&str> = EXAMPLES.iter().map(|example| example.name).collect();
        let help = suggest::help(target, &names, "the examples are").unwrap_or_default();
        return Err(Failure(format!(
            "{target}: there is no example or scenario file called this; {help}"
        )));
    }
    if path.is_dir() {
        return Err(Failure::file(
            path,
            "is a folder; name the scenario file in it",
        ));
    }
    let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
    Ok((Source::new(target, text(path)?), Box::new(Folder(folder))))
}

/// The text of a file.
pub fn text(path: &Path) -> Result<String, Failure> {
    let bytes =
        bytes(path).map_err(|error| Failure::file(path, format!("cannot be read: {error}")))?;
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        let name = path.display();
        Failure(format!(
            "{name}:{line}: is not text in UTF-8; save it as that"
        ))
    })
}

/// Larger files are no scenarios, world files or images.
const LARGEST_FILE: u64 = 256 << 20;

fn bytes(path: &Path) -> Result<Vec<u8>, String> {
    let read = || {
        let mut bytes = Vec::new();
        let file = File::open(path)?;
        file.take(LARGEST_FILE + 1).read_to_end(&mut bytes)?;
        Ok(bytes)
    };
    let bytes = read().map_err(|error: io::Error| reason(&error))?;
    match bytes.len() as u64 > LARGEST_FILE {
        true => Err("it is larger than 256 MiB".to_string()),
        false => Ok(bytes),
    }
}

/// Brings files from the scenario's folder.
struct Folder(PathBuf);

impl Loader for Folder {
    fn load(&self, path: &str) -> Result<Vec<u8>, String> {
        bytes(&self.0.join(path))
    }
}
