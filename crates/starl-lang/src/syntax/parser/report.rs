//! Reporting problems.

use alloc::string::String;

use super::{Code, Diagnostic, Parser, Span, SyntaxKind::*};
use crate::diagnostic::Severity;

impl Parser<'_> {
    pub fn report(&mut self, diagnostic: Diagnostic) {
        if diagnostic.severity() == Severity::Error {
            self.last_report = Some(diagnostic.span.end);
        }
        self.diagnostics.push(diagnostic);
    }

    /// Reports that something else must stand here; once for each place.
    pub fn unexpected(&mut self, expected: &str) {
        let start = self.span().start;
        let known = self.is_unpaired(start) && !self.at_line_end();
        let known = known || self.follows_unknown();
        if self.last_error.replace(self.position) == Some(self.position) || known {
            return;
        }
        let found = self.found();
        let (span, message) = if self.at_line_end() {
            (
                Span::empty(self.end_of_last()),
                alloc::format!("{expected} is missing"),
            )
        } else {
            (self.span(), alloc::format!("{found} cannot stand here"))
        };
        let code = Code::Unexpected;
        let problem = Diagnostic::new(code, span, message)
            .expected(expected)
            .found(found);
        self.report(self.with_habit(expected, problem));
    }

    /// Whether an invalid character, which is reported, directly precedes the next token.
    pub fn follows_unknown(&self) -> bool {
        let next = self.next_token();
        let mut before = (0..next).rev().map(|index| self.tokens.kind(index));
        before.find(|kind| *kind != Whitespace) == Some(Unknown)
    }

    /// The name of the next lexeme in messages.
    pub fn found(&self) -> String {
        match self.current() {
            kind if kind.text().is_some() => kind.name().into(),
            kind @ (Newline | Indent | Dedent | EndOfFile) => kind.name().into(),
            _ => alloc::format!("`{}`", self.word()),
        }
    }
}
