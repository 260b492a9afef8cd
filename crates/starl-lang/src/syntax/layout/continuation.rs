//! Lines that continue in the next one, if that is indented deeper than the line in which they began: a line that ends
//! in a binary operator, `and`, `or` or a comma, and every line of a property.

use super::super::SyntaxKind::*;
use super::{Lexeme, Tokens, next_line};

/// The first token of the continuation of the line that ends at the token `newline`, if there is one. The arguments
/// describe the line: its tokens so far, its first token and its indentation.
pub(super) fn rest(
    text: &str,
    tokens: &Tokens,
    lexemes: &[Lexeme],
    newline: usize,
    first: usize,
    column: u32,
) -> Option<usize> {
    let last = lexemes.last()?;
    if !last.kind.continues_line() && !is_property(text, tokens, first) {
        return None;
    }
    next_line(text, tokens, newline + 1)
        .filter(|next| next.column > column)
        .map(|next| next.first)
}

/// Whether the line that starts with the token `first` is a property or a check, which have no block.
fn is_property(text: &str, tokens: &Tokens, first: usize) -> bool {
    let word = tokens.span(first).of(text);
    let second = (first + 1..tokens.len())
        .map(|index| tokens.kind(index))
        .find(|kind| !kind.is_trivia());
    matches!(word, "invariant" | "always" | "eventually" | "check")
        && !matches!(
            second,
            Some(LeftParen | Equal | Newline | Dot | LeftBracket) | None
        )
}
