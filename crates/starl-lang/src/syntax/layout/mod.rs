//! Finds the significant line ends, and the begins and ends of blocks.
//!
//! The parser sees the tokens without trivia, and between them where a block begins ([`Indent`]) and ends ([`Dedent`]).
//! Those two have no text; each refers to the token after it, so that a comment belongs to the block with its
//! indentation.

mod brackets;
mod continuation;
mod indentation;

use alloc::vec;
use alloc::vec::Vec;

use super::SyntaxKind::{self, *};
use super::lexer::Tokens;
use crate::diagnostic::Diagnostic;

/// One thing that the parser sees.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lexeme {
    /// Its kind: a token other than trivia, [`Indent`] or [`Dedent`].
    pub kind: SyntaxKind,
    /// Which token it is; for the two without text, before which token it stands.
    pub index: u32,
}

/// A line of the text that holds a token other than trivia.
struct Line {
    /// Its first token other than trivia.
    first: usize,
    /// Its indentation in characters.
    column: u32,
}

/// The lexemes of `tokens` for the parser, and the problems with indentation and brackets.
pub(crate) fn arrange(text: &str, tokens: &Tokens) -> (Vec<Lexeme>, Vec<Diagnostic>) {
    let mut diagnostics = Vec::new();
    indentation::report_tabs(text, tokens, &mut diagnostics);
    let pairs = brackets::pairs(text, tokens, &mut diagnostics);

    let mut lexemes = Vec::with_capacity(tokens.len() / 2);
    let mut levels = vec![0];
    let mut depth = 0_u32;
    let mut next = 0;
    while let Some(line) = next_line(text, tokens, next) {
        indentation::place(
            text,
            tokens,
            &line,
            &mut levels,
            &mut lexemes,
            &mut diagnostics,
        );
        next = line.first;
        // To the end of the line, or of the last of the lines in which it continues.
        while next < tokens.len() {
            let kind = tokens.kind(next);
            if kind == Newline && depth == 0 {
                let rest =
                    continuation::rest(text, tokens, &lexemes, next, line.first, line.column);
                let Some(rest) = rest else {
                    lexemes.push(Lexeme {
                        kind,
                        index: next as u32,
                    });
                    next += 1;
                    break;
                };
                next = rest;
                continue;
            } else if !kind.is_trivia() && kind != Newline {
                if pairs[next] {
                    depth = if kind.is_closing() {
                        depth.saturating_sub(1)
                    } else {
                        depth + 1
                    };
                }
                lexemes.push(Lexeme {
                    kind,
                    index: next as u32,
                });
            }
            next += 1;
        }
    }
    indentation::close(text, tokens, levels, &mut lexemes);
    (lexemes, diagnostics)
}

/// The next line with a token other than trivia, from the token at `from`, which starts a line. The first token in the
/// line gives its indentation, even if it is trivia.
fn next_line(text: &str, tokens: &Tokens, from: usize) -> Option<Line> {
    let (mut column, mut indented) = (0, false);
    for index in from..tokens.len() {
        match tokens.kind(index) {
            Newline => (column, indented) = (0, false),
            Whitespace if indented => {}
            Whitespace => column += indentation::width(tokens.span(index).of(text), column),
            Comment | DocComment | Unknown => indented = true,
            _ => {
                return Some(Line {
                    first: index,
                    column,
                });
            }
        }
    }
    None
}
