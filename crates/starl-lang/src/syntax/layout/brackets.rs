//! Matches brackets.
//!
//! A bracket that is never closed must not swallow the rest of the program: it counts as closed where a line starts
//! with a word that is not allowed in brackets, and then its line is not continued.

use alloc::format;
use alloc::vec;
use alloc::vec::Vec;

use super::super::SyntaxKind::{self, *};
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
    let closing = closing_text(tokens.kind(bracket));
    let message = format!("this `{}` is not closed", span.of(text));
    let problem = Diagnostic::new(Code::UnbalancedBracket, span, message);
    problem.expected(format!("`{closing}`"))
}

fn mismatched(text: &str, tokens: &Tokens, open: usize, close: usize) -> Diagnostic {
    let (open, kind, close) = (tokens.span(open), tokens.kind(open), tokens.span(close));
    let right = closing_text(kind);
    let message = format!(
        "this `{}` does not close a `{}`",
        close.of(text),
        open.of(text)
    );
    Diagnostic::new(Code::UnbalancedBracket, close, message)
        .label(open, "which is open here")
        .write(close, right)
}

fn closing_text(opening: SyntaxKind) -> &'static str {
    let closing = opening.closing().and_then(SyntaxKind::text);
    closing.unwrap_or_default()
}

fn not_opened(text: &str, span: Span) -> Diagnostic {
    let message = format!("this `{}` closes nothing", span.of(text));
    let problem = Diagnostic::new(Code::UnbalancedBracket, span, message);
    problem.replace("remove it", span, "")
}
