//! Operators of arithmetic: which types they join, and what to say where they do not.

use alloc::format;

use super::fit::{SAME_NAME, number_of, same, whole};
use super::report::{around, broken, joined};
use super::state::Checker;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{Expression, ExpressionKind, Operator, Type};
use crate::syntax::ast::BinaryOperator;

impl Checker {
    /// An operator of arithmetic, between values that were checked.
    pub fn arithmetic(
        &mut self,
        operator: BinaryOperator,
        left: Expression,
        right: Expression,
        span: Span,
    ) -> Expression {
        if left.ty == Type::Error || right.ty == Type::Error {
            return broken(span);
        }
        let (left, right) = alike(operator, left, right);
        let (Some(ty), Some(resolved)) = (result(operator, &left.ty, &right.ty), resolve(operator))
        else {
            self.report_operator(operator, &left, &right, span);
            return broken(span);
        };
        if ty == Type::Float && matches!(resolved, Operator::Add | Operator::Subtract) {
            self.check_dimensions(operator.text(), &left, &right, span);
        }
        joined(resolved, left, right, ty, span)
    }

    pub fn report_operator(
        &mut self,
        operator: BinaryOperator,
        left: &Expression,
        right: &Expression,
        span: Span,
    ) {
        let sign = operator.text();
        let (l, r) = (self.name_of(&left.ty), self.name_of(&right.ty));
        for side in [left, right] {
            if let Type::Optional(inner) = &side.ty
                && (result(operator, inner, inner).is_some() || self.program.is_ordered(inner))
            {
                let message = format!("an operand of `{sign}` may be none");
                let problem = Diagnostic::new(Code::MayBeNone, side.span, message);
                let problem = problem.found(self.name_of(&side.ty));
                self.report(
                    problem.note("test it with `if some x = ...`, or give a default with `?? ...`"),
                );
                return;
            }
        }
        if let (Type::Int, Type::Float) | (Type::Float, Type::Int) = (&left.ty, &right.ty) {
            let int = if left.ty == Type::Int { left } else { right };
            let message = format!("`{sign}` does not mix {l} and {r}");
            let problem = Diagnostic::new(Code::MixedNumbers, span, message);
            let problem = problem.label(int.span, "this is an Int");
            let problem = self.as_float(problem, int);
            self.report(problem);
            return;
        }
        let compares = matches!(
            operator,
            BinaryOperator::Equal
                | BinaryOperator::NotEqual
                | BinaryOperator::Less
                | BinaryOperator::LessEqual
                | BinaryOperator::Greater
                | BinaryOperator::GreaterEqual
        );
        let message = match (compares, left.ty == right.ty) {
            (true, true) => format!("`{sign}` does not compare {l}"),
            (true, false) => format!("`{sign}` does not compare {l} with {r}"),
            (false, _) => format!("`{sign}` does not apply to {l} and {r}"),
        };
        let problem = Diagnostic::new(Code::OperatorTypes, span, message);
        let look_the_same = l == r && left.ty != right.ty;
        let problem = problem.label(left.span, l).label(right.span, r);
        let is_scaling = matches!(operator, BinaryOperator::Multiply | BinaryOperator::Divide);
        self.report(match (&left.ty, &right.ty, operator) {
            _ if look_the_same => problem.note(SAME_NAME),
            (Type::Point, Type::Int, _) if is_scaling => self.as_float(problem, right),
            (Type::Int, Type::Point, BinaryOperator::Multiply) => self.as_float(problem, left),
            (Type::String, _, BinaryOperator::Add) => problem.fix(around(
                "convert it with `String(...)`",
                right.span,
                "String(",
                ")",
            )),
            (_, Type::String, BinaryOperator::Add) => problem.fix(around(
                "convert it with `String(...)`",
                left.span,
                "String(",
                ")",
            )),
            (Type::Robot, Type::Int, _) => problem.fix(number_of(left.span)),
            (Type::Int, Type::Robot, _) => problem.fix(number_of(right.span)),
            (Type::List(inner), element, BinaryOperator::Add) if same(inner, element) => {
                problem.fix(around("put it in brackets: a list of one", right.span, "[", "]"))
            }
            (Type::Set(inner), element, BinaryOperator::Add) if same(inner, element) => {
                problem.note("`s.add(x)` adds an element")
            }
            (Type::Map(..), _, BinaryOperator::Add) => {
                problem.note("`m[key] += x` changes the value of a key")
            }
            (Type::Set(_), Type::Set(_), BinaryOperator::Add) => problem.note("it is `a.union(b)`"),
            (Type::Set(_), Type::Set(_), BinaryOperator::Subtract) => {
                problem.note("it is `a.difference(b)`")
            }
            (Type::Time, Type::Duration | Type::Int | Type::Float, _) if compares => problem.note(
                "the time since a moment is a Duration: keep the moment in a variable, `since: Time = now`, and \
                 compare `now - since > 5s`, or write `pre condition for 5s`",
            ),
            (Type::List(_), Type::Int, BinaryOperator::Multiply) => {
                problem.note("a list of equal elements is `[x for i in 0..n]`")
            }
            (Type::Duration, Type::Int | Type::Float, _)
            | (Type::Int | Type::Float, Type::Duration, _) => {
                problem.note("a duration is written with its unit, such as `2s`")
            }
            _ => problem,
        });
    }

