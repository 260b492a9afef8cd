//! The texts of programs that a command is given: files, folders of them, examples, or standard input.

use crate::failure::Failure;
use crate::output::identity;
use crate::target;
use starl_catalog::disk::reason;
use starl_catalog::examples::Example;
use starl_core::FileError;
use starl_lang::check::{Libraries, NoLibraries, StandardLibraries, check};
use starl_sim::read::Loader;
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// The suffix of a file of the language.
const SUFFIX: &str = "starl";

/// The source of a text.
#[derive(Clone, Debug)]
pub enum Source {
    /// `-`
    Input,
    /// A file.
    File(PathBuf),
    /// A file of an example, which is part of the command.
    Example(&'static Example, &'static str),
}

impl Source {
    /// Its displayed name.
    pub fn name(&self) -> String {
        match self {
            Source::Input => "standard input".to_string(),
            Source::File(path) => path.display().to_string(),
            Source::Example(_, name) => (*name).to_string(),
        }
    }

    /// The canonical path of the file on disk; none if it is not a file.
    pub fn identity(&self) -> Option<PathBuf> {
        match self {
            Source::File(path) => Some(identity(path)),
            Source::Input | Source::Example(..) => None,
        }
    }

    /// Its text.
    pub fn read(&self) -> Result<String, Failure> {
        match self {
            Source::File(path) => target::text(path),
            Source::Example(example, name) => {
                let text = of_example(example, name);
                text.ok_or_else(|| Failure(format!("{name}: is not text in UTF-8")))
            }
            Source::Input => {
                let mut text = String::new();
                match io::stdin().lock().read_to_string(&mut text) {
                    Ok(_) => Ok(text),
                    Err(error) if error.kind() == io::ErrorKind::InvalidData => {
                        let message = "standard input: is not text in UTF-8";
                        Err(Failure(message.to_string()))
                    }
                    Err(error) => Err(Failure(format!(
                        "standard input: cannot be read: {}",
                        reason(&error)
                    ))),
                }
            }
        }
    }

    /// The libraries that it may import.
    pub fn libraries(&self) -> Beside {
        let folder = match self {
            Source::Input => Folder::Disk(PathBuf::new()),
            Source::File(path) => Folder::Disk(path.with_file_name("")),
            Source::Example(example, _) => Folder::Example(example),
        };
        Beside {
            folder,
            found: RefCell::default(),
            failures: RefCell::default(),
        }
    }
}

/// Libraries in the folder of the importing file, then those of the standard library.
pub struct Beside {
    folder: Folder,
    found: RefCell<BTreeMap<String, PathBuf>>,
    failures: RefCell<Vec<Failure>>,
}

enum Folder {
    Disk(PathBuf),
    Example(&'static Example),
}

impl Beside {
    /// The files loaded so far, by the names of their libraries, without those of the standard library, which are part
    /// of the command.
    pub fn found(&self) -> BTreeMap<String, PathBuf> {
        self.found.borrow().clone()
    }

    /// The files that are there but could not be read.
    pub fn failures(self) -> Vec<Failure> {
        self.failures.into_inner()
    }
}

impl Libraries for Beside {
    fn source(&self, name: &str) -> Option<String> {
        let file = format!("{name}.{SUFFIX}");
        let path = match &self.folder {
            Folder::Disk(folder) => folder.join(file),
            Folder::Example(example) => {
                return of_example(example, &file).or_else(|| StandardLibraries.source(name));
            }
        };
        if !path.exists() {
            return StandardLibraries.source(name);
        }
        match target::text(&path) {
            Ok(text) => {
                self.found.borrow_mut().insert(name.to_string(), path);
                Some(text)
            }
            Err(failure) => {
                self.failures.borrow_mut().push(failure);
                None
            }
        }
    }

    fn model(&self, path: &str) -> Result<Vec<u8>, FileError> {
        match &self.folder {
            Folder::Disk(folder) => starl_catalog::disk::read(&folder.join(path)),
            Folder::Example(example) => example.load(path),
        }
    }
}

/// The program of an example: the first of its files that is one.
pub fn of(example: &'static Example) -> Option<Source> {
    let names = example.files.iter().map(|(name, _)| *name);
    let mut programs = names.filter(|name| name.ends_with(&format!(".{SUFFIX}")));
    let program = programs.find(|name| {
        let text = of_example(example, name).unwrap_or_default();
        !check(&text, &NoLibraries).program.is_library
    });
    program.map(|name| Source::Example(example, name))
}

fn of_example(example: &Example, name: &str) -> Option<String> {
    let (_, content) = example.files.iter().find(|(own, _)| *own == name)?;
    String::from_utf8(content.to_vec()).ok()
}

/// The sources that arguments name, each once, and the problems of the others. A folder means all programs and
/// libraries in it and its subfolders, in the order of their paths.
pub fn find(arguments: &[PathBuf]) -> (Vec<Source>, Vec<Failure>) {
    let mut sources = Vec::new();
    let mut failures = Vec::new();
    let mut known = BTreeSet::new();
    let mut add = |source: Source| {
        let is_new = match &source {
            Source::File(path) => known.insert(identity(path)),
            _ => known.insert(PathBuf::from(source.name())),
        };
        if is_new {
            sources.push(source);
        }
    };
    for argument in arguments {
        if argument.as_os_str() == "-" {
            add(Source::Input);
        } else if argument.is_dir() {
            let mut files = Vec::new();
            programs(argument, &mut files, &mut failures);
            if files.is_empty() {
                let message = format!("there is no `.{SUFFIX}` file in this folder");
                failures.push(Failure::file(argument, message));
            }
            files.into_iter().for_each(|path| add(Source::File(path)));
        } else if is_scenario(argument) {
            failures.push(Failure::file(argument, SCENARIO));
        } else {
            add(Source::File(argument.clone()));
        }
    }
    (sources, failures)
}

/// The message for a scenario in place of a program.
pub const SCENARIO: &str = "is a scenario, not a program; `starl run` reads and checks it";

/// Whether a file is a scenario, by its name.
pub fn is_scenario(path: &Path) -> bool {
    path.extension().is_some_and(|suffix| suffix == "toml") && path.exists()
}

/// The programs and libraries of a folder. Names that begin with a point are omitted, and so are
/// links to folders, which may lead back.
fn programs(folder: &Path, files: &mut Vec<PathBuf>, failures: &mut Vec<Failure>) {
    let entries = fs::read_dir(folder).and_then(Iterator::collect::<io::Result<Vec<_>>>);
    let mut entries = match entries {
        Ok(entries) => entries,
        Err(error) => {
            let message = format!("cannot be read: {}; check the path", reason(&error));
            failures.push(Failure::file(folder, message));
            return;
        }
    };
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        // Files found in `.` are shown by their names alone, as if they were given.
        let path = match folder == Path::new(".") {
            true => PathBuf::from(entry.file_name()),
            false => entry.path(),
        };
        let is_hidden = entry.file_name().as_encoded_bytes().starts_with(b".");
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        if is_hidden {
            continue;
        }
        if is_folder {
            programs(&path, files, failures);
        } else if path.extension().is_some_and(|suffix| suffix == SUFFIX) && !path.is_dir() {
            files.push(path);
        }
    }
}

/// Prints all failures except the last, which the command returns.
pub fn fail(mut failures: Vec<Failure>) -> Result<(), Failure> {
    let Some(last) = failures.pop() else {
        return Ok(());
    };
    for failure in &failures {
        crate::console::error(&failure.0);
    }
    Err(last)
}
