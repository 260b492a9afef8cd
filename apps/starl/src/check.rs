//! `starl check`: all that is wrong with programs and libraries.

use crate::args::CheckArguments;
use crate::console;
use crate::failure::Failure;
use crate::output::identity;
use crate::sources::{self, Source};
use serde::Serialize;
use starl_lang::check::{Checked, CheckedFile, check};
use starl_lang::diagnostic::{Diagnostic, Severity, render, reports};
use std::collections::BTreeSet;
use std::path::PathBuf;

/// Checks what the arguments name. True if nothing keeps the programs from running.
pub fn run(arguments: &CheckArguments) -> Result<bool, Failure> {
    let (sources, mut failures) = sources::find(&arguments.files);
    let mut findings = Findings::new(&sources);
    for source in &sources {
        match examine(source) {
            Ok(examined) => {
                failures.extend(examined.failures);
                findings.files += 1;
                for file in examined.files {
                    findings.add(file, arguments.json)?;
                }
            }
            Err(failure) => failures.push(failure),
        }
    }
    if arguments.json {
        findings.print_json()?;
    } else {
        console::print(&findings.summary())?;
    }
    sources::fail(failures)?;
    Ok(findings.errors == 0 && !(arguments.deny_warnings && findings.warnings > 0))
}

/// A source that was checked.
struct Examined {
    /// The source, then the libraries that it imports from files.
    files: Vec<Examinee>,
    /// Libraries that are there but could not be read.
    failures: Vec<Failure>,
}

/// A file that was checked.
struct Examinee {
    name: String,
    /// None of standard input.
    identity: Option<PathBuf>,
    is_library: bool,
    checked: CheckedFile,
}

fn examine(source: &Source) -> Result<Examined, Failure> {
    let text = source.read()?;
    let libraries = source.libraries();
    let Checked { files, .. } = check(&text, &libraries);
    let found = libraries.found();
    let mut examinees = Vec::new();
    for (number, checked) in files.into_iter().enumerate() {
        let examinee = match (number, source) {
            (0, Source::Input) => Examinee {
                name: source.name(),
                identity: None,
                is_library: false,
                checked,
            },
            (0, Source::File(path)) => Examinee {
                name: source.name(),
                identity: Some(identity(path)),
                is_library: false,
                checked,
            },
            // The prelude and the standard library have no path, and nothing is wrong with them.
            _ => match found.get(&checked.name) {
                Some(path) => Examinee {
                    name: path.display().to_string(),
                    identity: Some(identity(path)),
                    is_library: true,
                    checked,
                },
                None => continue,
            },
        };
        examinees.push(examinee);
    }
    Ok(Examined {
        files: examinees,
        failures: libraries.failures(),
    })
}

/// What was found so far.
struct Findings {
    /// The files that are checked by themselves, or were told of; a library that several programs
    /// import is told of once.
    told: BTreeSet<PathBuf>,
    /// How many sources were checked.
    files: usize,
    errors: usize,
    warnings: usize,
    reports: Vec<serde_json::Value>,
}

impl Findings {
    fn new(sources: &[Source]) -> Findings {
        let own = sources.iter().filter_map(|source| match source {
            Source::Input => None,
            Source::File(path) => Some(identity(path)),
        });
        Findings {
            told: own.collect(),
            files: 0,
            errors: 0,
            warnings: 0,
            reports: Vec::new(),
        }
    }

    fn add(&mut self, file: Examinee, as_json: bool) -> Result<(), Failure> {
        if file.is_library
            && let Some(identity) = file.identity
            && !self.told.insert(identity)
        {
            return Ok(());
        }
        let CheckedFile {
            source,
            diagnostics,
            ..
        } = &file.checked;
        self.count(diagnostics);
        if as_json {
            let values = reports(&file.name, source, diagnostics);
            let values = values.iter().map(serde_json::to_value);
            self.reports.extend(values.filter_map(Result::ok));
            return Ok(());
        }
        let text = render(&file.name, source, diagnostics, console::colour());
        console::print(&text)
    }

    fn count(&mut self, diagnostics: &[Diagnostic]) {
        for diagnostic in diagnostics {
            match diagnostic.severity() {
                Severity::Error => self.errors += 1,
                Severity::Warning => self.warnings += 1,
            }
        }
    }

    /// `3 files: 1 error, 2 warnings`
    fn summary(&self) -> String {
        let files = console::counted(self.files, "file");
        let errors = console::counted(self.errors, "error");
        let warnings = console::counted(self.warnings, "warning");
        match (self.errors, self.warnings) {
            (0, 0) => format!("{files}: no problems\n"),
            (0, _) => format!("{files}: {warnings}\n"),
            (_, 0) => format!("{files}: {errors}\n"),
            _ => format!("{files}: {errors}, {warnings}\n"),
        }
    }

    fn print_json(&self) -> Result<(), Failure> {
        crate::json::print(&Report {
            files: self.files,
            errors: self.errors,
            warnings: self.warnings,
            diagnostics: &self.reports,
        })
    }
}

#[derive(Serialize)]
struct Report<'a> {
    files: usize,
    errors: usize,
    warnings: usize,
    diagnostics: &'a [serde_json::Value],
}
