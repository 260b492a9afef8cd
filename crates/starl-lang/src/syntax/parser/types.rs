//! Types: `Int`, `List[Point]`, `Map[String, Int]?`, `geometry.Line`, `enum {a, b}`.

use alloc::format;

use super::{Code, Diagnostic, Parser, Span, SyntaxKind, SyntaxKind::*, record};

/// The message about a tuple of one part.
pub(super) const SHORT_TUPLE: &str = "a tuple has at least two parts";

/// Parses a type, or reports that it is missing.
pub(super) fn any(parser: &mut Parser<'_>) {
    let start = parser.checkpoint();
    if parser.deeper(single).is_none_or(|found| !found) {
        return;
    }
    // More than one question mark says no more than one; the checker tells.
    let mut optional = 0;
    while matches!(parser.current(), Question | QuestionQuestion) && optional < 8 {
        parser.start_at(start, OptionalType);
        parser.bump();
        parser.finish();
        optional += 1;
    }
}

fn single(parser: &mut Parser<'_>) -> bool {
    if parser.at_word("enum") && parser.nth(1) == LeftBrace {
        parser.start(EnumType);
        parser.bump();
        record::variants(parser);
        parser.finish();
        return true;
    }
    if parser.at(LeftParen) {
        tuple(parser);
        return true;
    }
    if !parser.at(Identifier) {
        parser.unexpected("a type");
        return false;
    }
    parser.start(NamedType);
    let name = parser.span();
    parser.bump();
    if parser.at(LeftBracket) && parser.nth(1) == RightBracket {
        let span = name.to(parser.nth_span(1));
        let form = format!("List[{}]", super::slips::type_of(name.of(parser.text)));
        let problem = Diagnostic::new(Code::Unexpected, span, "a list is written with its type");
        parser.report(problem.replace(format!("write `{form}`"), span, form));
        parser.start(Error);
        parser.bump();
        parser.bump();
        parser.finish();
    }
    if parser.at(Dot) {
        parser.bump();
        parser.expect(Identifier);
    }
    let is_collection = matches!(name.of(parser.text), "List" | "Set" | "Map" | "Optional");
    match parser.current() {
        LeftBracket => arguments(parser),
        Less => angle_arguments(parser, Greater),
        LeftParen if is_collection => angle_arguments(parser, RightParen),
        _ => {}
    }
    parser.finish();
    true
}

/// `(Int, RobotId)`
fn tuple(parser: &mut Parser<'_>) {
    let open = parser.span();
    parser.start(TupleType);
    parser.bump();
    let mut parts = 0;
    if parser.at(RightParen) {
        parser.unexpected("a type");
    }
    parser.separated(RightParen, open, |parser| {
        parts += 1;
        any(parser);
    });
    if parts == 1 && parser.last_error != Some(parser.position) {
        let span = open.to(Span::empty(parser.end_of_last()));
        let inner = span.of(parser.text).trim_start_matches('(');
        let inner = inner.trim_end_matches([')', ',', ' ']);
        let problem = Diagnostic::new(Code::ShortTuple, span, SHORT_TUPLE);
        parser.report(problem.replace(alloc::format!("write `{inner}`"), span, inner));
    }
    parser.finish();
}

fn arguments(parser: &mut Parser<'_>) {
    let open = parser.span();
    parser.start(TypeArguments);
    parser.bump();
    if parser.at(RightBracket) {
        parser.unexpected("a type");
    }
    parser.separated(RightBracket, open, any);
    parser.finish();
}

/// `List<Int>` or `List(Int)`, which is written `List[Int]`.
fn angle_arguments(parser: &mut Parser<'_>, closing: SyntaxKind) {
    let open = parser.span();
    let problem = Diagnostic::new(
        Code::Unexpected,
        open,
        "type arguments are in square brackets",
    );
    parser.start(TypeArguments);
    parser.bump();
    any(parser);
    while parser.eat(Comma) {
        any(parser);
    }
    let close = parser.span();
    if parser.at(closing) {
        parser.bump();
        let edits = [(open, "["), (close, "]")]
            .map(|(span, text)| crate::diagnostic::Edit::new(span, text));
        let message = "write it in square brackets".into();
        parser.report(problem.fix(crate::diagnostic::Fix {
            message,
            edits: edits.into(),
        }));
    } else {
        parser.report(problem);
        parser.last_error = Some(parser.position);
    }
    parser.finish();
}