    /// The problem with a fix that makes the Int a Float.
    pub fn as_float(&self, problem: Diagnostic, int: &Expression) -> Diagnostic {
        match int.kind {
            ExpressionKind::Int(_) => {
                let float = format!("{}.0", self.text(int.span));
                problem.write(int.span, float)
            }
            _ => problem.fix(around(
                "convert it with `Float(...)`",
                int.span,
                "Float(",
                ")",
            )),
        }
    }
}

/// The operands, with a whole number as a Float where the other one needs that.
pub(super) fn alike(
    operator: BinaryOperator,
    left: Expression,
    right: Expression,
) -> (Expression, Expression) {
    use BinaryOperator::{Divide, Multiply};
    match (&left.ty, &right.ty, operator) {
        (Type::Float, Type::Int, _) | (Type::Point, Type::Int, Multiply | Divide) => {
            (left, whole(right))
        }
        (Type::Int, Type::Float, _) | (Type::Int, Type::Point, Multiply) => (whole(left), right),
        _ => (left, right),
    }
}

/// The operator of arithmetic, resolved.
pub(super) fn resolve(operator: BinaryOperator) -> Option<Operator> {
    Some(match operator {
        BinaryOperator::Add => Operator::Add,
        BinaryOperator::Subtract => Operator::Subtract,
        BinaryOperator::Multiply => Operator::Multiply,
        BinaryOperator::Divide => Operator::Divide,
        BinaryOperator::Remainder => Operator::Remainder,
        _ => return None,
    })
}

/// The result type of an arithmetic operator; none if it does not apply to the two.
pub(super) fn result(operator: BinaryOperator, left: &Type, right: &Type) -> Option<Type> {
    use BinaryOperator::{Add, Divide, Multiply, Remainder, Subtract};
    use Type::{Duration, Float, Int, List, Point, String, Time};
    Some(match (operator, left, right) {
        (Add | Subtract | Multiply | Divide | Remainder, Int, Int) => Int,
        (Add | Subtract | Multiply | Divide, Float, Float) => Float,
        (Add | Subtract, Duration, Duration) => Duration,
        (Add | Subtract, Time, Duration) | (Add, Duration, Time) => Time,
        (Subtract, Time, Time) => Duration,
        (Multiply | Divide, Duration, Int | Float) | (Multiply, Int | Float, Duration) => Duration,
        (Divide, Duration, Duration) => Float,
        (Add | Subtract, Point, Point) => Point,
        (Multiply | Divide, Point, Float) | (Multiply, Float, Point) => Point,
        (Add, String, String) => String,
        (Add, List(a), List(b)) if same(a, b) => left.clone(),
        _ => return None,
    })
}
