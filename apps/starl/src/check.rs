//! `starl check`: reports all problems of programs and libraries.

use crate::args::CheckArguments;
use crate::console;
use crate::failure::Failure;
use crate::output::identity;
use crate::sources::{self, Source};
use serde::Serialize;
use starl_lang::check::{Checked, CheckedFile, check};
use starl_lang::compile::problems;
use starl_lang::diagnostic::{Code, Colour, Diagnostic, Severity, has_errors, render, reports};
use starl_lang::ir::Program;
use std::collections::BTreeSet;
use std::path::PathBuf;

/// Checks what the arguments name. True if nothing keeps the programs from running.
pub fn run(arguments: &CheckArguments) -> Result<bool, Failure> {
    let (sources, mut failures) = sources::find(&arguments.files);
    let mut findings = Findings::new(&sources);
    for source in &sources {
        match examine(source, problems) {
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
pub struct Examined {
    /// The program, with errors in it if there are any.
    pub program: Program,
    /// The source, then the libraries that it imports from files.
    pub files: Vec<Examinee>,
    /// Libraries that are there but could not be read.
    pub failures: Vec<Failure>,
}

impl Examined {
    /// The files on disk.
    pub fn paths(&self) -> Vec<PathBuf> {
        let files = self.files.iter();
        files.filter_map(|file| file.identity.clone()).collect()
    }
}

/// A file that was checked.
pub struct Examinee {
    name: String,
    /// `None` if there is no such file.
    identity: Option<PathBuf>,
    is_library: bool,
    checked: CheckedFile,
}

/// Checks a source silently, and adds further findings about the program itself.
pub fn examine(
    source: &Source,
    more: impl Fn(&Checked) -> Vec<Diagnostic>,
) -> Result<Examined, Failure> {
    let text = source.read()?;
    let libraries = source.libraries();
    let mut checked = check(&text, &libraries);
    let more = more(&checked);
    checked.files[0].diagnostics.extend(more);
    let Checked { files, program, .. } = checked;
    let found = libraries.found();
    let mut examinees = Vec::new();
    for (number, checked) in files.into_iter().enumerate() {
        let examinee = match number {
            0 => Examinee {
                name: source.name(),
                identity: source.identity(),
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
        program,
        files: examinees,
        failures: libraries.failures(),
    })
}

impl Examinee {
    /// All its problems, as text.
    pub fn render(&self, colour: Colour) -> String {
        let CheckedFile {
            source,
            diagnostics,
            ..
        } = &self.checked;
        render(&self.name, source, diagnostics, colour)
    }

    /// Whether it keeps the program from running.
    pub fn has_errors(&self) -> bool {
        has_errors(&self.checked.diagnostics)
    }
}

/// The findings so far.
struct Findings {
    /// The files that are checked by themselves, or were reported; a library that several programs
    /// import is reported once.
    told: BTreeSet<PathBuf>,
    /// How many sources were checked.
    files: usize,
    errors: usize,
    warnings: usize,
    /// The code of the first problem.
    first: Option<Code>,
    reports: Vec<serde_json::Value>,
}

impl Findings {
    fn new(sources: &[Source]) -> Findings {
        Findings {
            told: sources.iter().filter_map(Source::identity).collect(),
            files: 0,
            errors: 0,
            warnings: 0,
            first: None,
            reports: Vec::new(),
        }
    }

    fn add(&mut self, file: Examinee, as_json: bool) -> Result<(), Failure> {
        if file.is_library
            && let Some(identity) = file.identity.clone()
            && !self.told.insert(identity)
        {
            return Ok(());
        }
        let checked = &file.checked;
        self.count(&checked.diagnostics);
        if as_json {
            let values = reports(&file.name, &checked.source, &checked.diagnostics);
            let values = values.iter().map(serde_json::to_value);
            self.reports.extend(values.filter_map(Result::ok));
            return Ok(());
        }
        console::print(&file.render(console::colour()))
    }

    fn count(&mut self, diagnostics: &[Diagnostic]) {
        for diagnostic in diagnostics {
            self.first.get_or_insert(diagnostic.code);
            match diagnostic.severity() {
                Severity::Error => self.errors += 1,
                Severity::Warning => self.warnings += 1,
            }
        }
    }

    /// Where to read more, and `3 files: 1 error, 2 warnings`.
    fn summary(&self) -> String {
        let more = self.first.map_or_else(String::new, |code| {
            format!("to read more: starl explain {code}\n")
        });
        let files = console::counted(self.files, "file");
        let errors = console::counted(self.errors, "error");
        let warnings = console::counted(self.warnings, "warning");
        match (self.errors, self.warnings) {
            (0, 0) if self.files == 0 => String::new(),
            (0, 0) => format!("{files}: no problems\n"),
            (0, _) => format!("{more}{files}: {warnings}\n"),
            (_, 0) => format!("{more}{files}: {errors}\n"),
            _ => format!("{more}{files}: {errors}, {warnings}\n"),
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
