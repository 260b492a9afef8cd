//! Types: `Int`, `List[Point]`, `Map[String, Int]?`, `geometry.Line`, `enum {a, b}`.

use alloc::format;

use super::slips::type_of;
use super::{Code, Diagnostic, Parser, Span, SyntaxKind, SyntaxKind::*};
use crate::diagnostic::Edit;

/// The message about a tuple of one part.
pub(super) const SHORT_TUPLE: &str = "a tuple has at least two parts";

impl Parser<'_> {
    /// Parses a type, or reports that it is missing.
    pub(super) fn any_type(&mut self) {
        let start = self.checkpoint();
        if self.deeper(Self::single_type).is_none_or(|found| !found) {
            return;
        }
        // More than one question mark says no more than one; the checker tells.
        let mut optional = 0;
        while matches!(self.current(), Question | QuestionQuestion) && optional < 8 {
            self.start_at(start, OptionalType);
            self.bump();
            self.finish();
            optional += 1;
        }
    }

    fn single_type(&mut self) -> bool {
        if self.at_word("enum") && self.nth(1) == LeftBrace {
            self.start(EnumType);
            self.bump();
            self.variants();
            self.finish();
            return true;
        }
        if self.at(LeftParen) {
            self.tuple_type();
            return true;
        }
        if !self.at(Identifier) {
            self.unexpected("a type");
            return false;
        }
        self.start(NamedType);
        let name = self.span();
        self.bump();
        if self.at(LeftBracket) && self.nth(1) == RightBracket {
            let span = name.to(self.nth_span(1));
            let form = format!("List[{}]", type_of(name.of(self.text)));
            let problem =
                Diagnostic::new(Code::Unexpected, span, "a list is written with its type");
            self.report(problem.write(span, form));
            self.start(Error);
            self.bump();
            self.bump();
            self.finish();
        }
        if self.at(Dot) {
            self.bump();
            self.expect(Identifier);
        }
        let is_collection = matches!(name.of(self.text), "List" | "Set" | "Map" | "Optional");
        match self.current() {
            LeftBracket => self.type_arguments(),
            Less => self.angle_arguments(Greater),
            LeftParen if is_collection => self.angle_arguments(RightParen),
            _ => {}
        }
        self.finish();
        true
    }

    /// `(Int, RobotId)`
    fn tuple_type(&mut self) {
        let open = self.span();
        self.start(TupleType);
        self.bump();
        let mut parts = 0;
        if self.at(RightParen) {
            self.unexpected("a type");
        }
        self.separated(RightParen, open, |parser| {
            parts += 1;
            parser.any_type();
        });
        if parts == 1 && self.last_error != Some(self.position) {
            let span = open.to(Span::empty(self.end_of_last()));
            let inner = span.of(self.text).trim_start_matches('(');
            let inner = inner.trim_end_matches([')', ',', ' ']);
            let problem = Diagnostic::new(Code::ShortTuple, span, SHORT_TUPLE);
            self.report(problem.write(span, inner));
        }
        self.finish();
    }

    fn type_arguments(&mut self) {
        let open = self.span();
        self.start(TypeArguments);
        self.bump();
        if self.at(RightBracket) {
            self.unexpected("a type");
        }
        self.separated(RightBracket, open, Self::any_type);
        self.finish();
    }

    /// `List<Int>` or `List(Int)`, which is written `List[Int]`.
    fn angle_arguments(&mut self, closing: SyntaxKind) {
        let open = self.span();
        let message = "type arguments are in square brackets";
        let problem = Diagnostic::new(Code::Unexpected, open, message);
        self.start(TypeArguments);
        self.bump();
        self.any_type();
        while self.eat(Comma) {
            self.any_type();
        }
        let close = self.span();
        if self.at(closing) {
            self.bump();
            let edits = [Edit::new(open, "["), Edit::new(close, "]")];
            self.report(problem.edits("write it in square brackets", edits));
        } else {
            self.report(problem);
            self.last_error = Some(self.position);
        }
        self.finish();
    }
}
