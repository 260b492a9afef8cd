//! Statements one after another: indented under a header, or on its line.

use alloc::format;
use alloc::string::String;

use super::slips::{self, Colon};
use super::{Code, Diagnostic, Parser, Span, SyntaxKind, SyntaxKind::*, statement};
use crate::diagnostic::{Edit, Fix};

/// The indented statements under a header; `owner` is what needs them.
pub(super) fn indented(parser: &mut Parser<'_>, owner: &str) {
    slips::header_colon(parser, Colon::Remove);
    if !opens_block(parser, owner) {
        return;
    }
    parser.start(Block);
    lines(parser);
    parser.finish();
}

/// The statements after `eff`, `init` or `atomic`: on its line, indented under it, or both.
pub(super) fn after_word(parser: &mut Parser<'_>, owner: &str, goes_on: bool) {
    slips::header_colon(parser, Colon::Remove);
    if parser.at_line_end() {
        return indented(parser, owner);
    }
    parser.start(Block);
    on_line(parser, statement::Place::OnLine);
    if goes_on && parser.at(Newline) && parser.nth(1) == Indent {
        lines(parser);
    }
    parser.finish();
}

/// Parses the body of `else`: a statement on its line, or a block.
pub(super) fn after_else(parser: &mut Parser<'_>) {
    slips::header_colon(parser, Colon::Remove);
    if parser.at_line_end() {
        indented(parser, "`else`");
    } else {
        single(parser);
    }
}

/// Exactly one statement, on the line.
pub(super) fn single(parser: &mut Parser<'_>) {
    parser.start(Block);
    statement::statement(parser, statement::Place::OnLine);
    parser.finish();
}

/// Whether an indented block is next; reports that it is missing if not.
pub(super) fn opens_block(parser: &mut Parser<'_>, owner: &str) -> bool {
    if parser.at(Newline) && parser.nth(1) == Indent {
        return true;
    }
    if !parser.at_line_end() {
        parser.unexpected("an indented block");
        if parser.at(LeftBrace) {
            parser.diagnostics.last_mut().into_iter().for_each(|last| {
                last.notes
                    .push("a block is indented and has no braces".into());
            });
        }
        parser.skip_to_line_end();
        return parser.at(Newline) && parser.nth(1) == Indent;
    }
    missing(parser, owner);
    false
}

/// Reports that what is under a header is missing or not indented.
fn missing(parser: &mut Parser<'_>, owner: &str) {
    let place = Span::empty(parser.end_of_last());
    let message = format!("{owner} needs an indented block");
    let problem = Diagnostic::new(Code::MissingBlock, place, message);
    let next = parser.nth_span(1);
    // After an empty line something else begins.
    let gap = Span::new(place.end, next.start).of(parser.text);
    let follows = parser.at(Newline)
        && !matches!(parser.nth(1), Dedent | EndOfFile)
        && gap.matches('\n').count() == 1;
    parser.last_error = Some(parser.position);
    parser.report(if follows {
        let start = parser.start_of_line(next.start);
        let problem = problem.label(next, "this line is not indented deeper");
        let edits = [Edit::new(Span::empty(start), "    ")].into();
        problem.fix(Fix {
            message: "indent its block by 4 more spaces".into(),
            edits,
        })
    } else {
        problem
    });
}

/// The end of a header's line, and indented lines under it.
fn lines(parser: &mut Parser<'_>) {
    parser.bump();
    let entered = parser.deeper(|parser| {
        parser.bump();
        statements(parser);
    });
    if entered.is_some() {
        parser.eat(Dedent);
    }
}

/// Statements to the end of the block.
fn statements(parser: &mut Parser<'_>) {
    loop {
        match parser.current() {
            Dedent | EndOfFile => return,
            Newline | Semicolon => parser.bump(),
            Indent => unexpected_indentation(parser, statements),
            _ => {
                on_line(parser, statement::Place::OwnLine);
                parser.end_line();
            }
        }
    }
}

