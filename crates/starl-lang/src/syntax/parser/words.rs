//! Words and symbols of other languages that stand where StarL has its own: operators, clauses, loops, quantifiers.
//!
//! Each is reported with its fix, and then parsed as what it stands for.

use alloc::format;
use alloc::string::String;

use super::expression::{self, condition, power};
use super::{Code, Diagnostic, Parser, Span, SyntaxKind, SyntaxKind::*, slips};
use crate::diagnostic::{Edit, Fix};

/// An operator of another language.
pub(super) struct Operator {
    /// The kind of StarL's operator; `->` for an implication, which StarL writes with `not` and `or`.
    pub kind: SyntaxKind,
    /// How many lexemes it has.
    pub length: usize,
}

/// The operator of another language that is next, after a value.
pub(super) fn operator(parser: &Parser<'_>) -> Option<Operator> {
    operator_at(parser, 0)
}

/// The same, after `ahead` other lexemes.
pub(super) fn operator_at(parser: &Parser<'_>, ahead: usize) -> Option<Operator> {
    let next = parser.nth(ahead + 1);
    let span = parser.nth_span(ahead);
    let touches = span.end == parser.nth_span(ahead + 1).start;
    let (kind, length) = match parser.nth(ahead) {
        Identifier if !expression::starts(next) => return None,
        Identifier => match span.of(parser.text) {
            "is" if next == NotKeyword => (NotEqual, 2),
            "is" | "equals" => (EqualEqual, 1),
            "xor" => (NotEqual, 1),
            "mod" => (Percent, 1),
            "div" => (Slash, 1),
            "implies" => (Arrow, 1),
            _ => return None,
        },
        Arrow if parser.equals_compare => (Arrow, 1),
        Equal if parser.equals_compare && next == Greater && touches => (Arrow, 2),
        EqualEqual if next == Greater && touches => (Arrow, 2),
        _ => return None,
    };
    Some(Operator { kind, length })
}

/// Takes the operator of another language that is next, after what starts at the byte `left`.
pub(super) fn take_operator(parser: &mut Parser<'_>, operator: &Operator, left: u32) {
    let span = parser.span().to(parser.nth_span(operator.length - 1));
    let written = span.of(parser.text);
    if operator.kind == Arrow {
        let problem = Diagnostic::new(
            Code::ForeignOperator,
            span,
            format!("there is no operator `{written}`"),
        );
        let before = Span::new(parser.end_of_last(), span.end);
        let edits = [
            Edit::new(Span::empty(left), "not ("),
            Edit::new(before, ") or"),
        ];
        let message = "write `not (a) or b` for `a` implies `b`".into();
        parser.report(problem.fix(Fix {
            message,
            edits: edits.into(),
        }));
    } else if let Some(meant) = operator.kind.text() {
        let message = format!("`{written}` is written `{meant}`");
        let fix = format!("write `{meant}`");
        slips::foreign_operator(parser, span, &message, (&fix, meant));
    }
    (0..operator.length).for_each(|_| parser.bump());
}

/// Whether `if c else b` is next, which Python puts after a value.
pub(super) fn is_condition_after_value(parser: &Parser<'_>) -> bool {
    if !parser.at(IfKeyword) {
        return false;
    }
    let mut open = 0_u32;
    for ahead in 1.. {
        match parser.nth(ahead) {
            ElseKeyword if open == 0 => return true,
            Newline | Semicolon | Indent | Dedent | EndOfFile | ThenKeyword => return false,
            Comma if open == 0 => return false,
            kind if kind.closing().is_some() => open += 1,
            kind if kind.is_closing() && open == 0 => return false,
            kind if kind.is_closing() => open -= 1,
            _ => {}
        }
    }
    false
}

/// Reports `a if c else b`, whose value `a` starts at the byte `start`.
pub(super) fn condition_after_value(parser: &mut Parser<'_>, start: u32) {
    let (end, word) = (parser.end_of_last(), parser.span());
    parser.bump();
    let first = parser.span();
    condition(parser);
    let asked = Span::new(first.start, parser.end_of_last().max(first.start));
    let otherwise = parser.span();
    if !parser.eat(ElseKeyword) {
        return parser.unexpected("`else`");
    }
    expression::expression(parser);
    let before = format!("if {} then ", asked.of(parser.text));
    let edits = [
        Edit::new(Span::empty(start), before),
        Edit::new(Span::new(end, otherwise.end), " else"),
    ];
    let message = "the condition of a choice stands before its values";
    let problem = Diagnostic::new(Code::ForeignOperator, word, message);
    parser.report(problem.fix(Fix {
        message: "write `if condition then a else b`".into(),
        edits: edits.into(),
    }));
}

