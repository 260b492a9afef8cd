//! Handlers: what a robot does when a message arrives, a primitive reports something, or an operator gives an
//! order.

use super::item::name;
use super::{
    Code, Diagnostic, Parser, Span, SyntaxKind::*, block, declaration, slips, types, words,
};

/// `on Message(from, a, b)`, `on primitive.event(a)` or `on input name(a: T)`, and statements.
pub(super) fn handler(parser: &mut Parser<'_>) {
    let on = parser.span();
    parser.bump();
    after_word(parser, on);
}

/// `when Message(from, a)`, whose first word is `on`.
pub(super) fn without_word(parser: &mut Parser<'_>) {
    let on = parser.span();
    words::replace(parser, "a handler begins with `on`", "on");
    after_word(parser, on);
}

fn after_word(parser: &mut Parser<'_>, on: Span) {
    let begins = matches!(parser.word(), "start" | "init" | "startup" | "begin");
    if begins && matches!(parser.nth(1), Newline | Colon) {
        let span = on.to(parser.span());
        let message = "the statements at the start follow `init`";
        slips::foreign_operator(parser, span, message, ("write `init`", "init"));
        parser.skip_to_line_end();
        return block::indented(parser, "`init`");
    }
    if matches!(parser.word(), "message" | "receive" | "received" | "event")
        && parser.nth(1) == Identifier
    {
        words::remove(parser, "the name of the message or event stands after `on`");
    }
    // `input` may also be the name of a message or of a primitive.
    let next = parser.nth(1);
    if parser.at_word("input") && (next == Identifier || next.is_keyword()) {
        parser.bump();
        name(parser);
        declaration::parameters(parser);
        return block::indented(parser, "a handler");
    }
    parser.start(EventPath);
    if parser.expect(Identifier) && parser.eat(Dot) {
        parser.expect(Identifier);
    }
    parser.finish();
    let open = parser.span();
    if parser.at(LeftParen) {
        parser.start(HandlerParameterList);
        parser.bump();
        parser.separated(RightParen, open, handler_parameter);
        parser.finish();
    } else {
        parser.unexpected("the sender and the fields in brackets, as in `(from, x)`");
    }
    block::indented(parser, "a handler");
}

/// A name, whose type is that of the message's field.
fn handler_parameter(parser: &mut Parser<'_>) {
    name(parser);
    if parser.at(Colon) {
        let colon = parser.span();
        parser.start(Error);
        parser.bump();
        types::any(parser);
        parser.finish();
        let span = Span::new(colon.start, parser.end_of_last());
        let problem = Diagnostic::new(
            Code::Unexpected,
            span,
            "a handler takes its types from the message",
        );
        parser.report(problem.replace("remove the type", span, ""));
    }
}
