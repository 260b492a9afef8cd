//! Enums, records and messages: types that a program makes.

use super::item::name;
use super::{Parser, SyntaxKind, SyntaxKind::*, types};

/// `enum Name {a, b}`.
pub(super) fn enumeration(parser: &mut Parser<'_>) {
    parser.bump();
    name(parser);
    variants(parser);
}

/// `{a, b}`.
pub(super) fn variants(parser: &mut Parser<'_>) {
    let open = parser.span();
    if !parser.at(LeftBrace) {
        return parser.unexpected("its values in braces, as in `{a, b}`");
    }
    parser.start(VariantList);
    parser.bump();
    if parser.at(RightBrace) {
        parser.unexpected("a name");
    }
    parser.separated(RightBrace, open, name);
    parser.finish();
}

/// `record Name {x: Int, y: Point}`.
pub(super) fn record(parser: &mut Parser<'_>) {
    parser.bump();
    name(parser);
    fields(parser, LeftBrace, RightBrace);
}

/// `message Name(x: Int, y: Point)`.
pub(super) fn message(parser: &mut Parser<'_>) {
    parser.bump();
    name(parser);
    fields(parser, LeftParen, RightParen);
}

fn fields(parser: &mut Parser<'_>, opening: SyntaxKind, closing: SyntaxKind) {
    let open = parser.span();
    if !parser.at(opening) {
        let form = if opening == LeftParen {
            "`(x: Int)`"
        } else {
            "`{x: Int}`"
        };
        return parser.unexpected(&alloc::format!("fields in brackets, as in {form}"));
    }
    parser.start(FieldList);
    parser.bump();
    parser.separated(closing, open, |parser| typed_name(parser, Field));
    parser.finish();
}

/// `name: Type`, a node of the given kind.
pub(super) fn typed_name(parser: &mut Parser<'_>, kind: SyntaxKind) {
    let start = parser.checkpoint_with_documentation();
    parser.start_at(start, kind);
    name(parser);
    if parser.expect(Colon) {
        types::any(parser);
    }
    parser.finish();
}
