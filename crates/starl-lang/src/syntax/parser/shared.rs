//! Shared variables: `allread pos[RobotId]: Point` and `allwrite sum: Int = 0`.

use alloc::format;

use super::item::name;
use super::{Code, Diagnostic, Parser, Span, SyntaxKind::*, declaration, slips, types};

/// `allread name[RobotId]: Type`: one element for each robot, which only that robot writes.
pub(super) fn all_read(parser: &mut Parser<'_>) {
    word_and_name(parser);
    array_index(parser);
    typed(parser);
}

/// `allwrite name: Type`: one variable that every robot writes.
pub(super) fn all_write(parser: &mut Parser<'_>) {
    word_and_name(parser);
    if parser.at(LeftBracket) {
        let open = parser.span();
        let problem = Diagnostic::new(
            Code::Unexpected,
            open,
            "a variable that all robots write is not an array",
        );
        parser.report(
            problem.note("use `allread` for an array in which each robot writes its own element"),
        );
        array_index(parser);
    }
    typed(parser);
}

/// The word with the consistency in brackets, if that is named, and the name.
fn word_and_name(parser: &mut Parser<'_>) {
    parser.bump();
    if parser.at(LeftBracket) {
        let open = parser.span();
        parser.start(Consistency);
        parser.bump();
        parser.expect(Identifier);
        parser.close(RightBracket, open);
        parser.finish();
    }
    if parser.at(Identifier) && parser.nth(1) == Identifier {
        type_first(parser);
    }
    name(parser);
}

/// Koord's `allwrite int sum`.
fn type_first(parser: &mut Parser<'_>) {
    let (word, named) = (parser.span(), parser.nth_span(1));
    let both = word.to(named);
    let message = "the type of a variable stands after its name";
    let problem = Diagnostic::new(Code::ForeignDeclaration, both, message);
    let form = format!(
        "{}: {}",
        named.of(parser.text),
        slips::type_of(parser.word())
    );
    parser.report(problem.replace(format!("write `{form}`"), both, form));
    types::any(parser);
}

/// `[RobotId]`.
fn array_index(parser: &mut Parser<'_>) {
    let open = parser.span();
    if !parser.at(LeftBracket) {
        let place = Span::empty(parser.end_of_last());
        let problem = Diagnostic::new(
            Code::Unexpected,
            place,
            "an `allread` variable has an element for each robot",
        );
        return parser.report(problem.expected("`[RobotId]`").replace(
            "write `[RobotId]`",
            place,
            "[RobotId]",
        ));
    }
    parser.start(TypeArguments);
    parser.bump();
    types::any(parser);
    parser.close(RightBracket, open);
    parser.finish();
}

/// `: Type`, which Koord leaves out, and a value.
fn typed(parser: &mut Parser<'_>) {
    if parser.at(Colon) {
        parser.bump();
        types::any(parser);
    } else if parser
        .diagnostics
        .last()
        .is_none_or(|last| last.code != Code::ForeignDeclaration)
    {
        parser.expect(Colon);
    }
    declaration::value(parser);
}

/// Whether an array is declared next in the syntax of other languages: `name[...]: Type`.
pub(super) fn is_array(parser: &Parser<'_>) -> bool {
    match parser.nth(2) {
        RightBracket => parser.nth(3) == Colon,
        _ => parser.nth(3) == RightBracket && parser.nth(4) == Colon,
    }
}

/// `name[RobotId]: Type` without `allread`, or `name[]: Type`.
pub(super) fn without_word(parser: &mut Parser<'_>) {
    let span = parser.span();
    if parser.nth(2) == RightBracket {
        let place = span.to(parser.nth_span(2));
        let form = format!("`{}: List[...]`", parser.word());
        parser.report(
            Diagnostic::new(
                Code::ForeignDeclaration,
                place,
                "a list is declared by its type",
            )
            .expected(form),
        );
    } else {
        let problem = Diagnostic::new(
            Code::ForeignDeclaration,
            span,
            "a variable with an element for each robot is shared and begins with `allread`",
        );
        parser.report(problem.replace("write `allread`", Span::empty(span.start), "allread "));
    }
    name(parser);
    if parser.nth(1) == RightBracket {
        parser.start(Error);
        parser.bump();
        parser.bump();
        parser.finish();
    } else {
        array_index(parser);
    }
    typed(parser);
}
