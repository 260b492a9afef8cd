//! Expressions: operators by precedence (Pratt, 1973).

use alloc::format;

use rowan::Checkpoint;

use super::operand::{self, postfix};
use super::{Code, Diagnostic, MAX_DEPTH, Parser, Span, SyntaxKind, SyntaxKind::*, words};

/// The shape of an expression, for the parser of statements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    /// Something that can be assigned to: a name, or a field or an element of one.
    Target,
    /// A call.
    Call,
    /// `a == b`, with the place of the operator.
    Equality(Span),
    /// Anything else.
    Other,
    /// Something that could not be understood and is reported.
    Broken,
}

/// An expression that was parsed.
#[derive(Clone, Copy)]
pub(super) struct Parsed {
    /// Its shape.
    pub shape: Shape,
    /// How deep its tree is.
    pub height: u32,
}

impl Parsed {
    pub const BROKEN: Self = Self {
        shape: Shape::Broken,
        height: 1,
    };

    pub const fn new(shape: Shape, height: u32) -> Self {
        Self { shape, height }
    }
}

/// How tightly operators bind; a higher number binds tighter.
pub(super) mod power {
    pub const OR: u8 = 1;
    pub const AND: u8 = 2;
    pub const NOT: u8 = 3;
    pub const COMPARISON: u8 = 4;
    pub const RANGE: u8 = 5;
    pub const DEFAULT: u8 = 6;
    pub const SUM: u8 = 7;
    pub const PRODUCT: u8 = 8;
    pub const SIGN: u8 = 9;
}

/// Parses an expression, or reports that it is missing.
pub(super) fn expression(parser: &mut Parser<'_>) -> Shape {
    expression_parsed(parser).shape
}

/// The same, with its height.
pub(super) fn expression_parsed(parser: &mut Parser<'_>) -> Parsed {
    let before = core::mem::replace(&mut parser.equals_compare, false);
    let (start, first) = (parser.checkpoint(), parser.span().start);
    let mut parsed = binary(parser, 0);
    if words::is_condition_after_value(parser) && parsed.height + parser.depth < MAX_DEPTH {
        let rest = parser.deeper(|parser| words::condition_after_value(parser, first));
        parser.start_at(start, Error);
        parser.finish();
        parsed = rest.map_or(Parsed::BROKEN, |()| {
            Parsed::new(Shape::Broken, parsed.height + 1)
        });
    }
    parser.equals_compare = before;
    parsed
}

/// An expression that is true or false, in which `=` can only be a slip.
pub(super) fn condition(parser: &mut Parser<'_>) -> Parsed {
    if parser.at_line_end() || parser.at(ThenKeyword) {
        parser.unexpected("a condition");
        return Parsed::BROKEN;
    }
    let before = core::mem::replace(&mut parser.equals_compare, true);
    let parsed = binary(parser, 0);
    parser.equals_compare = before;
    parsed
}

/// An expression of operators that bind at least as tightly as `least`.
pub(super) fn binary(parser: &mut Parser<'_>, least: u8) -> Parsed {
    parser
        .deeper(|parser| binary_here(parser, least))
        .unwrap_or(Parsed::BROKEN)
}

fn binary_here(parser: &mut Parser<'_>, least: u8) -> Parsed {
    let (start, first) = (parser.checkpoint(), parser.span().start);
    let mut left = match prefix(parser, start) {
        Some(parsed) => parsed,
        None => postfix(parser, start),
    };
    let mut compared: Option<u32> = None;
    while let Some((power, right_power)) = operator(parser).filter(|(power, _)| *power >= least) {
        let foreign = words::operator(parser);
        if left.height + parser.depth >= MAX_DEPTH {
            parser.too_deep();
            return Parsed::BROKEN;
        }
        let (kind, span) = (parser.current(), parser.span());
        let steps = kind == Minus && parser.nth(1) == Minus && ends_line(parser.nth(2));
        // A time after a comparison and `in` can only be a deadline.
        let ends = kind == InKeyword && parser.nth(1) == DurationLiteral && compared.is_some();
        if steps || ends {
            return left;
        }
        if kind == Equal && foreign.is_none() {
            slip_equal(parser, span);
        }
        if let Some(operand) = compared.filter(|_| power == power::COMPARISON) {
            chained(parser, span, operand);
        }
        match foreign {
            Some(foreign) => words::take_operator(parser, &foreign, first),
            None => parser.bump(),
        }
        if kind == NotKeyword {
            // `operator` saw the `in`.
            parser.bump();
        }
        let operand = parser.span().start;
        let right = binary(parser, right_power);
        parser.start_at(start, BinaryExpression);
        parser.finish();
        compared = (power == power::COMPARISON).then_some(operand);
        let is_equality = kind == EqualEqual;
        let shape = match right.shape {
            Shape::Broken => Shape::Broken,
            _ if is_equality && matches!(left.shape, Shape::Target) => Shape::Equality(span),
            _ => Shape::Other,
        };
        left = Parsed::new(shape, left.height.max(right.height) + 1);
    }
    left
}

