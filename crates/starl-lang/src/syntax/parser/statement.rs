//! Statements.

use alloc::format;

use super::slips::{HeaderColon, is_variable_word};
use super::{Code, Diagnostic, Parser, Span, SyntaxKind::*};

/// Where a statement stands.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// It begins a line.
    OwnLine,
    /// Something stands before it on its line.
    OnLine,
}

impl Parser<'_> {
    /// A statement; takes at least a token.
    pub(super) fn statement(&mut self, place: Place) {
        match self.current() {
            IfKeyword => {
                let _ = self.deeper(|parser| parser.branches(place));
            }
            ForKeyword => self.for_statement(),
            LetKeyword => self.local(),
            ReturnKeyword => self.return_statement(),
            Identifier => self.statement_from_name(),
            PlusPlus if self.nth(1) == Identifier => self.step_before(),
            ElifKeyword | ElseKeyword => self.stray(
                "has no `if`",
                "it must directly follow the block of an `if` or `elif`",
            ),
            PreKeyword | EffKeyword => {
                let note = "it must directly follow the name of an action, as in `pick()`";
                self.stray("cannot stand among statements", note);
            }
            OnKeyword => {
                let note = "a handler is a declaration of its own: indent its line like the other declarations";
                self.stray("cannot stand among statements", note);
            }
            Ellipsis => self.stray(
                "is not a statement",
                "write the statements, or remove the block",
            ),
            _ if self.starts_operand(0) => self.expression_or_assignment(),
            _ => {
                self.unexpected("a statement");
                self.nothing();
            }
        }
    }

    /// Takes the line that holds no statement, at least one token of it.
    pub(super) fn nothing(&mut self) {
        if self.at_line_end() {
            if !matches!(self.current(), Dedent | EndOfFile | Newline) {
                self.bump();
            }
            return;
        }
        self.skip_to_line_end();
    }

    /// A word that cannot begin a statement; what is under it goes with it.
    fn stray(&mut self, message: &str, note: &str) {
        let message = format!("{} {message}", self.found());
        let problem = Diagnostic::new(Code::Misplaced, self.span(), message);
        self.report(problem.note(note));
        self.last_error = Some(self.position);
        self.skip_line_and_block();
    }

    /// `let x = e` or `let x: T = e`.
    fn local(&mut self) {
        self.start(LetStatement);
        self.bump();
        self.local_rest();
        self.finish();
    }

    fn local_rest(&mut self) {
        if matches!(self.word(), "mut" | "var" | "const") && self.nth(1) == Identifier {
            self.remove_word("every local variable can be changed");
        }
        self.pattern();
        if self.eat(Colon) {
            self.any_type();
        }
        if self.expect(Equal) {
            self.expression();
        }
    }

    /// `return`, with a value or without.
    fn return_statement(&mut self) {
        self.start(ReturnStatement);
        self.bump();
        if !self.at_line_end() && !self.at(ElseKeyword) {
            self.expression();
        }
        self.finish();
    }

    /// `for x in xs`, and a block.
    fn for_statement(&mut self) {
        self.start(ForStatement);
        self.bump();
        if !self.loop_words() {
            self.iteration();
            self.indented("`for`");
        }
        self.finish();
    }

    /// `if`, `elif` and `else`.
    fn branches(&mut self, place: Place) {
        self.start(IfStatement);
        self.branch();
        loop {
            let next_line = self.at(Newline) && place == Place::OwnLine;
            let kind = if next_line {
                self.nth(1)
            } else {
                self.current()
            };
            let word = self.nth_span(usize::from(next_line)).of(self.text);
            let next = self.nth(usize::from(next_line) + 1);
            let asks = next.is_literal() || matches!(next, Identifier | NotKeyword | SomeKeyword);
            let one_word =
                matches!(word, "elseif" | "elsif" | "elseIf") && place == Place::OwnLine && asks;
            if !matches!(kind, ElifKeyword | ElseKeyword) && !one_word {
                break;
            }
            if next_line {
                self.bump();
            }
            if one_word {
                self.report_operator(self.span(), "this is written `elif`", "elif");
                self.branch();
                continue;
            }
            let else_if =
                kind == ElseKeyword && self.nth(1) == IfKeyword && self.line_opens_block();
            if kind == ElifKeyword || else_if {
                self.branch();
                continue;
            }
            self.start(ElseBranch);
            self.bump();
            self.block_after_else();
            self.finish();
            break;
        }
        self.finish();
    }

    /// Whether the line that is next has an indented block under it.
    fn line_opens_block(&self) -> bool {
        self.nth(self.line_end(0) + 1) == Indent
    }

    /// `if c`, `elif c` or `else if c`, with a block or `then` and a statement.
    fn branch(&mut self) {
        self.start(IfBranch);
        if self.at(ElseKeyword) {
            let span = self.span().to(self.nth_span(1));
            let problem = Diagnostic::new(Code::ElseIf, span, "`else if` is one word");
            self.report(problem.write(span, "elif"));
            self.bump();
        }
        self.bump();
        self.condition();
        self.header_colon(HeaderColon::Then);
        let is_do = self.at_word("do") && self.nth(1) == Identifier;
        if is_do {
            self.replace_word("a statement follows `then`", "then");
        }
        let has_then = is_do || self.eat(ThenKeyword);
        if has_then {
            self.header_colon(HeaderColon::Remove);
        }
        let inline = !self.at_line_end() && !self.at(LeftBrace);
        // A colon, which is reported, may take the place of `then`.
        let has_then = has_then || self.previous() == Some(Colon);
        if inline && (has_then || self.starts_statement()) {
            if !has_then {
                self.missing_then();
            }
            self.single_statement();
        } else {
            self.indented("`if`");
        }
        self.finish();
    }

    /// Whether what stands after a condition can only be meant as a statement.
    fn starts_statement(&self) -> bool {
        let word = matches!(self.current(), Identifier | ReturnKeyword | LetKeyword);
        word && !self.line_opens_block()
    }

    /// Reports a statement that stands on the line of its condition without `then`.
    fn missing_then(&mut self) {
        if self.last_error == Some(self.position) {
            return;
        }
        let place = Span::empty(self.end_of_last());
        let problem = Diagnostic::new(Code::Unexpected, place, "`then` is missing");
        let note = "statements that are indented below it need none";
        self.report(problem.note(note).write(place, " then"));
    }

    /// A statement that begins with a name.
    fn statement_from_name(&mut self) {
        let next = self.nth(1);
        let opens = matches!(next, Newline | Colon | Identifier);
        let opens = opens || matches!(next, IfKeyword | ForKeyword | LetKeyword | ReturnKeyword);
        if self.word() == "atomic" && opens {
            self.start(AtomicStatement);
            self.bump();
            self.block_after_word("`atomic`", false);
            return self.finish();
        }
        if let Some(note) = self.foreign_statement() {
            let message = format!("there is no `{}` in StarL", self.word());
            let problem = Diagnostic::new(Code::ForeignStatement, self.span(), message);
            self.report(problem.note(note));
            return self.skip_line_and_block();
        }
        match next {
            Identifier if self.word() == "foreach" => {
                self.report_operator(self.span(), "a loop begins with `for`", "for");
                self.for_statement();
            }
            Colon if self.nth(2) == Identifier => {
                let span = self.span();
                let message = "a local variable begins with `let`";
                let problem = Diagnostic::new(Code::ForeignDeclaration, span, message);
                self.report(problem.write(Span::empty(span.start), "let "));
                self.start(LetStatement);
                self.local_rest();
                self.finish();
            }
            Identifier if self.nth(2).is_assignment() || is_variable_word(self.word()) => {
                self.start(LetStatement);
                self.foreign_variable_word("let ");
                self.local_rest();
                self.finish();
            }
            _ => self.expression_or_assignment(),
        }
    }
}
