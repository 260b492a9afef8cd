//! Statements.

use alloc::format;

use super::expression::{condition, expression as value};
use super::slips::{self, Colon as HeaderColon};
use super::{
    Code, Diagnostic, Parser, Span, SyntaxKind::*, assignment, block, collection, types, words,
};

/// Where a statement stands.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// It begins a line.
    OwnLine,
    /// Something stands before it on its line.
    OnLine,
}

/// A statement; takes at least a token.
pub(super) fn statement(parser: &mut Parser<'_>, place: Place) {
    match parser.current() {
        IfKeyword => {
            let _ = parser.deeper(|parser| branches(parser, place));
        }
        ForKeyword => iteration(parser),
        LetKeyword => local(parser),
        ReturnKeyword => result(parser),
        Identifier => from_name(parser),
        PlusPlus if parser.nth(1) == Identifier => words::step_before(parser),
        ElifKeyword | ElseKeyword => stray(
            parser,
            "has no `if`",
            "it must directly follow the block of an `if` or `elif`",
        ),
        PreKeyword | EffKeyword => {
            let note = "it must directly follow the name of an action, as in `pick()`";
            stray(parser, "cannot stand among statements", note);
        }
        OnKeyword => {
            let note = "a handler is a declaration of its own: indent its line like the other declarations";
            stray(parser, "cannot stand among statements", note);
        }
        Ellipsis => stray(
            parser,
            "is not a statement",
            "write the statements, or remove the block",
        ),
        _ if parser.starts_operand() => assignment::expression_or_assignment(parser),
        _ => {
            parser.unexpected("a statement");
            nothing(parser);
        }
    }
}

/// Takes the line that holds no statement, at least one token of it.
pub(super) fn nothing(parser: &mut Parser<'_>) {
    if parser.at_line_end() {
        if !matches!(parser.current(), Dedent | EndOfFile | Newline) {
            parser.bump();
        }
        return;
    }
    parser.skip_to_line_end();
}

/// A word that cannot begin a statement; what is under it goes with it.
fn stray(parser: &mut Parser<'_>, message: &str, note: &str) {
    let message = format!("{} {message}", parser.found());
    let problem = Diagnostic::new(Code::Misplaced, parser.span(), message);
    parser.report(problem.note(note));
    parser.last_error = Some(parser.position);
    parser.skip_line_and_block();
}

/// `let x = e` or `let x: T = e`.
fn local(parser: &mut Parser<'_>) {
    parser.start(LetStatement);
    parser.bump();
    local_rest(parser);
    parser.finish();
}

fn local_rest(parser: &mut Parser<'_>) {
    if matches!(parser.word(), "mut" | "var" | "const") && parser.nth(1) == Identifier {
        words::remove(parser, "every local variable can be changed");
    }
    collection::pattern(parser);
    if parser.eat(Colon) {
        types::any(parser);
    }
    if parser.expect(Equal) {
        value(parser);
    }
}

/// `return`, with a value or without.
fn result(parser: &mut Parser<'_>) {
    parser.start(ReturnStatement);
    parser.bump();
    if !parser.at_line_end() && !parser.at(ElseKeyword) {
        value(parser);
    }
    parser.finish();
}

/// `for x in xs`, and a block.
fn iteration(parser: &mut Parser<'_>) {
    parser.start(ForStatement);
    parser.bump();
    if !words::loop_words(parser) {
        collection::iteration(parser);
        block::indented(parser, "`for`");
    }
    parser.finish();
}

/// `if`, `elif` and `else`.
fn branches(parser: &mut Parser<'_>, place: Place) {
    parser.start(IfStatement);
    branch(parser);
    loop {
        let next_line = parser.at(Newline) && place == Place::OwnLine;
        let kind = if next_line {
            parser.nth(1)
        } else {
            parser.current()
        };
        let word = parser.nth_span(usize::from(next_line)).of(parser.text);
        let next = parser.nth(usize::from(next_line) + 1);
        let asks = next.is_literal() || matches!(next, Identifier | NotKeyword | SomeKeyword);
        let one_word =
            matches!(word, "elseif" | "elsif" | "elseIf") && place == Place::OwnLine && asks;
        if !matches!(kind, ElifKeyword | ElseKeyword) && !one_word {
            break;
        }
        if next_line {
            parser.bump();
        }
        if one_word {
            let (span, fix) = (parser.span(), ("write `elif`", "elif"));
            slips::foreign_operator(parser, span, "this is written `elif`", fix);
            branch(parser);
            continue;
        }
        let else_if = kind == ElseKeyword && parser.nth(1) == IfKeyword && opens_block(parser);
        if kind == ElifKeyword || else_if {
            branch(parser);
            continue;
        }
        parser.start(ElseBranch);
        parser.bump();
        block::after_else(parser);
        parser.finish();
        break;
    }
    parser.finish();
}

