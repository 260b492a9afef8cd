//! Diagnostics of a program: a code, a position, a message and often a fix.
//!
//! A [`Diagnostic`] is data. [`render`] shows it with the source around it, [`json`] hands it to
//! programs, and [`Fix::apply`] does what it suggests.

mod code;
mod excerpt;
mod fix;
mod json;
mod position;
mod render;
mod similar;

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

pub use code::Code;
pub use fix::{Edit, Fix};
pub use json::{json, reports};
pub use position::{LineIndex, Position};
pub use render::{Colour, render};
pub use similar::closest;

/// How much a problem matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The program does not run.
    Error,
    /// The program runs, but perhaps not as it was meant.
    Warning,
}

/// A part of a source text, in bytes from its start; the end is excluded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Span {
    /// Where it starts.
    pub start: u32,
    /// Where it ends.
    pub end: u32,
}

impl Span {
    /// From `start` to just before `end`.
    #[must_use]
    pub const fn new(start: u32, end: u32) -> Self {
        Self { start, end }
    }

    /// The place just before the character at `at`.
    #[must_use]
    pub const fn empty(at: u32) -> Self {
        Self { start: at, end: at }
    }

    /// The smallest part that holds both.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self {
            start: self.start.min(other.start),
            end: self.end.max(other.end),
        }
    }

    /// The text that it marks in `source`.
    #[must_use]
    pub fn of(self, source: &str) -> &str {
        source
            .get(self.start as usize..self.end as usize)
            .unwrap_or_default()
    }
}

impl From<rowan::TextRange> for Span {
    fn from(range: rowan::TextRange) -> Self {
        Self {
            start: range.start().into(),
            end: range.end().into(),
        }
    }
}

/// A second place that helps to understand a problem.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// The message at that position.
    pub message: String,
}

/// One problem of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The kind of problem.
    pub code: Code,
    /// Where it is.
    pub span: Span,
    /// The problem, in a sentence without a full stop.
    pub message: String,
    /// The expected type or text, if known.
    pub expected: Option<String>,
    /// The actual type or text.
    pub found: Option<String>,
    /// A note at the position itself, if the message needs one.
    pub note_at_span: Option<String>,
    /// Other places that matter.
    pub labels: Vec<Label>,
    /// More that is worth knowing.
    pub notes: Vec<String>,
    /// The suggested fix.
    pub fix: Option<Fix>,
}

impl Diagnostic {
    /// A problem at a place.
    #[must_use]
    pub fn new(code: Code, span: Span, message: impl Into<String>) -> Self {
        Self {
            code,
            span,
            message: message.into(),
            expected: None,
            found: None,
            note_at_span: None,
            labels: Vec::new(),
            notes: Vec::new(),
            fix: None,
        }
    }

    /// How much it matters.
    #[must_use]
    pub fn severity(&self) -> Severity {
        self.code.severity()
    }

    /// The lines below the message: the note at the position, the expected and the actual form, and further notes.
    pub fn remarks(&self) -> impl Iterator<Item = String> {
        let should = self.expected.iter().map(|what| format!("expected: {what}"));
        let stands = self.found.iter().map(|what| format!("found: {what}"));
        let at_place = self.note_at_span.iter().cloned();
        at_place
            .chain(should)
            .chain(stands)
            .chain(self.notes.iter().cloned())
    }

    /// The same, saying what should stand there.
    #[must_use]
    pub fn expected(mut self, what: impl Into<String>) -> Self {
        self.expected = Some(what.into());
        self
    }

    /// The same, saying what stands there.
    #[must_use]
    pub fn found(mut self, what: impl Into<String>) -> Self {
        self.found = Some(what.into());
        self
    }

    /// The same, with words at the place itself.
    #[must_use]
    pub fn note_at_span(mut self, words: impl Into<String>) -> Self {
        self.note_at_span = Some(words.into());
        self
    }

    /// The same, with another place.
    #[must_use]
    pub fn label(mut self, span: Span, message: impl Into<String>) -> Self {
        self.labels.push(Label {
            span,
            message: message.into(),
        });
        self
    }

    /// The same, with more that is worth knowing.
    #[must_use]
    pub fn note(mut self, words: impl Into<String>) -> Self {
        self.notes.push(words.into());
        self
    }

    /// The same, with this note if there is one.
    #[must_use]
    pub fn note_if(mut self, note: Option<impl Into<String>>) -> Self {
        self.notes.extend(note.map(Into::into));
        self
    }

    /// The same, with a fix.
    #[must_use]
    pub fn fix(mut self, fix: Fix) -> Self {
        self.fix = Some(fix);
        self
    }

    /// The same, fixed by one replacement at `span`.
    #[must_use]
    pub fn replace(self, message: impl Into<String>, span: Span, text: impl Into<String>) -> Self {
        self.edits(message, [Edit::new(span, text)])
    }

    /// The same, fixed by writing `text` at `span`; the instruction names the text without white space around it.
    #[must_use]
    pub fn write(self, span: Span, text: impl Into<String>) -> Self {
        let text = text.into();
        self.replace(format!("write `{}`", text.trim()), span, text)
    }

    /// The same, fixed by these edits, sorted by position.
    #[must_use]
    pub fn edits(self, message: impl Into<String>, edits: impl Into<Vec<Edit>>) -> Self {
        self.fix(Fix {
            message: message.into(),
            edits: edits.into(),
        })
    }
}

/// Whether any of them keeps the program from running.
#[must_use]
pub fn has_errors(diagnostics: &[Diagnostic]) -> bool {
    diagnostics
        .iter()
        .any(|diagnostic| diagnostic.severity() == Severity::Error)
}
