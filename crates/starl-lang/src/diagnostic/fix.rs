//! A change of the source that would put a problem right.

use alloc::string::String;
use alloc::vec::Vec;

use super::Span;

/// One replacement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// The text to replace; empty to insert.
    pub span: Span,
    /// The new text.
    pub text: String,
}

impl Edit {
    /// Replaces the text at `span` by `text`.
    #[must_use]
    pub fn new(span: Span, text: impl Into<String>) -> Self {
        Self {
            span,
            text: text.into(),
        }
    }
}

/// A change that would put a problem right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// The instruction shown to users.
    pub message: String,
    /// The same as edits, sorted by position and without overlaps.
    pub edits: Vec<Edit>,
}

impl Fix {
    /// The source after the change. Edits that do not fit `source` are left out.
    #[must_use]
    pub fn apply(&self, source: &str) -> String {
        let mut changed = String::with_capacity(source.len());
        let mut done = 0;
        for edit in &self.edits {
            let (start, end) = (edit.span.start as usize, edit.span.end as usize);
            let Some(before) = source.get(done..start) else {
                continue;
            };
            if source.get(start..end).is_none() {
                continue;
            }
            changed.push_str(before);
            changed.push_str(&edit.text);
            done = end;
        }
        changed.push_str(source.get(done..).unwrap_or_default());
        changed
    }
}
