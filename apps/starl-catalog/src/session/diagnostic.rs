//! All problems of files in memory, programs and scenarios.

use super::files::{Beside, Files};
use crate::language::{Findings, SUFFIX};
use crate::programs::Registry;
use crate::{Application, Refusal};
use serde::Serialize;
use starl_editor::Analysis;
use starl_lang::diagnostic::{LineIndex, Severity, Span};
use starl_sim::read::{Place, Problem, Request, Source};

/// The ending of scenarios' names.
pub(super) const SCENARIO_SUFFIX: &str = ".toml";

/// A part of a file. Lines and characters are counted from 1; characters are Unicode characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Extent {
    /// The line.
    pub line: u32,
    /// The first character in its line.
    pub column: u32,
    /// The line of the end.
    pub end_line: u32,
    /// The character after the last.
    pub end_column: u32,
}

/// One problem of a file.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Diagnostic {
    /// The file's path; none for a problem with an option.
    pub file: Option<String>,
    /// The part concerned; empty if only its start is known.
    #[serde(flatten)]
    pub extent: Extent,
    /// How many Unicode characters are concerned, 0 if only the start is known.
    pub length: u32,
    /// `error` or `warning`.
    pub severity: &'static str,
    /// The number of the error in the language's reference, e.g. `E0301`; none for scenarios.
    pub code: Option<&'static str>,
    /// The field of a scenario, as `network.loss`; or the option.
    pub field: Option<String>,
    /// The problem, in a sentence without a full stop.
    pub message: String,
    /// A suggested fix.
    pub help: Option<String>,
    /// More that is worth knowing, a line each.
    pub notes: Vec<String>,
    /// Other places that matter.
    pub related: Vec<Related>,
    /// The changes that the suggested fix makes to the file; none where it is for people to make.
    pub edits: Vec<Edit>,
    /// Whether the text could be taken away without a loss.
    pub unnecessary: bool,
}

/// Another place of the file that helps to understand a problem.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Related {
    /// The place.
    #[serde(flatten)]
    pub extent: Extent,
    /// The description of the position.
    pub message: String,
}

/// A change of the file.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Edit {
    /// The part that is replaced.
    #[serde(flatten)]
    pub extent: Extent,
    /// The new text.
    pub text: String,
}

impl Extent {
    /// A place between two characters.
    fn at(line: u32, column: u32) -> Extent {
        Extent {
            line,
            column,
            end_line: line,
            end_column: column,
        }
    }
}

impl Diagnostic {
    /// An error with a file as a whole.
    pub(super) fn of_file(file: &str, message: String) -> Diagnostic {
        Diagnostic {
            file: Some(file.to_string()),
            extent: Extent::at(1, 1),
            length: 0,
            severity: "error",
            code: None,
            field: None,
            message,
            help: None,
            notes: Vec::new(),
            related: Vec::new(),
            edits: Vec::new(),
            unnecessary: false,
        }
    }

    /// A problem of a scenario, or of a file that it names.
    fn of_problem(problem: Problem) -> Diagnostic {
        let Problem {
            place,
            field,
            message,
            help,
        } = problem;
        let field = (!field.is_empty()).then_some(field);
        let (file, line, column, field) = match place {
            Place::File { name, line, column } => (Some(name), line, column, field),
            Place::Option(option) => (None, 1, 1, Some(option)),
        };
        Diagnostic {
            file,
            extent: Extent::at(line, column),
            field,
            help,
            ..Diagnostic::of_file("", message)
        }
    }