/// Whether a statement is over when this is next.
fn ends_line(kind: SyntaxKind) -> bool {
    matches!(kind, Newline | Semicolon | Dedent | EndOfFile | ElseKeyword)
}

/// The powers of the operator that is next, and of its right operand.
fn operator(parser: &Parser<'_>) -> Option<(u8, u8)> {
    let left_first = |power| Some((power, power + 1));
    let foreign = words::operator(parser).map(|foreign| foreign.kind);
    match foreign.unwrap_or(parser.current()) {
        OrKeyword | Arrow if foreign.is_some() || parser.at(OrKeyword) => left_first(power::OR),
        AndKeyword => left_first(power::AND),
        Equal if parser.equals_compare => left_first(power::COMPARISON),
        InKeyword => left_first(power::COMPARISON),
        NotKeyword if parser.nth(1) == InKeyword => left_first(power::COMPARISON),
        kind if kind.is_comparison() => left_first(power::COMPARISON),
        DotDot => left_first(power::RANGE),
        QuestionQuestion => Some((power::DEFAULT, power::DEFAULT)),
        Plus | Minus => left_first(power::SUM),
        Star | Slash | Percent => left_first(power::PRODUCT),
        _ => None,
    }
}

/// An operand with an operator before it, if one is next.
fn prefix(parser: &mut Parser<'_>, start: Checkpoint) -> Option<Parsed> {
    let kind = parser.current();
    let power = match kind {
        Minus => power::SIGN,
        NotKeyword => power::NOT,
        Bang => {
            let span = parser.span();
            let fix = ("write `not`", "not ");
            super::slips::foreign_operator(
                parser,
                span,
                "`!` before a value is written `not`",
                fix,
            );
            power::SIGN
        }
        _ => return None,
    };
    parser.bump();
    let operand = binary(parser, power);
    parser.start_at(start, PrefixExpression);
    parser.finish();
    let shape = if operand.shape == Shape::Broken {
        Shape::Broken
    } else {
        Shape::Other
    };
    Some(Parsed::new(shape, operand.height + 1))
}

/// `=` where only a comparison makes sense.
fn slip_equal(parser: &mut Parser<'_>, span: Span) {
    let problem = Diagnostic::new(
        Code::AssignmentInCondition,
        span,
        "`=` assigns, but a condition stands here",
    );
    parser.report(problem.replace("compare with `==`", span, "=="));
}

/// `a < b < c`; `operand` is where `b` starts.
fn chained(parser: &mut Parser<'_>, span: Span, operand: u32) {
    let middle = Span::new(operand, parser.end_of_last());
    let text = middle.of(parser.text);
    let problem = Diagnostic::new(
        Code::ChainedComparison,
        span,
        "a comparison cannot be compared again",
    );
    let fix = format!(" and {text}");
    let form = format!("write `and {text}` before it");
    parser.report(problem.replace(form, Span::empty(middle.end), fix));
}

/// Whether the kind can begin an operand.
pub(super) fn starts(kind: SyntaxKind) -> bool {
    kind.is_literal() || operand::starts(kind) || matches!(kind, Minus | NotKeyword | Bang)
}

impl Parser<'_> {
    /// Whether an expression can begin with the next token.
    pub fn starts_operand(&self) -> bool {
        starts(self.current())
    }
}
