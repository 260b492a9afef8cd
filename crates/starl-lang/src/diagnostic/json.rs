//! Diagnostics as programs read them.

use alloc::string::String;
use alloc::vec::Vec;

use serde::Serialize;

use super::{Diagnostic, LineIndex, Severity, Span};

/// The diagnostics of one file as a JSON array, an object each: `code`, `severity` (`error` or
/// `warning`), `message`, `file`, `start` and `end`; `expected`, `found` and `note_at_span`, or null;
/// `notes`; `labels`, each with `start`, `end` and `message`; and `fix`, with `message` and `edits`,
/// each with `start`, `end` and `text`, or null. A place has `offset` (bytes from 0), `line` and
/// `column` (characters), both from 1.
#[must_use]
pub fn json(name: &str, source: &str, diagnostics: &[Diagnostic]) -> String {
    let reports = reports(name, source, diagnostics);
    serde_json::to_string_pretty(&reports).expect("strings and numbers have a JSON form")
}

/// The same as values, to be part of something larger.
#[must_use]
pub fn reports<'a>(
    name: &'a str,
    source: &str,
    diagnostics: &'a [Diagnostic],
) -> Vec<impl Serialize + use<'a>> {
    let lines = LineIndex::new(source);
    let place = |offset: u32| {
        let position = lines.position(source, offset.min(source.len() as u32));
        Place {
            offset,
            line: position.line,
            column: position.column,
        }
    };
    let marked = |span: Span, words| Marked {
        start: place(span.start),
        end: place(span.end),
        words,
    };
    diagnostics
        .iter()
        .map(|diagnostic| Problem {
            code: diagnostic.code.number(),
            severity: match diagnostic.severity() {
                Severity::Error => "error",
                Severity::Warning => "warning",
            },
            message: &diagnostic.message,
            file: name,
            start: place(diagnostic.span.start),
            end: place(diagnostic.span.end),
            expected: diagnostic.expected.as_deref(),
            found: diagnostic.found.as_deref(),
            note_at_span: diagnostic.note_at_span.as_deref(),
            notes: &diagnostic.notes,
            labels: (diagnostic.labels.iter())
                .map(|label| marked(label.span, Words::Message(&label.message)))
                .collect(),
            fix: diagnostic.fix.as_ref().map(|fix| Change {
                message: &fix.message,
                edits: (fix.edits.iter())
                    .map(|edit| marked(edit.span, Words::Text(&edit.text)))
                    .collect(),
            }),
        })
        .collect::<Vec<Problem<'a>>>()
}

#[derive(Serialize)]
struct Problem<'a> {
    code: &'a str,
    severity: &'a str,
    message: &'a str,
    file: &'a str,
    start: Place,
    end: Place,
    expected: Option<&'a str>,
    found: Option<&'a str>,
    note_at_span: Option<&'a str>,
    notes: &'a [String],
    labels: Vec<Marked<'a>>,
    fix: Option<Change<'a>>,
}

#[derive(Serialize)]
struct Place {
    offset: u32,
    line: u32,
    column: u32,
}

#[derive(Serialize)]
struct Marked<'a> {
    start: Place,
    end: Place,
    #[serde(flatten)]
    words: Words<'a>,
}

#[derive(Serialize)]
#[serde(rename_all = "lowercase")]
enum Words<'a> {
    Message(&'a str),
    Text(&'a str),
}

#[derive(Serialize)]
struct Change<'a> {
    message: &'a str,
    edits: Vec<Marked<'a>>,
}
