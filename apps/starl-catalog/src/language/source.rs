//! From the path of a program to code that robots can run.

use super::SUFFIX;
use starl_core::{FileError, file};
use starl_lang::check::{Checked, CheckedFile, Libraries, StandardLibraries, check};
use starl_lang::compile::compile as to_bytecode;
use starl_lang::diagnostic::{Colour, Diagnostic, Severity, render};
use starl_lang::ir::Model;
use starl_lang::machine::LoadError;
use starl_lang::robot::Code;
use starl_sim::read::{Loader, Resolved};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt;
use thiserror::Error;

/// The compiler's findings in a file; errors, warnings or both.
#[derive(Clone, Debug)]
pub struct Findings {
    /// The file's path from the scenario's folder.
    pub path: String,
    /// The displayed name of the file where the loader knows no better one: its path beside that of
    /// the scenario.
    pub name: String,
    /// Its text.
    pub source: String,
    /// The findings, at least one.
    pub diagnostics: Vec<Diagnostic>,
}

/// A program that can be run.
#[derive(Clone)]
pub struct Compiled {
    /// The name in the program.
    pub name: String,
    pub code: Code,
    /// Its text.
    pub text: String,
    /// The texts of the libraries that it imports, by name.
    pub libraries: BTreeMap<String, String>,
    /// The models that it names.
    pub models: Vec<Model>,
    /// The same program with the goal of runs as its only property.
    pub goal: Option<Code>,
}

/// Those that it was compiled with.
impl Libraries for Compiled {
    fn source(&self, name: &str) -> Option<String> {
        self.libraries.get(name).cloned()
    }

    fn model(&self, path: &str) -> Result<Vec<u8>, FileError> {
        let found = self.models.iter().find(|model| model.path == path);
        let bytes = found.map(|model| model.bytes.clone());
        bytes.ok_or(FileError::Missing)
    }
}

impl fmt::Debug for Compiled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Compiled").field(&self.name).finish()
    }
}

impl Findings {
    /// Whether they keep the program from running.
    pub fn are_errors(&self) -> bool {
        self.errors() > 0
    }

    /// How many errors there are.
    pub fn errors(&self) -> usize {
        let severities = self.diagnostics.iter().map(Diagnostic::severity);
        severities
            .filter(|&severity| severity == Severity::Error)
            .count()
    }

    /// How people read them: each with the lines that it is about. `name` is what the file is called.
    pub fn render(&self, name: &str, colour: Colour) -> String {
        render(name, &self.source, &self.diagnostics, colour)
    }
}

/// Why a program that the scenario names has neither code nor findings.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum CompileError {
    #[error("{path:?} cannot be read: {error}; its path is relative to the scenario's folder")]
    Unreadable { path: String, error: FileError },
    #[error("{path:?}: {error}")]
    NotText { path: String, error: FileError },
    #[error("{0:?} is a library, which no robot can run")]
    Library(String),
    #[error("{path:?} cannot be run: {error}")]
    NotRunnable { path: String, error: LoadError },
}

/// Loads a program with the libraries and models that it names and compiles it. The files are kept among the
/// scenario's inputs.
///
/// # Errors
/// A file cannot be read. If the program has errors there is no code, and the findings contain them.
pub fn compile(
    path: &str,
    resolved: &mut Resolved,
    loader: &dyn Loader,
) -> Result<(Option<Compiled>, Vec<Findings>), CompileError> {
    let folder = Folder::of(path, loader);
    let text = folder.text(path)?;
    let checked = check(&text, &folder);
    let (files, models) = (folder.brought.into_inner(), folder.models.into_inner());
    let unreadable = files.values().find_map(|file| file.as_ref().err());
    if let Some(reason) = unreadable {
        return Err(reason.clone());
    }
    for (path, file) in &files {
        resolved.keep(path, file.as_deref().unwrap_or_default().as_bytes());
    }
    for (path, bytes) in &models {
        resolved.keep(path, bytes);
    }
    let scenario = &resolved.inputs.request.source.name;
    let mut findings = findings(&checked, path, scenario);
    if checked.has_errors() {
        return Ok((None, findings));
    }
    if checked.program.is_library {
        return Err(CompileError::Library(path.into()));
    }
    let mut bytecode = match to_bytecode(&checked) {
        Ok(bytecode) => bytecode,
        Err(diagnostics) => {
            findings.push(Findings {
                path: path.to_string(),
                name: beside(scenario, path),
                source: text,
                diagnostics,
            });
            return Ok((None, findings));
        }
    };
    for (number, (file, checked)) in bytecode.files.iter_mut().zip(&checked.files).enumerate() {
        file.name = file_name(&path_of(number, checked, path)).to_string();
    }
    let name = bytecode.name.clone();
    let code = Code::load(bytecode).map_err(|error| {
        let path = path.into();
        CompileError::NotRunnable { path, error }
    })?;
    let libraries = checked.files.into_iter().skip(1);
    let compiled = Compiled {
        name,
        code,
        text,
        models: checked.program.models,
        goal: None,
        libraries: libraries.map(|file| (file.name, file.source)).collect(),
    };
    Ok((Some(compiled), findings))
}

