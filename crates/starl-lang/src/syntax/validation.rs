//! Problems that are the consequences of others.

use alloc::vec::Vec;

use crate::diagnostic::{Code, Diagnostic, Span};

/// Drops reports of unclosed brackets on a line that ends in an unterminated string: it contains the closing brackets.
pub(super) fn forget_swallowed(text: &str, diagnostics: &mut Vec<Diagnostic>) {
    let is_open = |problem: &&Diagnostic| {
        problem.code == Code::MalformedString && problem.span.of(text).starts_with('"')
    };
    let open = diagnostics.iter().filter(is_open);
    let strings: Vec<Span> = open.map(|problem| problem.span).collect();
    let is_swallowed = |open: Span| {
        strings.iter().any(|string| {
            open.end <= string.start && !Span::new(open.end, string.start).of(text).contains('\n')
        })
    };
    diagnostics.retain(|problem| {
        problem.code != Code::UnbalancedBracket
            || problem.span.of(text).starts_with([')', ']', '}'])
            || !is_swallowed(problem.span)
    });
}