/// Takes the word for `within` that is next, if there is one.
pub(super) fn deadline(parser: &mut Parser<'_>) -> bool {
    let is_word = parser.at(InKeyword) || matches!(parser.word(), "before" | "until");
    if is_word && expression::starts(parser.nth(1)) {
        replace(parser, "a deadline begins with `within`", "within");
        return true;
    }
    false
}

/// The clause of an action that the next word stands for: `pre` or `eff`.
pub(super) fn clause(parser: &Parser<'_>) -> Option<SyntaxKind> {
    let next = parser.nth(1);
    let opens = next.is_keyword() || next.is_literal();
    if !opens && !matches!(next, Identifier | Colon | Newline) {
        return None;
    }
    match parser.word() {
        "guard" | "when" | "requires" | "precondition" => Some(PreKeyword),
        "effect" | "do" | "effects" => Some(EffKeyword),
        _ => None,
    }
}

/// Reports the word that is next, and takes it, where `meant` should stand.
pub(super) fn replace(parser: &mut Parser<'_>, message: &str, meant: &str) {
    let span = parser.span();
    let problem = Diagnostic::new(Code::ForeignOperator, span, message);
    parser.report(problem.replace(format!("write `{}`", meant.trim()), span, meant));
    take(parser);
}

/// Reports the word that is next, and takes it, where nothing should stand.
pub(super) fn remove(parser: &mut Parser<'_>, message: &str) {
    let span = Span::new(parser.span().start, parser.nth_span(1).start);
    let problem = Diagnostic::new(Code::ForeignOperator, parser.span(), message);
    parser.report(problem.replace("remove this word", span, ""));
    take(parser);
}

fn take(parser: &mut Parser<'_>) {
    parser.start(Error);
    parser.bump();
    parser.finish();
}

/// The quantifier that the next words stand for, and how many they are.
pub(super) fn quantifier(parser: &Parser<'_>) -> Option<(&'static str, usize)> {
    match (parser.current(), parser.word()) {
        (ForKeyword, _) if matches!(parser.nth_span(1).of(parser.text), "all" | "every") => {
            Some(("forall", 2))
        }
        (Identifier, "all" | "every" | "each") => Some(("forall", 1)),
        (Identifier, "any" | "exist") => Some(("exists", 1)),
        _ => None,
    }
}

/// Reports the quantifier, and takes all of its words but the last.
pub(super) fn take_quantifier(parser: &mut Parser<'_>, meant: &str, length: usize) {
    let span = parser.span().to(parser.nth_span(length - 1));
    let message = format!("`{}` is written `{meant}`", span.of(parser.text));
    let fix = format!("write `{meant}`");
    slips::foreign_operator(parser, span, &message, (&fix, meant));
    (1..length).for_each(|_| take(parser));
}

/// Takes the words that other languages put after `for`; whether a loop of C took the whole line.
pub(super) fn loop_words(parser: &mut Parser<'_>) -> bool {
    if parser.at_word("each") && parser.nth(1) == Identifier {
        remove(parser, "`for` needs no `each`");
    }
    let counts = |at: usize| parser.nth(at) == Identifier && parser.nth(at + 1) == Equal;
    let in_brackets = parser.at(LeftParen);
    if !counts(0) && !(in_brackets && (counts(1) || parser.nth(1) == LetKeyword || counts(2))) {
        return false;
    }
    let message = "a loop goes over a collection or a range";
    let problem = Diagnostic::new(Code::ForeignStatement, parser.span(), message);
    parser.report(problem.note("`for i in 0..n` counts from 0 to below `n`"));
    parser.start(Error);
    while !matches!(parser.current(), Newline | Dedent | EndOfFile) {
        parser.bump();
    }
    if parser.at(Newline) && parser.nth(1) == Indent {
        parser.bump();
        parser.skip_block();
    }
    parser.finish();
    true
}

/// `++x`, which takes the whole statement.
pub(super) fn step_before(parser: &mut Parser<'_>) {
    let (operator, place) = (parser.span(), parser.nth_span(1).start);
    take(parser);
    expression::binary(parser, power::SIGN);
    let target = Span::new(place, parser.end_of_last().max(place));
    let form: String = format!("{} += 1", target.of(parser.text));
    let whole = operator.to(target);
    let message = "there is no operator `++`";
    slips::foreign_operator(parser, whole, message, (&format!("write `{form}`"), &form));
}
