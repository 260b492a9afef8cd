//! From text to tokens.
//!
//! The tokens cover the text: concatenated they are the text. No text is rejected; malformed parts are tokens too, and
//! [`problems`] reports their errors. Spellings of other languages and of printed mathematics become the intended token
//! (`&&` is an `and`, `≤` a `<=`), so that the parser need not know them.

mod number;
mod problems;
mod quoted;
mod symbol;

use alloc::vec::Vec;

use super::SyntaxKind::{self, *};
use crate::diagnostic::Span;

pub(crate) use problems::problems;

/// The tokens of a text.
pub(crate) struct Tokens {
    kinds: Vec<SyntaxKind>,
    /// Where each starts, and after them where the text ends.
    starts: Vec<u32>,
}

impl Tokens {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.kinds.len()
    }

    /// The kind of the token; [`EndOfFile`] after the last.
    pub fn kind(&self, index: usize) -> SyntaxKind {
        self.kinds.get(index).copied().unwrap_or(EndOfFile)
    }

    /// Where the token is; empty and at the end after the last.
    pub fn span(&self, index: usize) -> Span {
        let last = self.starts.len() - 1;
        Span::new(
            self.starts[index.min(last)],
            self.starts[(index + 1).min(last)],
        )
    }

    /// The kinds in order.
    pub fn kinds(&self) -> &[SyntaxKind] {
        &self.kinds
    }
}

/// The tokens of `text`.
pub(crate) fn lex(text: &str) -> Tokens {
    let mut tokens = Tokens {
        kinds: Vec::with_capacity(text.len() / 3),
        starts: Vec::with_capacity(text.len() / 3),
    };
    let mut at = 0;
    while at < text.len() {
        let before = tokens.kinds.iter().rev().find(|kind| **kind != Whitespace);
        let (kind, length) = match before {
            Some(Dot) if text.as_bytes()[at].is_ascii_digit() => number::part(&text[at..]),
            _ => token(&text[at..]),
        };
        // A byte order mark is as good as nothing at the start.
        let kind = if at == 0 && text.starts_with('\u{feff}') {
            Whitespace
        } else {
            kind
        };
        tokens.kinds.push(kind);
        tokens.starts.push(at as u32);
        at += length;
    }
    tokens.starts.push(text.len() as u32);
    tokens
}

/// The first token of a text that is not empty, and its length in bytes.
fn token(text: &str) -> (SyntaxKind, usize) {
    let first = text.chars().next().unwrap_or_default();
    match first {
        '\n' => (Newline, 1),
        '\r' if text.starts_with("\r\n") => (Newline, 2),
        ' ' | '\t' | '\r' => (Whitespace, whitespace(text)),
        '/' if text.starts_with("//") => (comment(text), to_end_of_line(text)),
        // One that is not closed must not swallow the rest of the program.
        '/' if text.starts_with("/*") => (
            Comment,
            text.find("*/")
                .map_or_else(|| to_end_of_line(text), |at| at + 2),
        ),
        '#' => (Comment, to_end_of_line(text)),
        '"' => quoted::quoted(text, '"'),
        '\'' => quoted::quoted(text, '\''),
        '0'..='9' => number::number(text),
        _ if is_name_start(first) => {
            let length = name(text);
            (
                SyntaxKind::keyword(&text[..length]).unwrap_or(Identifier),
                length,
            )
        }
        _ => symbol::symbol(text, first),
    }
}

/// `///` documents, `//` and `////` do not.
fn comment(text: &str) -> SyntaxKind {
    if text.starts_with("///") && !text.starts_with("////") {
        DocComment
    } else {
        Comment
    }
}

fn to_end_of_line(text: &str) -> usize {
    let end = text.find('\n').unwrap_or(text.len());
    if text[..end].ends_with('\r') {
        end - 1
    } else {
        end
    }
}

fn whitespace(text: &str) -> usize {
    let blank = |byte: &u8| matches!(byte, b' ' | b'\t' | b'\r');
    let length = text.bytes().take_while(blank).count();
    // The carriage return of a line's end belongs to that.
    if text[..length].ends_with('\r') && text[length..].starts_with('\n') {
        length - 1
    } else {
        length
    }
}

/// Whether a name may start so; letters other than a to z are reported, but are letters.
fn is_name_start(character: char) -> bool {
    character == '_' || character.is_alphabetic()
}

/// The length of the letters, digits and underscores at the start.
fn name(text: &str) -> usize {
    let other = |character: char| character != '_' && !character.is_alphanumeric();
    text.find(other).unwrap_or(text.len())
}
