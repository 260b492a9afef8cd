//! Enums, records and messages: types that a program makes.

use super::item::name;
use alloc::format;

use super::{Code, Diagnostic, Parser, Span, SyntaxKind, SyntaxKind::*, types};
use crate::diagnostic::{Edit, Fix};

/// `enum Name {a, b}`.
pub(super) fn enumeration(parser: &mut Parser<'_>) {
    parser.bump();
    name(parser);
    variants(parser);
}

/// `{a, b}`.
pub(super) fn variants(parser: &mut Parser<'_>) {
    if !matches!(parser.current(), LeftBrace | LeftParen | LeftBracket) {
        return parser.unexpected("its values in braces, as in `{a, b}`");
    }
    parser.start(VariantList);
    bracketed(parser, LeftBrace, |parser, closing, open| {
        if parser.at(closing) {
            parser.unexpected("a name");
        }
        parser.separated(closing, open, name);
    });
    parser.finish();
}

/// `record Name {x: Int, y: Point}`.
pub(super) fn record(parser: &mut Parser<'_>) {
    parser.bump();
    name(parser);
    fields(parser, LeftBrace);
}

/// `message Name(x: Int, y: Point)`.
pub(super) fn message(parser: &mut Parser<'_>) {
    parser.bump();
    name(parser);
    fields(parser, LeftParen);
}

fn fields(parser: &mut Parser<'_>, opening: SyntaxKind) {
    let is_named = parser.last_error != Some(parser.position);
    if parser.at_line_end() && opening == LeftParen && is_named {
        let place = Span::empty(parser.end_of_last());
        let message = "a message has brackets after its name, also without fields";
        let problem = Diagnostic::new(Code::Unexpected, place, message);
        return parser.report(problem.replace("write `()`", place, "()"));
    }
    if !matches!(parser.current(), LeftBrace | LeftParen) {
        let form = if opening == LeftParen {
            "`(x: Int)`"
        } else {
            "`{x: Int}`"
        };
        return parser.unexpected(&alloc::format!("fields in brackets, as in {form}"));
    }
    parser.start(FieldList);
    bracketed(parser, opening, |parser, closing, open| {
        parser.separated(closing, open, |parser| typed_name(parser, Field));
    });
    parser.finish();
}

/// Brackets, the first of which is next, and their contents; reports them if they are not of the kind `opening`.
fn bracketed(
    parser: &mut Parser<'_>,
    opening: SyntaxKind,
    inner: impl FnOnce(&mut Parser<'_>, SyntaxKind, Span),
) {
    let (found, open) = (parser.current(), parser.span());
    let Some(closing) = found.closing() else {
        return;
    };
    parser.bump();
    inner(parser, closing, open);
    let end = parser.end_of_last();
    let close = Span::new(end.saturating_sub(1), end);
    let texts = (opening.text(), opening.closing().and_then(SyntaxKind::text));
    if let (Some(left), Some(right)) = texts
        && found != opening
        && close.of(parser.text) == closing.text().unwrap_or_default()
    {
        let problem = Diagnostic::new(
            Code::Unexpected,
            open,
            format!("this is written between `{left}` and `{right}`"),
        );
        let edits = [Edit::new(open, left), Edit::new(close, right)].into();
        let message = format!("write `{left}` and `{right}`");
        parser.report(problem.fix(Fix { message, edits }));
    }
}

/// `name: Type`, a node of the given kind.
pub(super) fn typed_name(parser: &mut Parser<'_>, kind: SyntaxKind) {
    let start = parser.checkpoint_with_documentation();
    parser.start_at(start, kind);
    if parser.at(Identifier) && parser.nth(1) == Identifier {
        let (ty, named) = (parser.span(), parser.nth_span(1));
        let meant = super::slips::type_of(ty.of(parser.text));
        let form = format!("{}: {meant}", named.of(parser.text));
        let message = "the type stands after the name";
        let problem = Diagnostic::new(Code::ForeignDeclaration, ty.to(named), message);
        parser.report(problem.replace(format!("write `{form}`"), ty.to(named), form));
        parser.start(Error);
        parser.bump();
        parser.finish();
        name(parser);
        return parser.finish();
    }
    let named = parser.span();
    let is_name = parser.at(Identifier);
    name(parser);
    if is_name && matches!(parser.current(), Comma | RightParen | RightBrace) {
        let text = named.of(parser.text);
        let problem = Diagnostic::new(Code::Unexpected, named, format!("`{text}` needs a type"));
        parser.report(problem.expected(format!("`{text}: Int` or another type")));
    } else if parser.expect(Colon) {
        types::any(parser);
    }
    parser.finish();
}
