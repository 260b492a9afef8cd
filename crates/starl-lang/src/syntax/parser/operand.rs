//! Operands: literals, names, calls, elements, fields, brackets, and the forms that begin with a keyword.

use alloc::format;

use rowan::Checkpoint;

use super::collection::{self, iteration};
use super::expression::{self, Parsed, Shape, binary, condition, expression_parsed, power};
use super::item::name;
use super::{Code, Diagnostic, MAX_DEPTH, Parser, Span, SyntaxKind, SyntaxKind::*};
use super::{slips, types, words};
use crate::syntax::literal;

/// Whether an operand other than a literal can begin so.
pub(super) fn starts(kind: SyntaxKind) -> bool {
    matches!(
        kind,
        Identifier | LeftParen | LeftBracket | LeftBrace | SomeKeyword | IfKeyword
    )
}

/// An operand with its suffixes: fields, arguments, indices, `!`.
pub(super) fn postfix(parser: &mut Parser<'_>, start: Checkpoint) -> Parsed {
    let mut parsed = simple(parser);
    loop {
        let kind = match parser.current() {
            Dot => FieldExpression,
            LeftParen => CallExpression,
            LeftBracket => IndexExpression,
            Bang => UnwrapExpression,
            _ => return parsed,
        };
        if parsed.height + parser.depth >= MAX_DEPTH {
            parser.too_deep();
            return Parsed::BROKEN;
        }
        let mut height = 0;
        match kind {
            FieldExpression => {
                parser.bump();
                field_name(parser);
            }
            CallExpression => height = collection::arguments(parser),
            IndexExpression => height = index(parser),
            _ => parser.bump(),
        }
        parser.start_at(start, kind);
        parser.finish();
        let shape = match (kind, parsed.shape) {
            (_, Shape::Broken) => Shape::Broken,
            (CallExpression, _) => Shape::Call,
            (FieldExpression | IndexExpression, Shape::Target) => Shape::Target,
            _ => Shape::Other,
        };
        parsed = Parsed::new(shape, parsed.height.max(height) + 1);
    }
}

/// The name or the number after a dot; a keyword there can only be meant as a name.
fn field_name(parser: &mut Parser<'_>) {
    if parser.eat(IntegerLiteral) {
        return;
    }
    if parser.current().is_keyword() {
        let message = format!("{} is a keyword and cannot be a name", parser.found());
        parser.report(Diagnostic::new(Code::KeywordAsName, parser.span(), message));
        parser.bump();
    } else {
        parser.expect(Identifier);
    }
}

fn index(parser: &mut Parser<'_>) -> u32 {
    let open = parser.span();
    parser.bump();
    let parsed = expression_parsed(parser);
    if !parser.at(RightBracket) && !parser.at_line_end() {
        parser.unexpected(RightBracket.name());
        parser.skip_element();
    }
    parser.close(RightBracket, open);
    parsed.height
}

fn simple(parser: &mut Parser<'_>) -> Parsed {
    match parser.current() {
        kind if kind.is_literal() => number_or_other_literal(parser),
        Identifier | ForKeyword if is_quantifier(parser) => quantifier(parser),
        Identifier if matches!(parser.word(), "new" | "await") && parser.nth(1) == Identifier => {
            words::remove(parser, "a value begins with its name");
            simple(parser)
        }
        Identifier => {
            parser.start(NameExpression);
            parser.bump();
            parser.finish();
            Parsed::new(Shape::Target, 1)
        }
        LeftParen => parenthesized(parser),
        LeftBracket => collection::list(parser),
        LeftBrace => collection::braces(parser),
        SomeKeyword => some(parser),
        IfKeyword => conditional(parser),
        _ => {
            parser.unexpected("a value");
            Parsed::BROKEN
        }
    }
}

/// A literal; with a number also the unit that stands apart from it.
fn number_or_other_literal(parser: &mut Parser<'_>) -> Parsed {
    let (is_plain, number) = (
        matches!(parser.current(), IntegerLiteral | FloatLiteral),
        parser.span(),
    );
    parser.start(LiteralExpression);
    parser.bump();
    if is_plain
        && parser.at(Identifier)
        && let Some(name) = literal::unit_meant(parser.word())
    {
        let unit = parser.span();
        let problem = Diagnostic::new(
            Code::UnitApart,
            number.to(unit),
            "a number and its unit are one word",
        );
        let form = format!("write `{}{name}`", number.of(parser.text));
        parser.report(problem.replace(form, Span::new(number.end, unit.end), name));
        parser.start(Error);
        parser.bump();
        parser.finish();
    }
    parser.finish();
    Parsed::new(Shape::Other, 1)
}

