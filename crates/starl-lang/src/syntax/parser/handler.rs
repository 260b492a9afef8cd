//! Handlers: what a robot does when a message arrives, a primitive reports something, or an operator gives an
//! order.

use super::{Code, Diagnostic, Parser, Span, SyntaxKind::*};

impl Parser<'_> {
    /// `on Message(from, a, b)`, `on primitive.event(a)` or `on input name(a: T)`, and statements.
    pub(super) fn handler(&mut self) {
        let on = self.span();
        self.bump();
        self.handler_after_word(on);
    }

    /// `when Message(from, a)`, whose first word is `on`.
    pub(super) fn handler_without_word(&mut self) {
        let on = self.span();
        self.replace_word("a handler begins with `on`", "on");
        self.handler_after_word(on);
    }

    fn handler_after_word(&mut self, on: Span) {
        let begins = matches!(self.word(), "start" | "init" | "startup" | "begin");
        if begins && matches!(self.nth(1), Newline | Colon) {
            let span = on.to(self.span());
            let message = "the statements at the start follow `init`";
            self.report_operator(span, message, "init");
            self.skip_to_line_end();
            return self.indented("`init`");
        }
        if matches!(self.word(), "message" | "receive" | "received" | "event")
            && self.nth(1) == Identifier
        {
            self.remove_word("the name of the message or event stands after `on`");
        }
        // `input` may also be the name of a message or of a primitive.
        let next = self.nth(1);
        if self.at_word("input") && (next == Identifier || next.is_keyword()) {
            self.bump();
            self.name();
            self.parameters();
            return self.indented("a handler");
        }
        self.start(EventPath);
        if self.expect(Identifier) && self.eat(Dot) {
            self.expect(Identifier);
        }
        self.finish();
        if self.at(LeftParen) {
            self.bracketed(HandlerParameterList, RightParen, Self::handler_parameter);
        } else {
            self.unexpected("the sender and the fields in brackets, as in `(from, x)`");
        }
        self.indented("a handler");
    }

    /// A name, whose type is that of the message's field.
    fn handler_parameter(&mut self) {
        self.name();
        if self.at(Colon) {
            let colon = self.span();
            self.start(Error);
            self.bump();
            self.any_type();
            self.finish();
            let span = Span::new(colon.start, self.end_of_last());
            let message = "a handler takes its types from the message";
            let problem = Diagnostic::new(Code::Unexpected, span, message);
            self.report(problem.replace("remove the type", span, ""));
        }
    }
}
