//! `stable name: Type`: a variable that survives a crash if the robot has storage.

use super::form::{self, Form};
use super::item::Place;
use super::{Code, Diagnostic, Parser, SyntaxKind::*, declaration};

/// The form of a declaration that begins with `stable`; none if the word names something here.
pub(super) fn form(parser: &Parser<'_>) -> Option<Form> {
    let keyword = parser.nth(1).is_keyword() && parser.nth(2) == Colon;
    if parser.nth(1) != Identifier && !keyword {
        return None;
    }
    let word = parser.nth_span(1).of(parser.text);
    let (kind, parse): Form = match (parser.nth(2), form::by_meaning(word)) {
        (Equal, _) => (BindingDeclaration, without_type),
        (Identifier | LeftBracket, Some((kind, _))) => (kind, other),
        _ => (VariableDeclaration, variable),
    };
    Some((kind, parse))
}

/// `stable name: Type`, and a value if it has one.
pub(super) fn variable(parser: &mut Parser<'_>) {
    parser.bump();
    if parser.nth(1) == Identifier {
        declaration::foreign_variable(parser);
    } else {
        declaration::variable(parser);
    }
}

/// `stable name = Primitive()`, or a variable whose type is missing.
fn without_type(parser: &mut Parser<'_>) {
    if parser.nth(3) == Identifier && parser.nth(4) == LeftParen {
        return other(parser);
    }
    skip(parser);
    declaration::binding(parser);
}

/// `stable` before the declaration of something else.
fn other(parser: &mut Parser<'_>) {
    let what = match parser.nth_span(1).of(parser.text) {
        _ if parser.nth(2) == Equal => "a primitive",
        "allread" | "allwrite" => "a shared variable",
        "param" => "a parameter",
        "const" => "a constant",
        _ => "this",
    };
    let message = alloc::format!("{what} cannot be stable");
    let problem = Diagnostic::new(Code::Misplaced, parser.span(), message);
    parser.report(problem.note("only a variable can, as in `stable left: Int = 3`"));
    skip(parser);
    if let Some((_, parse)) = form::form(parser) {
        parse(parser);
    }
}

/// Takes the word `stable` out of the declaration.
fn skip(parser: &mut Parser<'_>) {
    parser.start(Error);
    parser.bump();
    parser.finish();
}

/// Reports `stable` at a variable of a role.
pub(super) fn check_place(parser: &mut Parser<'_>, place: Place) {
    let is_stable = parser.at(Identifier) && parser.word() == "stable" && form(parser).is_some();
    if place == Place::Role && is_stable {
        let message = "a variable of a role cannot be stable";
        let problem = Diagnostic::new(Code::Misplaced, parser.span(), message);
        parser.report(problem.note(
            "it gets its initial value whenever the robot enters the role; declare it outside",
        ));
    }
}
