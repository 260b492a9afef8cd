//! Places as the Language Server Protocol counts them: lines from 0, and in the line the units of UTF-16,
//! from 0. A line ends with `\n`, `\r\n` or `\r` (protocol 3.17, "Text Documents").

use serde::{Deserialize, Serialize};
use starl_lang::diagnostic::Span;

/// A place between two characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Utf16Position {
    /// The line, from 0.
    pub line: u32,
    /// How many units of UTF-16 stand before it in the line.
    #[serde(rename = "character")]
    pub column: u32,
}

/// A part of a text; the end is excluded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Utf16Range {
    /// Where it starts.
    pub start: Utf16Position,
    /// Where it ends.
    pub end: Utf16Position,
}

/// Where each line of a text starts and ends.
#[derive(Clone, Debug)]
pub struct Utf16Lines {
    /// In bytes, without what ends the line.
    lines: Vec<Span>,
}

impl Utf16Lines {
    /// The lines of `text`.
    #[must_use]
    pub fn new(text: &str) -> Self {
        let mut lines = Vec::new();
        let bytes = text.as_bytes();
        let (mut start, mut at) = (0, 0);
        while at < bytes.len() {
            let ending = match bytes[at] {
                b'\n' => 1,
                b'\r' if bytes.get(at + 1) == Some(&b'\n') => 2,
                b'\r' => 1,
                _ => 0,
            };
            if ending > 0 {
                lines.push(Span::new(start as u32, at as u32));
                start = at + ending;
            }
            at += ending.max(1);
        }
        lines.push(Span::new(start as u32, bytes.len() as u32));
        Self { lines }
    }

    /// The position of the byte at `offset` of `text`, the text that the lines were made of. A byte within a line's
    /// ending counts as the end of the line, a byte within a character as the character's start.
    #[must_use]
    pub fn position(&self, text: &str, offset: u32) -> Utf16Position {
        let after = self.lines.partition_point(|line| line.start <= offset);
        let number = after.saturating_sub(1);
        let line = self.lines[number];
        let mut end = offset.min(line.end) as usize;
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        let before = Span::new(line.start, end as u32).of(text);
        Utf16Position {
            line: number as u32,
            column: before.chars().map(|part| part.len_utf16() as u32).sum(),
        }
    }

    /// The place of a part of `text`.
    #[must_use]
    pub fn range(&self, text: &str, span: Span) -> Utf16Range {
        Utf16Range {
            start: self.position(text, span.start),
            end: self.position(text, span.end),
        }
    }

    /// The byte of `text` at a position. A position beyond the end of a line is the line's end, one beyond the last
    /// line is the end of the text, and one within a character is the character's start.
    #[must_use]
    pub fn offset(&self, text: &str, position: Utf16Position) -> u32 {
        let Some(line) = self.lines.get(position.line as usize) else {
            return text.len() as u32;
        };
        let mut left = position.column;
        let mut offset = line.start;
        for part in line.of(text).chars() {
            let units = part.len_utf16() as u32;
            if left < units {
                break;
            }
            left -= units;
            offset += part.len_utf8() as u32;
        }
        offset
    }
}