    /// The problems of a program or library called `file`.
    fn of_findings<'a>(
        file: &'a str,
        source: &'a str,
        diagnostics: &'a [starl_lang::diagnostic::Diagnostic],
    ) -> impl Iterator<Item = Diagnostic> + use<'a> {
        let lines = LineIndex::new(source);
        let extent = move |span: Span| {
            let last = source.len() as u32;
            let position = |offset: u32| lines.position(source, offset.min(last));
            let (start, end) = (position(span.start), position(span.end));
            Extent {
                line: start.line,
                column: start.column,
                end_line: end.line,
                end_column: end.column,
            }
        };
        diagnostics.iter().map(move |diagnostic| {
            let related = diagnostic.labels.iter().map(|label| Related {
                extent: extent(label.span),
                message: label.message.clone(),
            });
            let edits = diagnostic.fix.iter().flat_map(|fix| &fix.edits);
            let edits = edits.map(|edit| Edit {
                extent: extent(edit.span),
                text: edit.text.clone(),
            });
            Diagnostic {
                extent: extent(diagnostic.span),
                length: diagnostic.span.of(source).chars().count() as u32,
                severity: match diagnostic.severity() {
                    Severity::Error => "error",
                    Severity::Warning => "warning",
                },
                code: Some(diagnostic.code.number()),
                help: diagnostic.fix.as_ref().map(|fix| fix.message.clone()),
                notes: diagnostic.remarks().collect(),
                related: related.collect(),
                edits: edits.collect(),
                unnecessary: diagnostic.code.is_needless(),
                ..Diagnostic::of_file(file, diagnostic.message.clone())
            }
        })
    }

    /// The problems of the condition of a breakpoint, by its place in the list; places are those in the expression.
    pub(super) fn of_condition<'a>(
        breakpoint: usize,
        expression: &'a str,
        diagnostics: &'a [starl_lang::diagnostic::Diagnostic],
    ) -> impl Iterator<Item = Diagnostic> + use<'a> {
        let found = Diagnostic::of_findings("", expression, diagnostics);
        found.map(move |found| Diagnostic {
            file: None,
            field: Some(format!("breakpoints.{breakpoint}.when.expression")),
            ..found
        })
    }

    /// The compiler has found this in a program that a scenario names.
    fn of_program(findings: &Findings, beside: &Beside<'_>) -> Vec<Diagnostic> {
        let path = beside.resolve(&findings.path);
        Diagnostic::of_findings(&path, &findings.source, &findings.diagnostics).collect()
    }

    /// The warnings of the compiler about the programs of an application.
    pub(super) fn of_warnings(application: &Application, beside: &Beside<'_>) -> Vec<Diagnostic> {
        let warnings = application.warnings().iter();
        warnings
            .flat_map(|findings| Diagnostic::of_program(findings, beside))
            .collect()
    }

    /// All problems of a scenario and its programs.
    pub(super) fn of_refusal(refusal: Refusal, beside: &Beside<'_>) -> Vec<Diagnostic> {
        let found = refusal.findings.iter();
        let mut all: Vec<Diagnostic> = found
            .flat_map(|findings| Diagnostic::of_program(findings, beside))
            .collect();
        all.extend(refusal.problems.into_iter().map(Diagnostic::of_problem));
        all
    }
}

/// Checks every program and library (`.starl`) and every scenario (`.toml`). Scenarios may name files and
/// programs of all examples, `example:race/race.starl`, and programs of the registry. The problems are in the order of files and places.
pub fn check(files: &Files, registry: &Registry) -> Vec<Diagnostic> {
    let programs = files
        .ending_with(SUFFIX)
        .flat_map(|path| match files.text(path) {
            Ok(text) => program(files, path, text),
            Err(error) => vec![Diagnostic::of_file(path, error.to_string())],
        });
    let scenarios = files
        .ending_with(SCENARIO_SUFFIX)
        .flat_map(|path| match files.text(path) {
            Ok(text) => scenario(files, path, text, registry),
            Err(error) => vec![Diagnostic::of_file(path, error.to_string())],
        });
    let mut all: Vec<Diagnostic> = programs.chain(scenarios).collect();
    all.sort();
    all.dedup();
    all
}

fn program(files: &Files, path: &str, text: &str) -> Vec<Diagnostic> {
    let analysis = Analysis::new(text, &Beside::new(files, path));
    Diagnostic::of_findings(path, text, analysis.diagnostics()).collect()
}

/// Everything that is wrong with a scenario. The programs among the files are checked by themselves.
fn scenario(files: &Files, path: &str, text: &str, registry: &Registry) -> Vec<Diagnostic> {
    let beside = Beside::new(files, path);
    let request = Request::new(Source::new(path, text));
    let found = match crate::read(&request, &beside, registry) {
        Ok(application) => Diagnostic::of_warnings(&application, &beside),
        Err(refusal) => Diagnostic::of_refusal(refusal, &beside),
    };
    let is_new = |found: &Diagnostic| {
        let file = found.file.as_deref().unwrap_or_default();
        !(file.ends_with(SUFFIX) && files.has(file))
    };
    found.into_iter().filter(is_new).collect()
}
