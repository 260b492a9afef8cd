//! Properties: `invariant name: condition`, `eventually name: condition within 30s`,
//! `always name: condition leads_to condition within 30s`.

use super::item::name;
use super::{Parser, SyntaxKind::*, expression};

/// Whether the word that is next begins a property rather than naming something.
pub(super) fn is_next(parser: &Parser<'_>) -> bool {
    match parser.nth(1) {
        LeftParen => !super::action::is_header(parser),
        Equal | Dot | LeftBracket | Newline | EndOfFile | Dedent | Semicolon => false,
        // `always: Bool` would be a variable, but a property may have no name.
        _ => true,
    }
}

/// A property, whose name may be missing.
pub(super) fn property(parser: &mut Parser<'_>) {
    parser.bump();
    if parser.nth(1) == Colon && (parser.at(Identifier) || parser.current().is_keyword()) {
        name(parser);
    }
    parser.eat(Colon);
    expression::condition(parser);
    if parser.at_word("leads_to") {
        parser.bump();
        expression::condition(parser);
    }
    if parser.at_word("within") {
        parser.bump();
        expression::expression(parser);
    }
}
