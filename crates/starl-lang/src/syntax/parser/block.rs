//! Statements one after another: indented under a header, or on its line.

use alloc::format;
use alloc::string::String;

use super::slips::HeaderColon;
use super::statement::Place;
use super::{Code, Diagnostic, Parser, Span, SyntaxKind, SyntaxKind::*};
use crate::diagnostic::{Edit, Fix};

impl Parser<'_> {
    /// The indented statements under a header; `owner` is what needs them.
    pub(super) fn indented(&mut self, owner: &str) {
        self.header_colon(HeaderColon::Remove);
        if !self.expect_block(owner) {
            return;
        }
        self.start(Block);
        self.block_lines();
        self.finish();
    }

    /// The statements after `eff`, `init` or `atomic`: on its line, indented under it, or both.
    pub(super) fn block_after_word(&mut self, owner: &str, goes_on: bool) {
        self.header_colon(HeaderColon::Remove);
        if self.at_line_end() {
            return self.indented(owner);
        }
        self.start(Block);
        self.statements_on_line(Place::OnLine);
        if goes_on && self.at_block() {
            self.block_lines();
        }
        self.finish();
    }

    /// Parses the body of `else`: a statement on its line, or a block.
    pub(super) fn block_after_else(&mut self) {
        self.header_colon(HeaderColon::Remove);
        if self.at_line_end() {
            self.indented("`else`");
        } else {
            self.single_statement();
        }
    }

    /// Exactly one statement, on the line.
    pub(super) fn single_statement(&mut self) {
        self.start(Block);
        self.statement(Place::OnLine);
        self.finish();
    }

    /// Whether an indented block is next; reports that it is missing if not.
    pub(super) fn expect_block(&mut self, owner: &str) -> bool {
        if self.at_block() {
            return true;
        }
        if !self.at_line_end() {
            self.unexpected("an indented block");
            if self.at(LeftBrace) {
                self.diagnostics.last_mut().into_iter().for_each(|last| {
                    last.notes
                        .push("a block is indented and has no braces".into());
                });
            }
            self.skip_to_line_end();
            return self.at_block();
        }
        self.missing_block(owner);
        false
    }

    /// Reports that what is under a header is missing or not indented.
    fn missing_block(&mut self, owner: &str) {
        let place = Span::empty(self.end_of_last());
        let message = format!("{owner} needs an indented block");
        let problem = Diagnostic::new(Code::MissingBlock, place, message);
        let next = self.nth_span(1);
        // After an empty line something else begins.
        let gap = Span::new(place.end, next.start).of(self.text);
        let follows = self.at(Newline)
            && !matches!(self.nth(1), Dedent | EndOfFile)
            && gap.matches('\n').count() == 1;
        self.last_error = Some(self.position);
        self.report(if follows {
            let start = self.start_of_line(next.start);
            let problem = problem.label(next, "this line is not indented deeper");
            let edits = [Edit::new(Span::empty(start), "    ")];
            problem.edits("indent its block by 4 more spaces", edits)
        } else {
            problem
        });
    }

    /// The end of a header's line, and indented lines under it.
    fn block_lines(&mut self) {
        self.bump();
        self.inside_indentation(Self::statements);
    }

    /// Parses the indentation that is next, what `inner` takes, and the end of the indented block, one level deeper.
    pub(super) fn inside_indentation(&mut self, inner: impl FnOnce(&mut Self)) {
        let entered = self.deeper(|parser| {
            parser.bump();
            inner(parser);
        });
        if entered.is_some() {
            self.eat(Dedent);
        }
    }

    /// Statements to the end of the block.
    fn statements(&mut self) {
        loop {
            match self.current() {
                Dedent | EndOfFile => return,
                Newline | Semicolon => self.bump(),
                Indent => self.unexpected_indentation(Self::statements),
                _ => {
                    self.statements_on_line(Place::OwnLine);
                    self.end_line();
                }
            }
        }
    }

    /// Statements with semicolons between them, on a line.
    fn statements_on_line(&mut self, first: Place) {
        let mut place = first;
        loop {
            let is_if = self.at(IfKeyword);
            self.statement(place);
            place = Place::OnLine;
            if !self.eat(Semicolon) || self.at_line_end() {
                return;
            }
            if is_if && !matches!(self.current(), ElseKeyword | ElifKeyword) {
                self.after_inline_if();
            }
        }
    }

    /// Warns of the statement that is next, before which `if` and a semicolon stand on the line.
    fn after_inline_if(&mut self) {
        let message = "this runs whether the condition is true or not";
        let problem = Diagnostic::new(Code::AfterInlineIf, self.span(), message);
        let note = "`then` and `else` take one statement: put this one on a line of its own, or both in a block";
        self.report(problem.note(note));
    }

    /// Lines that are indented although nothing opens a block; `inner` parses them.
    pub(super) fn unexpected_indentation(&mut self, inner: impl FnOnce(&mut Self)) {
        let first = self.nth_span(1);
        let start = self.start_of_line(first.start);
        self.start(Error);
        // An error on the line above may be the reason why this line is not understood.
        let line_above = self.start_of_line(self.end_of_last());
        if self.last_report.is_some_and(|end| end >= line_above) {
            self.skip_block();
            return self.finish();
        }
        let message = "this line is indented, but nothing above it opens a block";
        let place = Span::new(start, first.start);
        let problem = Diagnostic::new(Code::UnexpectedIndentation, place, message);
        if joins(self.nth(1)) && self.position > 0 {
            self.move_operator(problem);
            self.skip_block();
            return self.finish();
        }
        let number = self.diagnostics.len();
        self.report(problem);
        self.inside_indentation(inner);
        let columns = (self.column_above(start), place.of(self.text).len());
        let edits = self.outdent_lines(start, self.end_of_last(), columns);
        if let (Some(problem), Some(edits)) = (self.diagnostics.get_mut(number), edits) {
            let above = spaces(columns.0);
            problem.expected = Some(format!("{above}, as the line above"));
            problem.found = Some(spaces(columns.1));
            let message = match columns.0 {
                0 => "remove its indentation".into(),
                _ => format!("indent it by {above}"),
            };
            problem.fix = Some(Fix { message, edits });
        }
        self.finish();
    }

    /// How many spaces stand before the last line with text above the line that starts at the byte `start`.
    fn column_above(&self, start: u32) -> usize {
        let lines = self.text[..start as usize].lines().rev();
        let mut lines = lines.filter(|line| !line.trim_start().is_empty());
        lines
            .next()
            .map_or(0, |line| line.len() - line.trim_start().len())
    }

    /// Reports a line that begins with the operator by which it continues with the one above.
    fn move_operator(&mut self, problem: Diagnostic) {
        let (operator, end) = (self.nth_span(1), self.end_of_last());
        let rest = Span::new(operator.start, self.nth_span(2).start);
        let text = operator.of(self.text);
        let edits = [
            Edit::new(Span::empty(end), format!(" {text}")),
            Edit::new(rest, ""),
        ];
        let message = format!("move `{text}` to the end of the line above");
        let problem = problem.note("a line that ends in an operator continues in the next");
        self.report(problem.edits(message, edits));
    }
}

fn spaces(count: usize) -> String {
    match count {
        0 => "no spaces".into(),
        1 => "1 space".into(),
        count => format!("{count} spaces"),
    }
}

/// Whether it stands between two operands.
fn joins(kind: SyntaxKind) -> bool {
    kind.continues_line() && !kind.is_assignment() && !matches!(kind, Minus | NotKeyword)
}