/// Statements with semicolons between them, on a line.
fn on_line(parser: &mut Parser<'_>, first: statement::Place) {
    let mut place = first;
    loop {
        let is_if = parser.at(IfKeyword);
        statement::statement(parser, place);
        place = statement::Place::OnLine;
        if !parser.eat(Semicolon) || parser.at_line_end() {
            return;
        }
        if is_if && !matches!(parser.current(), ElseKeyword | ElifKeyword) {
            after_inline_if(parser);
        }
    }
}

/// Warns of the statement that is next, before which `if` and a semicolon stand on the line.
fn after_inline_if(parser: &mut Parser<'_>) {
    let message = "this runs whether the condition is true or not";
    let problem = Diagnostic::new(Code::AfterInlineIf, parser.span(), message);
    let note = "`then` and `else` take one statement: put this one on a line of its own, or both in a block";
    parser.report(problem.note(note));
}

/// Lines that are indented although nothing opens a block; `inner` parses them.
pub(super) fn unexpected_indentation(parser: &mut Parser<'_>, inner: impl FnOnce(&mut Parser<'_>)) {
    let first = parser.nth_span(1);
    let start = parser.start_of_line(first.start);
    parser.start(Error);
    // An error on the line above may be the reason why this line is not understood.
    let line_above = parser.start_of_line(parser.end_of_last());
    if parser.last_report.is_some_and(|end| end >= line_above) {
        parser.skip_block();
        return parser.finish();
    }
    let message = "this line is indented, but nothing above it opens a block";
    let place = Span::new(start, first.start);
    let problem = Diagnostic::new(Code::UnexpectedIndentation, place, message);
    if joins(parser.nth(1)) && parser.position > 0 {
        move_operator(parser, problem);
        parser.skip_block();
        return parser.finish();
    }
    let number = parser.diagnostics.len();
    parser.report(problem);
    let entered = parser.deeper(|parser| {
        parser.bump();
        inner(parser);
    });
    if entered.is_some() {
        parser.eat(Dedent);
    }
    let columns = (column_above(parser, start), place.of(parser.text).len());
    let edits = parser.outdent_lines(start, parser.end_of_last(), columns);
    if let (Some(problem), Some(edits)) = (parser.diagnostics.get_mut(number), edits) {
        let above = spaces(columns.0);
        problem.expected = Some(format!("{above}, as the line above"));
        problem.found = Some(spaces(columns.1));
        let message = match columns.0 {
            0 => "remove its indentation".into(),
            _ => format!("indent it by {above}"),
        };
        problem.fix = Some(Fix { message, edits });
    }
    parser.finish();
}

fn spaces(count: usize) -> String {
    match count {
        0 => "no spaces".into(),
        1 => "1 space".into(),
        count => format!("{count} spaces"),
    }
}

/// How many spaces stand before the last line with text above the line that starts at the byte `start`.
fn column_above(parser: &Parser<'_>, start: u32) -> usize {
    let lines = parser.text[..start as usize].lines().rev();
    let mut lines = lines.filter(|line| !line.trim_start().is_empty());
    lines
        .next()
        .map_or(0, |line| line.len() - line.trim_start().len())
}

/// Reports a line that begins with the operator by which it continues with the one above.
fn move_operator(parser: &mut Parser<'_>, problem: Diagnostic) {
    let (operator, end) = (parser.nth_span(1), parser.end_of_last());
    let rest = Span::new(operator.start, parser.nth_span(2).start);
    let text = operator.of(parser.text);
    let edits = [
        Edit::new(Span::empty(end), format!(" {text}")),
        Edit::new(rest, ""),
    ]
    .into();
    let message = format!("move `{text}` to the end of the line above");
    let problem = problem.note("a line that ends in an operator continues in the next");
    parser.report(problem.fix(Fix { message, edits }));
}

/// Whether it stands between two operands.
fn joins(kind: SyntaxKind) -> bool {
    kind.continues_line() && !kind.is_assignment() && !matches!(kind, Minus | NotKeyword)
}
