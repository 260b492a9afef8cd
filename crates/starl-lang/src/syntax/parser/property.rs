//! Properties and checks: `invariant name: condition`, `eventually name: condition within 30s`,
//! `always name: condition leads_to condition within 30s`, `check condition`.

use super::item::name;
use super::{Code, Diagnostic, Parser, Span, SyntaxKind::*, expression, slips, words};
use crate::diagnostic::{Edit, Fix};

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
    // `check: n < 5` has a colon that does not belong there.
    let compares = parser.nth(2) == Identifier
        && (parser.nth(3).is_comparison() || matches!(parser.nth(3), Dot | InKeyword));
    let second = parser.nth_span(2).of(parser.text);
    let is_small = second.starts_with(|first: char| first.is_ascii_lowercase());
    match parser.nth(1) {
        Colon => compares && is_small || parser.nth(2) == NotKeyword,
        next => next == LeftBracket || is_next(parser),
    }
}

/// A check, which has no name.
pub(super) fn check(parser: &mut Parser<'_>) {
    parser.bump();
    let is_named = parser.at(Identifier) && parser.nth(1) == Colon;
    if is_named || parser.at(Colon) {
        let last = parser.nth_span(usize::from(is_named));
        let next = parser.nth_span(usize::from(is_named) + 1).start;
        let problem = Diagnostic::new(
            Code::Unexpected,
            parser.span().to(last),
            "a check has no name and no colon",
        );
        let place = match is_named {
            true => Span::new(parser.span().start, next),
            false => last,
        };
        parser.report(problem.replace("write the condition after `check`", place, ""));
        parser.start(Error);
        (0..=usize::from(is_named)).for_each(|_| parser.bump());
        parser.finish();
    }
    expression::condition(parser);
}

/// A property, whose name may be missing.
pub(super) fn property(parser: &mut Parser<'_>) {
    let (begin, is_eventual) = (parser.span(), parser.at_word("eventually"));
    let is_never = parser.at_word("never");
    parser.bump();
    let is_always = is_eventual && parser.at_word("always") && parser.nth(1) != Colon;
    if is_always {
        parser.bump();
    }
    if parser.at_word("within") && parser.nth(1) != Colon {
        let from = parser.span();
        parser.bump();
        expression::expression(parser);
        let span = from.to(Span::empty(parser.end_of_last()));
        let deadline = span.of(parser.text);
        let message = "a property ends with its deadline";
        let problem = Diagnostic::new(Code::Unexpected, span, message);
        let form = alloc::format!("write `eventually: condition {deadline}`");
        parser.report(problem.note(form));
    }
    let begins = parser.end_of_last();
    let named = parser.nth(1) == Colon && (parser.at(Identifier) || parser.current().is_keyword());
    if named || is_name(parser) {
        name(parser);
    }
    let colon = parser.eat(Colon);
    let (head, first) = (parser.end_of_last(), parser.span().start);
    expression::condition(parser);
    if is_never {
        never(parser, begin, (!colon).then_some(head), first);
    } else if !colon && first > head {
        let place = Span::empty(head);
        let message = "`:` is missing before the condition of a property";
        let problem = Diagnostic::new(Code::Unexpected, place, message);
        // With the colon alone, `always` would be its name.
        parser.report(match is_always && begins == head {
            true => problem.note("write `eventually always name: condition`, with a name"),
            false => problem.replace("write `:`", place, ":"),
        });
    }
    let leads = parser.at_word("leads") && parser.nth_span(1).of(parser.text) == "to";
    if leads {
        let span = parser.span().to(parser.nth_span(1));
        let fix = ("write `leads_to`", "leads_to");
        slips::foreign_operator(parser, span, "this is one word", fix);
        parser.bump();
    }
    if leads || parser.at_word("leads_to") {
        parser.bump();
        expression::condition(parser);
    }
    if words::deadline(parser) {
        expression::expression(parser);
    } else if parser.at_word("within") {
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

/// Whether the name of a property is next, without the colon after it.
fn is_name(parser: &Parser<'_>) -> bool {
    let next = parser.nth_span(1).of(parser.text);
    let begins = match parser.nth(1) {
        Identifier => !CLAUSES.contains(&next),
        kind => kind.is_literal() || matches!(kind, NotKeyword | SomeKeyword | IfKeyword),
    };
    let quantified = matches!(parser.word(), "forall" | "exists");
    parser.at(Identifier) && begins && !quantified && words::operator_at(parser, 1).is_none()
}

/// Words that follow the condition of a property.
const CLAUSES: [&str; 7] = [
    "within", "leads_to", "recovers", "assuming", "despite", "before", "until",
];

/// Reports `never p`, whose condition starts at the byte `first`, after the byte `head` if a colon is missing there.
fn never(parser: &mut Parser<'_>, word: Span, head: Option<u32>, first: u32) {
    let message = "`never` does not begin a property";
    let problem = Diagnostic::new(Code::ForeignDeclaration, word, message);
    let mut edits = alloc::vec![Edit::new(word, "always")];
    edits.extend(head.map(|head| Edit::new(Span::empty(head), ":")));
    edits.push(Edit::new(Span::empty(first), "not ("));
    edits.push(Edit::new(Span::empty(parser.end_of_last().max(first)), ")"));
    let message = "write `always: not (...)`".into();
    parser.report(problem.fix(Fix { message, edits }));
}

/// `forall r: condition`, which is a property without its first word.
pub(super) fn without_word(parser: &mut Parser<'_>) {
    let start = parser.span().start;
    let message = "a property begins with `always` or `eventually`";
    let problem = Diagnostic::new(Code::ForeignDeclaration, parser.span(), message);
    parser.report(problem.replace("write `always:`", Span::empty(start), "always: "));
    expression::condition(parser);
}

/// A word that has to come next.
fn word(parser: &mut Parser<'_>, expected: &str) {
    if parser.at_word(expected) {
        parser.bump();
    } else {
        parser.unexpected(&alloc::format!("`{expected}`"));
    }
}
