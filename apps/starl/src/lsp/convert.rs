//! From the language's places and kinds to those of the protocol.

use lsp_types::{Position, Range, TextEdit};
use starl_editor::{Utf16Lines, Utf16Position};
use starl_lang::diagnostic::{Edit, Span};

/// A text with its lines.
pub struct Text<'a> {
    text: &'a str,
    lines: Utf16Lines,
}

impl<'a> Text<'a> {
    /// A text.
    pub fn new(text: &'a str) -> Text<'a> {
        let lines = Utf16Lines::new(text);
        Text { text, lines }
    }

    /// The byte at a place.
    pub fn offset(&self, position: Position) -> u32 {
        self.lines.offset(self.text, place(position))
    }

    /// A part.
    pub fn range(&self, span: Span) -> Range {
        let range = self.lines.range(self.text, span);
        let position = |place: Utf16Position| Position::new(place.line, place.column);
        Range::new(position(range.start), position(range.end))
    }

    /// A part in bytes.
    pub fn span(&self, range: Range) -> Span {
        Span::new(self.offset(range.start), self.offset(range.end))
    }

    /// A change.
    pub fn edit(&self, edit: &Edit) -> TextEdit {
        TextEdit::new(self.range(edit.span), edit.text.clone())
    }
}

/// A place.
pub fn place(position: Position) -> Utf16Position {
    Utf16Position {
        line: position.line,
        column: position.character,
    }
}
