//! Matches brackets.
//!
//! A bracket that is never closed must not swallow the rest of the program: it counts as closed where a line starts
//! with a word that is not allowed in brackets, and then its line is not continued.

use alloc::format;
use alloc::vec;
use alloc::vec::Vec;

use super::super::SyntaxKind::*;
use super::super::lexer::Tokens;
use crate::diagnostic::{Code, Diagnostic, Span};

/// For each token whether it is a bracket with a partner; the others are reported.
pub(super) fn pairs(text: &str, tokens: &Tokens, diagnostics: &mut Vec<Diagnostic>) -> Vec<bool> {
    let mut paired = vec![false; tokens.len()];
    let mut open: Vec<usize> = Vec::new();
    let mut line_starts = true;
    for (index, kind) in tokens.kinds().iter().enumerate() {
        match kind {
            Newline => line_starts = true,
            kind if kind.is_trivia() => {}
            OnKeyword | PreKeyword | EffKeyword | LetKeyword | ReturnKeyword | ElifKeyword
                if line_starts =>
            {
                line_starts = false;
                open.drain(..)
                    .for_each(|bracket| diagnostics.push(not_closed(text, tokens, bracket)));
            }
            kind => {
                line_starts = false;
                if kind.closing().is_some() {
                    open.push(index);
                } else if kind.is_closing() {
                    let partner = open
                        .iter()
                        .rposition(|bracket| tokens.kind(*bracket).closing() == Some(*kind));
                    let Some(partner) = partner else {
                        diagnostics.push(match open.pop() {
                            Some(bracket) => mismatched(text, tokens, bracket, index),
                            None => not_opened(text, tokens.span(index)),
                        });
                        continue;
                    };
                    for bracket in open.drain(partner + 1..) {
                        diagnostics.push(not_closed(text, tokens, bracket));
                    }
                    for bracket in open.drain(partner..) {
                        paired[bracket] = true;
                        paired[index] = true;
                    }
                }
            }
        }
    }
    open.drain(..)
        .for_each(|bracket| diagnostics.push(not_closed(text, tokens, bracket)));
    paired
}

fn not_closed(text: &str, tokens: &Tokens, bracket: usize) -> Diagnostic {
    let span = tokens.span(bracket);
    let closing = tokens
        .kind(bracket)
        .closing()
        .and_then(|kind| kind.text())
        .unwrap_or_default();
    Diagnostic::new(
        Code::UnbalancedBracket,
        span,
        format!("this `{}` is not closed", span.of(text)),
    )
    .expected(format!("`{closing}`"))
}

fn mismatched(text: &str, tokens: &Tokens, open: usize, close: usize) -> Diagnostic {
    let (open, kind, close) = (tokens.span(open), tokens.kind(open), tokens.span(close));
    let right = kind
        .closing()
        .and_then(|kind| kind.text())
        .unwrap_or_default();
    let message = format!(
        "this `{}` does not close a `{}`",
        close.of(text),
        open.of(text)
    );
    Diagnostic::new(Code::UnbalancedBracket, close, message)
        .label(open, "which is open here")
        .write(close, right)
}

fn not_opened(text: &str, span: Span) -> Diagnostic {
    Diagnostic::new(
        Code::UnbalancedBracket,
        span,
        format!("this `{}` closes nothing", span.of(text)),
    )
    .replace("remove it", span, "")
}