/// Whether the line that is next has an indented block under it.
fn opens_block(parser: &Parser<'_>) -> bool {
    let end =
        (0..).find(|ahead| matches!(parser.nth(*ahead), Newline | Semicolon | Dedent | EndOfFile));
    end.is_some_and(|end| parser.nth(end + 1) == Indent)
}

/// `if c`, `elif c` or `else if c`, with a block or `then` and a statement.
fn branch(parser: &mut Parser<'_>) {
    parser.start(IfBranch);
    if parser.at(ElseKeyword) {
        let span = parser.span().to(parser.nth_span(1));
        let problem = Diagnostic::new(Code::ElseIf, span, "`else if` is one word");
        parser.report(problem.replace("write `elif`", span, "elif"));
        parser.bump();
    }
    parser.bump();
    condition(parser);
    slips::header_colon(parser, HeaderColon::Then);
    let is_do = parser.at_word("do") && parser.nth(1) == Identifier;
    if is_do {
        words::replace(parser, "a statement follows `then`", "then");
    }
    let has_then = is_do || parser.eat(ThenKeyword);
    if has_then {
        slips::header_colon(parser, HeaderColon::Remove);
    }
    let inline = !parser.at_line_end() && !parser.at(LeftBrace);
    let has_then = has_then || after_colon(parser);
    if inline && (has_then || starts_statement(parser)) {
        if !has_then {
            missing_then(parser);
        }
        block::single(parser);
    } else {
        block::indented(parser, "`if`");
    }
    parser.finish();
}

/// Whether what stands after a condition can only be meant as a statement.
fn starts_statement(parser: &Parser<'_>) -> bool {
    let word = matches!(parser.current(), Identifier | ReturnKeyword | LetKeyword);
    word && !opens_block(parser)
}

/// Reports a statement that stands on the line of its condition without `then`.
fn missing_then(parser: &mut Parser<'_>) {
    if parser.last_error == Some(parser.position) {
        return;
    }
    let place = Span::empty(parser.end_of_last());
    let problem = Diagnostic::new(Code::Unexpected, place, "`then` is missing");
    let note = "statements that are indented below it need none";
    parser.report(problem.note(note).replace("write `then`", place, " then"));
}

/// Whether a colon, which is reported, took the place of `then`.
fn after_colon(parser: &Parser<'_>) -> bool {
    parser.position > 0 && parser.lexemes[parser.position - 1].kind == Colon
}

/// A statement that begins with a name.
fn from_name(parser: &mut Parser<'_>) {
    let next = parser.nth(1);
    let opens = matches!(next, Newline | Colon | Identifier);
    let opens = opens || matches!(next, IfKeyword | ForKeyword | LetKeyword | ReturnKeyword);
    if parser.word() == "atomic" && opens {
        parser.start(AtomicStatement);
        parser.bump();
        block::after_word(parser, "`atomic`", false);
        return parser.finish();
    }
    if let Some(note) = slips::foreign_statement(parser) {
        let message = format!("there is no `{}` in StarL", parser.word());
        let problem = Diagnostic::new(Code::ForeignStatement, parser.span(), message);
        parser.report(problem.note(note));
        return parser.skip_line_and_block();
    }
    match next {
        Identifier if parser.word() == "foreach" => {
            let (span, fix) = (parser.span(), ("write `for`", "for"));
            slips::foreign_operator(parser, span, "a loop begins with `for`", fix);
            iteration(parser);
        }
        Colon if parser.nth(2) == Identifier => {
            let span = parser.span();
            let problem = Diagnostic::new(
                Code::ForeignDeclaration,
                span,
                "a local variable begins with `let`",
            );
            parser.report(problem.replace("write `let`", Span::empty(span.start), "let "));
            parser.start(LetStatement);
            local_rest(parser);
            parser.finish();
        }
        Identifier if parser.nth(2).is_assignment() || slips::is_variable_word(parser.word()) => {
            parser.start(LetStatement);
            slips::foreign_variable(parser, "let ");
            local_rest(parser);
            parser.finish();
        }
        _ => assignment::expression_or_assignment(parser),
    }
}
