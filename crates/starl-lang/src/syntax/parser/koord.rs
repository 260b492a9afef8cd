//! Declarations as Koord writes them.

use alloc::format;
use alloc::string::String;

use super::{Code, Diagnostic, Parser, SyntaxKind::*, slips};

/// Whether `allwrite: int sum`, `allread: Point[] pos` or `local: bool added` is next.
pub(super) fn is_variable(parser: &Parser<'_>) -> bool {
    matches!(parser.word(), "allwrite" | "allread" | "local")
        && parser.nth(1) == Colon
        && parser.nth(2) == Identifier
        && match parser.nth(3) {
            Identifier => true,
            LeftBracket => parser.nth(4) == RightBracket && parser.nth(5) == Identifier,
            _ => false,
        }
}

/// Reports the declaration in StarL, and skips the line.
pub(super) fn variable(parser: &mut Parser<'_>) {
    let first = parser.span();
    let word = parser.word();
    let ty = parser.nth_span(2).of(parser.text);
    let ty = slips::type_of(ty);
    let is_array = parser.nth(3) == LeftBracket;
    let named = parser.nth_span(if is_array { 5 } else { 3 });
    let name = named.of(parser.text);
    let form: String = match (word, is_array) {
        ("allread", _) => format!("allread {name}[RobotId]: {ty}"),
        ("allwrite", false) => format!("allwrite {name}: {ty}"),
        ("allwrite", true) => format!("allwrite {name}: List[{ty}]"),
        (_, false) => format!("{name}: {ty}"),
        (_, true) => format!("{name}: List[{ty}]"),
    };
    let span = first.to(named);
    let message = "the name of a variable stands before its type";
    let problem = Diagnostic::new(Code::ForeignDeclaration, span, message);
    parser.report(problem.replace(format!("write `{form}`"), span, form));
    parser.skip_to_line_end();
}

/// Reports `using Motion`, and skips the line.
pub(super) fn using(parser: &mut Parser<'_>) {
    let span = parser.span().to(parser.nth_span(1));
    let message = "`using` does not begin a declaration";
    let problem = Diagnostic::new(Code::ForeignDeclaration, span, message);
    let problem = problem.note("the ports of Koord are methods and flags of a primitive");
    let form = "motion = ReachAvoid()";
    parser.report(problem.replace(format!("write `{form}`"), span, form));
    parser.skip_to_line_end();
}
