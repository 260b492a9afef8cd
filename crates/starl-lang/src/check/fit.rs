//! Whether a value fits where it stands, and what to say if it does not.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;

use super::dimension::split_unit;
use super::report::around;
use super::state::Checker;
use crate::diagnostic::{Code, Diagnostic, Fix, Span};
use crate::ir::{Expression, ExpressionKind, Type};
use crate::syntax::ast;

/// The note on two different types with the same name.
pub(super) const SAME_NAME: &str =
    "these are two different types; declare one with a name, and use it for both";

/// Whether the types are equal, where errors equal every type.
pub(super) fn same(a: &Type, b: &Type) -> bool {
    match (a, b) {
        (Type::Error, _) | (_, Type::Error) => true,
        (Type::List(a), Type::List(b))
        | (Type::Set(a), Type::Set(b))
        | (Type::Optional(a), Type::Optional(b)) => same(a, b),
        (Type::Map(k, v), Type::Map(l, w)) => same(k, l) && same(v, w),
        _ => a == b,
    }
}

/// A robot as a number.
pub(super) fn number_of(robot: Span) -> Fix {
    around("`Int(...)` is the number of the robot", robot, "Int(", ")")
}

/// The text before and after a value that becomes an operand of a product or quotient.
fn operand(value: &Expression, after: &str) -> (&'static str, String) {
    match value.kind {
        ExpressionKind::Binary { .. }
        | ExpressionKind::Conditional { .. }
        | ExpressionKind::Default { .. } => ("(", format!("){after}")),
        _ => ("", String::from(after)),
    }
}

/// Whether this is a whole number of the text.
pub(super) fn is_whole(value: &Expression) -> bool {
    matches!(value.kind, ExpressionKind::Int(_))
}

/// Whether this is a Float, or a whole number of the text that a Float is equal to.
pub(super) fn fits_float(value: &Expression) -> bool {
    match value.kind {
        ExpressionKind::Int(number) => number.unsigned_abs() <= 1 << f64::MANTISSA_DIGITS,
        _ => value.ty == Type::Float,
    }
}

/// The value, where a Float belongs: a whole number is written `2` there as well as `2.0`, if a Float can be equal to it.
pub(super) fn whole(value: Expression) -> Expression {
    match value.kind {
        ExpressionKind::Int(number) if fits_float(&value) => Expression {
            kind: ExpressionKind::Float(number as f64),
            ty: Type::Float,
            span: value.span,
        },
        _ => value,
    }
}

impl Checker {
    /// Checks an expression whose type must be `expected`; `role` is its phrase in messages, such as "the condition".
    pub fn expect(
        &mut self,
        expression: Option<ast::Expression>,
        expected: &Type,
        role: &str,
    ) -> Expression {
        let value = self.infer(expression, Some(expected));
        self.fit(value, expected, role)
    }

    /// The value as one of the expected type.
    pub fn fit(&mut self, value: Expression, expected: &Type, role: &str) -> Expression {
        let value = match expected {
            Type::Float => whole(value),
            Type::Optional(inner) if **inner == Type::Float => whole(value),
            _ => value,
        };
        if same(&value.ty, expected) {
            return value;
        }
        if let Type::Optional(inner) = expected
            && same(&value.ty, inner)
        {
            let span = value.span;
            return Expression {
                kind: ExpressionKind::Present(Box::new(value)),
                ty: expected.clone(),
                span,
            };
        }
        if value.ty == Type::Range {
            return self.misplaced_range(value.span);
        }
        let problem = self.misfit(&value, expected, role);
        self.report(problem);
        Expression {
            ty: Type::Error,
            ..value
        }
    }

    /// A range where a value must stand.
    pub fn misplaced_range(&mut self, span: Span) -> Expression {
        let problem = Diagnostic::new(Code::MisplacedRange, span, "a range is not a value");
        self.refuse(problem.note("it stands after `in`: in `for i in 0..n` or `x in 0..n`"))
    }