/// `(a)` or `(a, b)`.
fn parenthesized(parser: &mut Parser<'_>) -> Parsed {
    let (open, start) = (parser.span(), parser.checkpoint());
    parser.bump();
    let mut parsed = binary(parser, 0);
    let comma = parser.span();
    let mut kind = ParenthesizedExpression;
    if parser.eat(Comma) {
        if parser.at(RightParen) {
            let problem = Diagnostic::new(Code::ShortTuple, comma, types::SHORT_TUPLE);
            parser.report(problem.replace("remove the comma", comma, ""));
        } else {
            kind = TupleExpression;
        }
        parser.separated(RightParen, open, |parser| {
            parsed.height = parsed.height.max(expression_parsed(parser).height);
        });
    } else {
        if !parser.at(RightParen) && !parser.at_line_end() {
            parser.unexpected(RightParen.name());
            parser.skip_element();
        }
        parser.close(RightParen, open);
    }
    parser.start_at(start, kind);
    parser.finish();
    let shape = if parsed.shape == Shape::Broken {
        Shape::Broken
    } else {
        Shape::Other
    };
    Parsed::new(shape, parsed.height + 1)
}

/// `some x = optional`.
fn some(parser: &mut Parser<'_>) -> Parsed {
    parser.start(SomeExpression);
    let word = parser.span();
    parser.bump();
    let name = parser.at(Identifier).then(|| parser.span());
    collection::pattern(parser);
    let parsed = if let Some(name) = name
        && (matches!(parser.current(), AndKeyword | OrKeyword | ThenKeyword)
            || parser.at_line_end())
    {
        let meant = format!("{} != none", name.of(parser.text));
        let fix = (&*format!("write `{meant}`"), &*meant);
        let message = "`some x = ...` names the value that is there";
        slips::foreign_operator(parser, word.to(name), message, fix);
        Parsed::BROKEN
    } else if parser.expect(Equal) {
        binary(parser, power::COMPARISON)
    } else {
        Parsed::BROKEN
    };
    parser.finish();
    Parsed::new(
        if parsed.shape == Shape::Broken {
            Shape::Broken
        } else {
            Shape::Other
        },
        parsed.height + 1,
    )
}

/// `if c then a else b`.
fn conditional(parser: &mut Parser<'_>) -> Parsed {
    parser.start(ConditionalExpression);
    parser.bump();
    let mut height = condition(parser).height;
    if parser.expect(ThenKeyword) {
        height = height.max(expression_parsed(parser).height);
        if parser.expect(ElseKeyword) {
            height = height.max(expression_parsed(parser).height);
        }
    }
    parser.finish();
    Parsed::new(Shape::Other, height + 1)
}

/// Whether `forall` or `exists` is next, with a name after it.
fn is_quantifier(parser: &Parser<'_>) -> bool {
    let length = match words::quantifier(parser) {
        // `all(x) in xs` calls a function.
        Some((_, length)) if parser.nth(length) == Identifier => length,
        Some(_) => return false,
        None if matches!(parser.word(), "forall" | "exists") => 1,
        None => return false,
    };
    runs_over(parser, length)
        || parser.nth(length) == Identifier && matches!(parser.nth(length + 1), Comma | Colon)
}

/// Whether `x in`, `k, v in` or the same with tuples of names is after the next `length` words.
fn runs_over(parser: &Parser<'_>, length: usize) -> bool {
    let is_name =
        |at: &usize| matches!(parser.nth(*at), Identifier | Comma | LeftParen | RightParen);
    let end = (length..).find(|at| !is_name(at)).unwrap_or_default();
    end > length && parser.nth(end) == InKeyword
}

/// `forall r, s: condition` or `forall x in xs: condition`.
fn quantifier(parser: &mut Parser<'_>) -> Parsed {
    let foreign = words::quantifier(parser);
    let is_over_collection = runs_over(parser, foreign.map_or(1, |(_, length)| length));
    parser.start(QuantifierExpression);
    if let Some((meant, length)) = foreign {
        words::take_quantifier(parser, meant, length);
    }
    parser.bump();
    let mut height = 0;
    if is_over_collection {
        height = iteration(parser);
    } else {
        name(parser);
        while parser.eat(Comma) {
            name(parser);
        }
    }
    parser.expect(Colon);
    height = height.max(expression::condition(parser).height);
    parser.finish();
    Parsed::new(Shape::Other, height + 1)
}