/// The findings in each file, by the displayed names of the files.
fn findings(checked: &Checked, path: &str, scenario: &str) -> Vec<Findings> {
    let files = checked.files.iter().enumerate();
    let found = files.filter(|(_, file)| !file.diagnostics.is_empty());
    found
        .map(|(number, file)| {
            let path = path_of(number, file, path);
            Findings {
                name: beside(scenario, &path),
                path,
                source: file.source.clone(),
                diagnostics: file.diagnostics.clone(),
            }
        })
        .collect()
}

/// The path of a file that was checked for the program at `path`.
fn path_of(number: usize, file: &CheckedFile, path: &str) -> String {
    match number {
        0 => path.to_string(),
        _ => beside(path, &format!("{}{SUFFIX}", file.name)),
    }
}

/// The path that leads to `other`, as seen from the folder of `path`.
fn beside(path: &str, other: &str) -> String {
    let folder = &path[..path.len() - file_name(path).len()];
    match other.starts_with('/') {
        true => other.to_string(),
        false => format!("{folder}{}", other.trim_start_matches("./")),
    }
}

fn file_name(path: &str) -> &str {
    path.rsplit('/').next().unwrap_or(path)
}

/// The files around a program, and what was brought of them: texts, or why they are none.
struct Folder<'a> {
    program: &'a str,
    loader: &'a dyn Loader,
    brought: RefCell<BTreeMap<String, Result<String, CompileError>>>,
    models: RefCell<BTreeMap<String, Vec<u8>>>,
}

impl<'a> Folder<'a> {
    fn of(program: &'a str, loader: &'a dyn Loader) -> Folder<'a> {
        Folder {
            program,
            loader,
            brought: RefCell::default(),
            models: RefCell::default(),
        }
    }

    /// The text of the program.
    fn text(&self, path: &str) -> Result<String, CompileError> {
        let bytes = self.loader.load(path).map_err(|error| {
            let path = path.into();
            CompileError::Unreadable { path, error }
        })?;
        self.keep(path, &bytes)
    }

    fn keep(&self, path: &str, bytes: &[u8]) -> Result<String, CompileError> {
        let text = file::text(bytes).map(str::to_string).map_err(|error| {
            let path = path.into();
            CompileError::NotText { path, error }
        });
        let mut brought = self.brought.borrow_mut();
        brought.insert(path.to_string(), text.clone());
        text
    }
}

/// Libraries beside the program go before those of the standard library.
impl Libraries for Folder<'_> {
    fn source(&self, name: &str) -> Option<String> {
        let path = beside(self.program, &format!("{name}{SUFFIX}"));
        match self.loader.load(&path) {
            Ok(bytes) => self.keep(&path, &bytes).ok(),
            Err(_) => StandardLibraries.source(name),
        }
    }

    fn model(&self, path: &str) -> Result<Vec<u8>, FileError> {
        let path = beside(self.program, path);
        let bytes = self.loader.load(&path)?;
        self.models.borrow_mut().insert(path, bytes.clone());
        Ok(bytes)
    }
}
