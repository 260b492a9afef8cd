//! Enums, records and messages: types that a program makes.

use alloc::format;

use super::slips::type_of;
use super::{Code, Diagnostic, Parser, Span, SyntaxKind, SyntaxKind::*};
use crate::diagnostic::Edit;

impl Parser<'_> {
    /// `enum Name {a, b}`.
    pub(super) fn enumeration(&mut self) {
        self.bump();
        self.name();
        self.variants();
    }

    /// `{a, b}`.
    pub(super) fn variants(&mut self) {
        if !matches!(self.current(), LeftBrace | LeftParen | LeftBracket) {
            return self.unexpected("its values in braces, as in `{a, b}`");
        }
        self.start(VariantList);
        self.in_any_brackets(LeftBrace, |parser, closing, open| {
            if parser.at(closing) {
                parser.unexpected("a name");
            }
            parser.separated(closing, open, Self::name);
        });
        self.finish();
    }

    /// `record Name {x: Int, y: Point}`.
    pub(super) fn record(&mut self) {
        self.bump();
        self.name();
        self.fields(LeftBrace);
    }

    /// `message Name(x: Int, y: Point)`.
    pub(super) fn message(&mut self) {
        self.bump();
        self.name();
        self.fields(LeftParen);
    }

    fn fields(&mut self, opening: SyntaxKind) {
        let is_named = self.last_error != Some(self.position);
        if self.at_line_end() && opening == LeftParen && is_named {
            let place = Span::empty(self.end_of_last());
            let message = "a message has brackets after its name, also without fields";
            let problem = Diagnostic::new(Code::Unexpected, place, message);
            return self.report(problem.write(place, "()"));
        }
        if !matches!(self.current(), LeftBrace | LeftParen) {
            let form = if opening == LeftParen {
                "`(x: Int)`"
            } else {
                "`{x: Int}`"
            };
            return self.unexpected(&alloc::format!("fields in brackets, as in {form}"));
        }
        self.start(FieldList);
        self.in_any_brackets(opening, |parser, closing, open| {
            parser.separated(closing, open, |parser| parser.typed_name(Field));
        });
        self.finish();
    }

    /// Brackets, the first of which is next, and their contents; reports them if they are not of the kind `opening`.
    fn in_any_brackets(
        &mut self,
        opening: SyntaxKind,
        inner: impl FnOnce(&mut Self, SyntaxKind, Span),
    ) {
        let (found, open) = (self.current(), self.span());
        let Some(closing) = found.closing() else {
            return;
        };
        self.bump();
        inner(self, closing, open);
        let end = self.end_of_last();
        let close = Span::new(end.saturating_sub(1), end);
        let texts = (opening.text(), opening.closing().and_then(SyntaxKind::text));
        if let (Some(left), Some(right)) = texts
            && found != opening
            && close.of(self.text) == closing.text().unwrap_or_default()
        {
            let message = format!("this is written between `{left}` and `{right}`");
            let problem = Diagnostic::new(Code::Unexpected, open, message);
            let edits = [Edit::new(open, left), Edit::new(close, right)];
            let message = format!("write `{left}` and `{right}`");
            self.report(problem.edits(message, edits));
        }
    }

    /// `name: Type`, a node of the given kind.
    pub(super) fn typed_name(&mut self, kind: SyntaxKind) {
        let start = self.checkpoint_with_documentation();
        self.start_at(start, kind);
        if self.at(Identifier) && self.nth(1) == Identifier {
            let (ty, named) = (self.span(), self.nth_span(1));
            let meant = type_of(ty.of(self.text));
            let form = format!("{}: {meant}", named.of(self.text));
            let message = "the type stands after the name";
            let problem = Diagnostic::new(Code::ForeignDeclaration, ty.to(named), message);
            self.report(problem.write(ty.to(named), form));
            self.bump_error();
            self.name();
            return self.finish();
        }
        let named = self.span();
        let is_name = self.at(Identifier);
        self.name();
        if is_name && matches!(self.current(), Comma | RightParen | RightBrace) {
            let text = named.of(self.text);
            let problem =
                Diagnostic::new(Code::Unexpected, named, format!("`{text}` needs a type"));
            self.report(problem.expected(format!("`{text}: Int` or another type")));
        } else if self.expect(Colon) {
            self.any_type();
        }
        self.finish();
    }
}
