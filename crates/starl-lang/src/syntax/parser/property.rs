//! Properties and checks: `invariant name: condition`, `eventually name: condition within 30s`,
//! `always name: condition leads_to condition within 30s`, `check condition`.

use super::{Code, Diagnostic, Parser, Span, SyntaxKind::*};
use crate::diagnostic::Edit;

impl Parser<'_> {
    /// Whether the word that is next begins a property rather than naming something.
    pub(super) fn is_property(&self) -> bool {
        match self.nth(1) {
            LeftParen => !self.is_action_header(1),
            Equal | Dot | LeftBracket | Newline | EndOfFile | Dedent | Semicolon => false,
            // `always: Bool` would be a variable, but a property may have no name.
            _ => true,
        }
    }

    /// Whether the word `check` that is next begins a check: `check: Bool` is a variable.
    pub(super) fn is_check(&self) -> bool {
        // `check: n < 5` has a colon that does not belong there.
        let compares = self.nth(2) == Identifier
            && (self.nth(3).is_comparison() || matches!(self.nth(3), Dot | InKeyword));
        let second = self.nth_span(2).of(self.text);
        let is_small = second.starts_with(|first: char| first.is_ascii_lowercase());
        match self.nth(1) {
            Colon => compares && is_small || self.nth(2) == NotKeyword,
            next => next == LeftBracket || self.is_property(),
        }
    }

    /// A check, which has no name.
    pub(super) fn check(&mut self) {
        self.bump();
        let is_named = self.at(Identifier) && self.nth(1) == Colon;
        if is_named || self.at(Colon) {
            let last = self.nth_span(usize::from(is_named));
            let next = self.nth_span(usize::from(is_named) + 1).start;
            let message = "a check has no name and no colon";
            let problem = Diagnostic::new(Code::Unexpected, self.span().to(last), message);
            let place = match is_named {
                true => Span::new(self.span().start, next),
                false => last,
            };
            self.report(problem.replace("write the condition after `check`", place, ""));
            self.start(Error);
            (0..=usize::from(is_named)).for_each(|_| self.bump());
            self.finish();
        }
        self.condition();
    }

    /// A property, whose name may be missing.
    pub(super) fn property(&mut self) {
        let (begin, is_eventual) = (self.span(), self.at_word("eventually"));
        let is_never = self.at_word("never");
        self.bump();
        let is_always = is_eventual && self.at_word("always") && self.nth(1) != Colon;
        if is_always {
            self.bump();
        }
        if self.at_word("within") && self.nth(1) != Colon {
            let from = self.span();
            self.bump();
            self.expression();
            let span = from.to(Span::empty(self.end_of_last()));
            let deadline = span.of(self.text);
            let message = "a property ends with its deadline";
            let problem = Diagnostic::new(Code::Unexpected, span, message);
            let form = alloc::format!("write `eventually: condition {deadline}`");
            self.report(problem.note(form));
        }
        let begins = self.end_of_last();
        let named = self.nth(1) == Colon && (self.at(Identifier) || self.current().is_keyword());
        if named || self.is_property_name() {
            self.name();
        }
        let colon = self.eat(Colon);
        let (head, first) = (self.end_of_last(), self.span().start);
        self.condition();
        if is_never {
            self.never(begin, (!colon).then_some(head), first);
        } else if !colon && first > head {
            let place = Span::empty(head);
            let message = "`:` is missing before the condition of a property";
            let problem = Diagnostic::new(Code::Unexpected, place, message);
            // With the colon alone, `always` would be its name.
            self.report(match is_always && begins == head {
                true => problem.note("write `eventually always name: condition`, with a name"),
                false => problem.write(place, ":"),
            });
        }
        let leads = self.at_word("leads") && self.nth_span(1).of(self.text) == "to";
        if leads {
            let span = self.span().to(self.nth_span(1));
            self.report_operator(span, "this is one word", "leads_to");
            self.bump();
            self.bump();
        }
        if leads || self.eat_word("leads_to") {
            self.condition();
        }
        if self.deadline() || self.eat_word("within") {
            self.expression();
        }
        if self.eat_word("recovers") {
            self.expect_word("within");
            self.expression();
        }
        if self.eat_word("assuming") {
            self.condition();
        }
        if self.eat_word("despite") {
            self.expect_word("crashes");
        }
    }

    /// Whether the name of a property is next, without the colon after it.
    fn is_property_name(&self) -> bool {
        let next = self.nth_span(1).of(self.text);
        let begins = match self.nth(1) {
            Identifier => !CLAUSES.contains(&next),
            kind => kind.is_literal() || matches!(kind, NotKeyword | SomeKeyword | IfKeyword),
        };
        let quantified = matches!(self.word(), "forall" | "exists");
        self.at(Identifier) && begins && !quantified && self.foreign_operator(1).is_none()
    }

    /// Reports `never p`, whose condition starts at the byte `first`, after the byte `head` if a colon is missing there.
    fn never(&mut self, word: Span, head: Option<u32>, first: u32) {
        let message = "`never` does not begin a property";
        let problem = Diagnostic::new(Code::ForeignDeclaration, word, message);
        let mut edits = alloc::vec![Edit::new(word, "always")];
        edits.extend(head.map(|head| Edit::new(Span::empty(head), ":")));
        edits.push(Edit::new(Span::empty(first), "not ("));
        edits.push(Edit::new(Span::empty(self.end_of_last().max(first)), ")"));
        self.report(problem.edits("write `always: not (...)`", edits));
    }

    /// `forall r: condition`, which is a property without its first word.
    pub(super) fn property_without_word(&mut self) {
        let start = self.span().start;
        let message = "a property begins with `always` or `eventually`";
        let problem = Diagnostic::new(Code::ForeignDeclaration, self.span(), message);
        self.report(problem.write(Span::empty(start), "always: "));
        self.condition();
    }

    /// A word that has to come next.
    fn expect_word(&mut self, expected: &str) {
        if !self.eat_word(expected) {
            self.unexpected(&alloc::format!("`{expected}`"));
        }
    }
}

/// Words that follow the condition of a property.
const CLAUSES: [&str; 7] = [
    "within", "leads_to", "recovers", "assuming", "despite", "before", "until",
];
