//! Shared variables: `allread pos[RobotId]: Point` and `allwrite sum: Int = 0`.

use alloc::format;

use super::slips::type_of;
use super::{Code, Diagnostic, Parser, Span, SyntaxKind::*};

impl Parser<'_> {
    /// `allread name[RobotId]: Type`: one element for each robot, which only that robot writes.
    pub(super) fn all_read(&mut self) {
        self.word_and_name();
        self.array_index();
        self.type_and_value();
    }

    /// `allwrite name: Type`: one variable that every robot writes.
    pub(super) fn all_write(&mut self) {
        self.word_and_name();
        if self.at(LeftBracket) {
            let open = self.span();
            let message = "a variable that all robots write is not an array";
            let problem = Diagnostic::new(Code::Unexpected, open, message);
            self.report(
                problem
                    .note("use `allread` for an array in which each robot writes its own element"),
            );
            self.array_index();
        }
        self.type_and_value();
    }

    /// The word with the consistency in brackets, if that is named, and the name.
    fn word_and_name(&mut self) {
        self.bump();
        if self.at(LeftBracket) {
            let open = self.span();
            self.start(Consistency);
            self.bump();
            self.expect(Identifier);
            self.close(RightBracket, open);
            self.finish();
        }
        if self.at(Identifier) && self.nth(1) == Identifier {
            self.type_first();
        }
        self.name();
    }

    /// Koord's `allwrite int sum`.
    fn type_first(&mut self) {
        let (word, named) = (self.span(), self.nth_span(1));
        let both = word.to(named);
        let message = "the type of a variable stands after its name";
        let problem = Diagnostic::new(Code::ForeignDeclaration, both, message);
        let form = format!("{}: {}", named.of(self.text), type_of(self.word()));
        self.report(problem.write(both, form));
        self.any_type();
    }

    /// `[RobotId]`.
    fn array_index(&mut self) {
        let open = self.span();
        if !self.at(LeftBracket) {
            let place = Span::empty(self.end_of_last());
            let message = "an `allread` variable has an element for each robot";
            let problem = Diagnostic::new(Code::Unexpected, place, message);
            return self.report(problem.expected("`[RobotId]`").write(place, "[RobotId]"));
        }
        self.start(TypeArguments);
        self.bump();
        self.any_type();
        self.close(RightBracket, open);
        self.finish();
    }

    /// `: Type`, which Koord leaves out, and a value.
    fn type_and_value(&mut self) {
        if self.at(Colon) {
            self.bump();
            self.any_type();
        } else if self
            .diagnostics
            .last()
            .is_none_or(|last| last.code != Code::ForeignDeclaration)
        {
            self.expect(Colon);
        }
        self.initial_value();
    }

    /// Whether an array is declared next in the syntax of other languages: `name[...]: Type`.
    pub(super) fn is_array(&self) -> bool {
        match self.nth(2) {
            RightBracket => self.nth(3) == Colon,
            _ => self.nth(3) == RightBracket && self.nth(4) == Colon,
        }
    }

    /// `name[RobotId]: Type` without `allread`, or `name[]: Type`.
    pub(super) fn shared_without_word(&mut self) {
        let span = self.span();
        if self.nth(2) == RightBracket {
            let place = span.to(self.nth_span(2));
            let form = format!("`{}: List[...]`", self.word());
            self.report(
                Diagnostic::new(
                    Code::ForeignDeclaration,
                    place,
                    "a list is declared by its type",
                )
                .expected(form),
            );
        } else {
            let problem = Diagnostic::new(
                Code::ForeignDeclaration,
                span,
                "a variable with an element for each robot is shared and begins with `allread`",
            );
            self.report(problem.write(Span::empty(span.start), "allread "));
        }
        self.name();
        if self.nth(1) == RightBracket {
            self.start(Error);
            self.bump();
            self.bump();
            self.finish();
        } else {
            self.array_index();
        }
        self.type_and_value();
    }
}