    fn misfit(&self, value: &Expression, expected: &Type, role: &str) -> Diagnostic {
        let (span, found) = (value.span, &value.ty);
        let problem = |code, message| {
            Diagnostic::new(code, span, message)
                .expected(self.name_of(expected))
                .found(self.name_of(found))
        };
        let wrong = |what: &str| problem(Code::WrongType, format!("{role} {what}"));
        let wrong_type = || wrong("has the wrong type");
        match (found, expected) {
            (Type::Nothing, _) => wrong("is a call that gives nothing"),
            (Type::Optional(inner), _) if same(inner, expected) => {
                let problem = problem(Code::MayBeNone, format!("{role} may be none"));
                if *expected == Type::Bool {
                    return problem.note("ask with `some x = ...`, or with `!= none`");
                }
                problem.note("test it with `if some x = ...`, give a default with `?? ...`, or assert it with `!`")
            }
            (Type::Int, Type::Float) => {
                let problem = problem(Code::MixedNumbers, format!("{role} is an Int, not a Float"));
                self.as_float(problem, value)
            }
            (Type::Float, Type::Int) => {
                let problem = problem(Code::MixedNumbers, format!("{role} is a Float, not an Int"));
                let note =
                    "`Int(...)` drops the fraction; `round`, `floor` and `ceil` give an Int too";
                problem.note(note)
            }
            (Type::Robot, Type::Int) => wrong_type().fix(number_of(span)),
            (Type::Record(_), Type::Point) if self.text(span).starts_with('(') => {
                wrong_type().fix(around("write `Point(x, y)`", span, "Point", ""))
            }
            (Type::Int | Type::Float, Type::Duration)
                if matches!(
                    value.kind,
                    ExpressionKind::Int(_) | ExpressionKind::Float(_)
                ) =>
            {
                let (digits, unit) = split_unit(self.text(span));
                let (what, unit) = match unit {
                    "" => ("a time without a unit", "s"),
                    "deg" | "rad" => ("an angle, not a time", ""),
                    "m" => ("a length, not a time", "min"),
                    _ => ("a length, not a time", ""),
                };
                let problem = wrong(&format!("is {what}"));
                let meant = format!("{digits}{unit}");
                let form = match unit {
                    "s" => format!("write `{meant}` if these are seconds"),
                    "min" => format!("write `{meant}` if these are minutes"),
                    _ => return problem,
                };
                problem.replace(form, span, meant)
            }
            (Type::Duration, Type::Float) => {
                let (before, after) = operand(value, " / 1s");
                let fix = "divide it by a unit: `... / 1s` is its number of seconds";
                wrong("is a time, not a number").fix(around(fix, span, before, &after))
            }
            (Type::Int | Type::Float, Type::Duration) => {
                let (before, after) = operand(value, " * 1s");
                let fix = "multiply it by a unit: `... * 1s` if these are seconds";
                wrong("is a number, not a time").fix(around(fix, span, before, &after))
            }
            (Type::Int | Type::Optional(_), Type::Bool) => {
                let (text, form) = match found {
                    Type::Int => (" != 0", "compare it: `... != 0`"),
                    _ => (" != none", "test it: `... != none`"),
                };
                let (before, after) = operand(value, text);
                wrong_type().fix(around(form, span, before, &after))
            }
            (Type::List(_) | Type::Set(_) | Type::Map(..) | Type::String, Type::Bool) => {
                let (before, after) = operand(value, ".size() > 0");
                let fix = "test its size: `x.size() > 0`";
                wrong_type().fix(around(fix, span, before, &after))
            }
            (Type::Bool | Type::Int | Type::Float | Type::Duration | Type::Robot, Type::String) => {
                let fix = "convert it with `String(...)`";
                wrong_type().fix(around(fix, span, "String(", ")"))
            }
            (Type::String, Type::Int | Type::Float) => {
                wrong_type().note("`text.to_int()` and `text.to_float()` are optional numbers")
            }
            (_, Type::Set(inner)) if same(found, inner) => {
                wrong_type().fix(around("put it in braces: a set of one", span, "{", "}"))
            }
            (_, Type::List(inner)) if same(found, inner) => {
                wrong_type().fix(around("put it in brackets: a list of one", span, "[", "]"))
            }
            _ => {
                let is_same_name = self.name_of(found) == self.name_of(expected);
                wrong_type().note_if(is_same_name.then_some(SAME_NAME))
            }
        }
    }
}
