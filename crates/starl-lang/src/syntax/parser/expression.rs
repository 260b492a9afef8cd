//! Expressions: operators by precedence (Pratt, 1973).

use alloc::format;

use rowan::Checkpoint;

use super::{Code, Diagnostic, MAX_DEPTH, Parser, Span, SyntaxKind, SyntaxKind::*};

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

    /// The same within an operator or brackets.
    pub fn enclosed(self) -> Self {
        let is_broken = self.shape == Shape::Broken;
        let shape = if is_broken { self.shape } else { Shape::Other };
        Self::new(shape, self.height + 1)
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

impl Parser<'_> {
    /// Parses an expression, or reports that it is missing.
    pub(super) fn expression(&mut self) -> Parsed {
        let before = core::mem::replace(&mut self.equals_compare, false);
        let (start, first) = (self.checkpoint(), self.span().start);
        let mut parsed = self.binary(0);
        if self.is_condition_after_value() && parsed.height + self.depth < MAX_DEPTH {
            let rest = self.deeper(|parser| parser.condition_after_value(first));
            self.start_at(start, Error);
            self.finish();
            parsed = rest.map_or(Parsed::BROKEN, |()| {
                Parsed::new(Shape::Broken, parsed.height + 1)
            });
        }
        self.equals_compare = before;
        parsed
    }

    /// An expression that is true or false, in which `=` can only be a slip.
    pub(super) fn condition(&mut self) -> Parsed {
        if self.at_line_end() || self.at(ThenKeyword) {
            self.unexpected("a condition");
            return Parsed::BROKEN;
        }
        let before = core::mem::replace(&mut self.equals_compare, true);
        let parsed = self.binary(0);
        self.equals_compare = before;
        parsed
    }

    /// An expression of operators that bind at least as tightly as `least`.
    pub(super) fn binary(&mut self, least: u8) -> Parsed {
        self.deeper(|parser| parser.binary_here(least))
            .unwrap_or(Parsed::BROKEN)
    }

    fn binary_here(&mut self, least: u8) -> Parsed {
        let (start, first) = (self.checkpoint(), self.span().start);
        let mut left = match self.prefix(start) {
            Some(parsed) => parsed,
            None => self.postfix(start),
        };
        let mut compared: Option<u32> = None;
        while let Some((power, right_power)) = self.operator().filter(|(power, _)| *power >= least)
        {
            let foreign = self.foreign_operator(0);
            if left.height + self.depth >= MAX_DEPTH {
                self.too_deep();
                return Parsed::BROKEN;
            }
            let (kind, span) = (self.current(), self.span());
            let steps = kind == Minus && self.nth(1) == Minus && ends_line(self.nth(2));
            // A time after a comparison and `in` can only be a deadline.
            let ends = kind == InKeyword && self.nth(1) == DurationLiteral && compared.is_some();
            if steps || ends {
                return left;
            }
            if kind == Equal && foreign.is_none() {
                self.slip_equal(span);
            }
            if let Some(operand) = compared.filter(|_| power == power::COMPARISON) {
                self.chained(span, operand);
            }
            match foreign {
                Some(foreign) => self.take_operator(&foreign, first),
                None => self.bump(),
            }
            if kind == NotKeyword {
                // `operator` saw the `in`.
                self.bump();
            }
            let operand = self.span().start;
            let right = self.binary(right_power);
            self.start_at(start, BinaryExpression);
            self.finish();
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

    /// The powers of the operator that is next, and of its right operand.
    fn operator(&self) -> Option<(u8, u8)> {
        let left_first = |power| Some((power, power + 1));
        let foreign = self.foreign_operator(0).map(|foreign| foreign.kind);
        match foreign.unwrap_or(self.current()) {
            OrKeyword | Arrow if foreign.is_some() || self.at(OrKeyword) => left_first(power::OR),
            AndKeyword => left_first(power::AND),
            Equal if self.equals_compare => left_first(power::COMPARISON),
            InKeyword => left_first(power::COMPARISON),
            NotKeyword if self.nth(1) == InKeyword => left_first(power::COMPARISON),
            kind if kind.is_comparison() => left_first(power::COMPARISON),
            DotDot => left_first(power::RANGE),
            QuestionQuestion => Some((power::DEFAULT, power::DEFAULT)),
            Plus | Minus => left_first(power::SUM),
            Star | Slash | Percent => left_first(power::PRODUCT),
            _ => None,
        }
    }

    /// An operand with an operator before it, if one is next.
    fn prefix(&mut self, start: Checkpoint) -> Option<Parsed> {
        let kind = self.current();
        let power = match kind {
            Minus => power::SIGN,
            NotKeyword => power::NOT,
            Bang => {
                let message = "`!` before a value is written `not`";
                self.report_operator(self.span(), message, "not ");
                power::SIGN
            }
            _ => return None,
        };
        self.bump();
        let operand = self.binary(power);
        self.start_at(start, PrefixExpression);
        self.finish();
        Some(operand.enclosed())
    }

    /// Whether an expression can begin after `ahead` other lexemes.
    pub(super) fn starts_operand(&self, ahead: usize) -> bool {
        let kind = self.nth(ahead);
        let begins = matches!(
            kind,
            Identifier
                | LeftParen
                | LeftBracket
                | LeftBrace
                | SomeKeyword
                | IfKeyword
                | Minus
                | NotKeyword
                | Bang
        );
        begins || kind.is_literal()
    }

    /// `=` where only a comparison makes sense.
    fn slip_equal(&mut self, span: Span) {
        let message = "`=` assigns, but a condition stands here";
        let problem = Diagnostic::new(Code::AssignmentInCondition, span, message);
        self.report(problem.replace("compare with `==`", span, "=="));
    }

    /// `a < b < c`; `operand` is where `b` starts.
    fn chained(&mut self, span: Span, operand: u32) {
        let middle = Span::new(operand, self.end_of_last());
        let text = middle.of(self.text);
        let message = "a comparison cannot be compared again";
        let problem = Diagnostic::new(Code::ChainedComparison, span, message);
        let fix = format!(" and {text}");
        let form = format!("write `and {text}` before it");
        self.report(problem.replace(form, Span::empty(middle.end), fix));
    }
}

/// Whether a statement is over when this is next.
fn ends_line(kind: SyntaxKind) -> bool {
    matches!(kind, Newline | Semicolon | Dedent | EndOfFile | ElseKeyword)
}
