//! Properties and checks: `invariant name: condition`, `eventually name: condition within 30s`,
//! `always name: condition leads_to condition within 30s`, `check condition`.

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

/// Whether the word `check` that is next begins a check: `check: Bool` is a variable.
pub(super) fn is_check(parser: &Parser<'_>) -> bool {
    parser.nth(1) != Colon && (parser.nth(1) == LeftBracket || is_next(parser))
}

/// A check, which has no name.
pub(super) fn check(parser: &mut Parser<'_>) {
    parser.bump();
    expression::condition(parser);
}

/// A property, whose name may be missing.
pub(super) fn property(parser: &mut Parser<'_>) {
    let is_eventual = parser.at_word("eventually");
    parser.bump();
    if is_eventual && parser.at_word("always") && parser.nth(1) != Colon {
        parser.bump();
    }
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
    if parser.at_word("recovers") {
        parser.bump();
        word(parser, "within");
        expression::expression(parser);
    }
    if parser.at_word("assuming") {
        parser.bump();
        expression::condition(parser);
    }
    if parser.at_word("despite") {
        parser.bump();
        word(parser, "crashes");
    }
}

/// A word that has to come next.
fn word(parser: &mut Parser<'_>, expected: &str) {
    if parser.at_word(expected) {
        parser.bump();
    } else {
        parser.unexpected(&alloc::format!("`{expected}`"));
    }
}
