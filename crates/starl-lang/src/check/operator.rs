//! Operators between two values.

use alloc::boxed::Box;
use alloc::format;

use super::fit::same;
use super::report::{around, broken, made};
use super::shape::is_ordered;
use super::state::Checker;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{Expression, ExpressionKind, Operator, Type};
use crate::syntax::ast::{self, BinaryOperator, Literal};

impl Checker {
    /// An operator between two values.
    pub fn binary(
        &mut self,
        node: &ast::BinaryExpression,
        span: Span,
        expected: Option<&Type>,
    ) -> Expression {
        let Some(operator) = node.operator() else {
            return broken(span);
        };
        match operator {
            BinaryOperator::And | BinaryOperator::Or => {
                let role = format!("what `{}` joins", operator.text());
                let left = self.expect(node.left(), &Type::Bool, &role);
                let right = self.expect(node.right(), &Type::Bool, &role);
                let operator = if operator == BinaryOperator::And {
                    Operator::And
                } else {
                    Operator::Or
                };
                joined(operator, left, right, Type::Bool, span)
            }
            BinaryOperator::Equal | BinaryOperator::NotEqual => self.equality(node, operator, span),
            BinaryOperator::Less
            | BinaryOperator::LessEqual
            | BinaryOperator::Greater
            | BinaryOperator::GreaterEqual => self.order(node, operator, span),
            BinaryOperator::In => self.contained(node, span),
            BinaryOperator::Range => {
                let start =
                    Box::new(self.expect(node.left(), &Type::Int, "the start of the range"));
                let end = Box::new(self.expect(node.right(), &Type::Int, "the end of the range"));
                made(ExpressionKind::Range { start, end }, Type::Range, span)
            }
            BinaryOperator::Default => self.default(node, span, expected),
            _ => {
                let left = self.value(node.left(), expected, "what stands before the operator");
                let hint = left.ty.clone();
                let right = self.value(node.right(), Some(&hint), "what stands after the operator");
                self.arithmetic(operator, left, right, span)
            }
        }
    }

    /// Both sides of a comparison, each checked with the type of the other where it needs that.
    fn sides(&mut self, node: &ast::BinaryExpression) -> (Expression, Expression) {
        let (before, after) = (
            "what stands before the operator",
            "what stands after the operator",
        );
        let left_needs = node.left().is_some_and(|left| self.needs_hint(&left));
        let right_needs = node.right().is_some_and(|right| self.needs_hint(&right));
        if left_needs && !right_needs {
            let right = self.value(node.right(), None, after);
            let hint = comparable(&right.ty);
            return (self.value(node.left(), Some(&hint), before), right);
        }
        let left = self.value(node.left(), None, before);
        let is_none = matches!(node.right(), Some(ast::Expression::Literal(node)) if node.value() == Literal::None);
        let hint = if is_none {
            left.ty.clone()
        } else {
            comparable(&left.ty)
        };
        (left, self.value(node.right(), Some(&hint), after))
    }

    fn equality(
        &mut self,
        node: &ast::BinaryExpression,
        operator: BinaryOperator,
        span: Span,
    ) -> Expression {
        if let Some(other) = none_side(node) {
            return self.is_none(other, operator, span);
        }
        let (mut left, mut right) = self.sides(node);
        if matches!(&right.ty, Type::Optional(inner) if same(inner, &left.ty)) {
            let ty = right.ty.clone();
            left = self.fit(left, &ty, "");
        } else if matches!(&left.ty, Type::Optional(inner) if same(inner, &right.ty)) {
            let ty = left.ty.clone();
            right = self.fit(right, &ty, "");
        }
        if left.ty == Type::Error || right.ty == Type::Error {
            return broken_bool(span);
        }
        if !same(&left.ty, &right.ty) {
            self.report_operator(operator, &left, &right, span);
            return broken_bool(span);
        }
        let operator = if operator == BinaryOperator::Equal {
            Operator::Equal
        } else {
            Operator::NotEqual
        };
        joined(operator, left, right, Type::Bool, span)
    }

    /// `other == none` or `other != none`.
    fn is_none(
        &mut self,
        other: ast::Expression,
        operator: BinaryOperator,
        span: Span,
    ) -> Expression {
        let other = self.value(Some(other), None, "what may be none");
        match &other.ty {
            Type::Optional(_) | Type::Error => {}
            ty => {
                let message = "this is never none";
                let problem = Diagnostic::new(Code::NotOptional, other.span, message);
                let problem = problem.found(self.name_of(ty));
                self.report(problem.note("only an optional, such as `Point?`, may be none"));
                return broken_bool(span);
            }
        }
        let kind = ExpressionKind::IsNone(Box::new(other));
        let is_none = made(kind, Type::Bool, span);
        if operator == BinaryOperator::Equal {
            return is_none;
        }
        made(ExpressionKind::Not(Box::new(is_none)), Type::Bool, span)
    }

    fn order(
        &mut self,
        node: &ast::BinaryExpression,
        operator: BinaryOperator,
        span: Span,
    ) -> Expression {
        let (left, right) = self.sides(node);
        if left.ty == Type::Error || right.ty == Type::Error {
            return broken_bool(span);
        }
        if !same(&left.ty, &right.ty) || !is_ordered(&left.ty) {
            self.report_operator(operator, &left, &right, span);
            return broken_bool(span);
        }
        let operator = match operator {
            BinaryOperator::Less => Operator::Less,
            BinaryOperator::LessEqual => Operator::LessEqual,
            BinaryOperator::Greater => Operator::Greater,
            _ => Operator::GreaterEqual,
        };
        joined(operator, left, right, Type::Bool, span)
    }

    fn contained(&mut self, node: &ast::BinaryExpression, span: Span) -> Expression {
        let is_literal = |expression: &Option<ast::Expression>| {
            matches!(
                expression,
                Some(ast::Expression::List(_) | ast::Expression::Brace(_))
            )
        };
        let collection_first =
            !is_literal(&node.right()) || node.left().is_some_and(|left| self.needs_hint(&left));
        let (item, collection) = if collection_first {
            let collection = self.infer(node.right(), None);
            let hint = element_type(&collection.ty);
            (
                self.value(node.left(), hint.as_ref(), "what is looked for"),
                collection,
            )
        } else {
            let item = self.value(node.left(), None, "what is looked for");
            let element = comparable(&item.ty);
            let hint = match node.right() {
                Some(ast::Expression::List(_)) => Type::list(element),
                Some(ast::Expression::Brace(brace)) if !brace.is_map() => Type::set(element),
                _ => Type::Error,
            };
            let hint = Some(&hint).filter(|hint| !hint.has_error());
            (item, self.infer(node.right(), hint))
        };
        if collection.ty == Type::Error {
            return broken_bool(span);
        }
        let Some(element) = element_type(&collection.ty) else {
            let message = "it cannot be looked in this";
            let problem = Diagnostic::new(Code::NotCollection, collection.span, message);
            let found = self.name_of(&collection.ty);
            let expected = "a list, a set, a map, a range or a text";
            self.report(problem.expected(expected).found(found));
            return broken_bool(span);
        };
        let item = self.fit(item, &element, "what is looked for");
        let kind = ExpressionKind::In {
            item: Box::new(item),
            collection: Box::new(collection),
        };
        let found = made(kind, Type::Bool, span);
        if node.is_negated() {
            return made(ExpressionKind::Not(Box::new(found)), Type::Bool, span);
        }
        found
    }

    fn default(
        &mut self,
        node: &ast::BinaryExpression,
        span: Span,
        expected: Option<&Type>,
    ) -> Expression {
        let hint = expected.cloned().map(Type::optional);
        let optional = self.value(node.left(), hint.as_ref(), "what may be none");
        let inner = match &optional.ty {
            Type::Optional(inner) => (**inner).clone(),
            Type::Error => {
                self.infer(node.right(), expected);
                return broken(span);
            }
            ty => {
                let message = "`??` needs an optional before it, and this is always there";
                let problem = Diagnostic::new(Code::NotOptional, optional.span, message);
                let found = self.name_of(ty);
                self.report(problem.found(found));
                return optional;
            }
        };
        let is_none = matches!(node.right(), Some(ast::Expression::Literal(node)) if node.value() == Literal::None);
        let hint = if is_none {
            optional.ty.clone()
        } else {
            inner.clone()
        };
        let default = self.value(node.right(), Some(&hint), "what it is if there is none");
        let ty = if matches!(default.ty, Type::Optional(_)) {
            optional.ty.clone()
        } else {
            inner
        };
        let default = self.fit(default, &ty, "what it is if there is none");
        let kind = ExpressionKind::Default {
            optional: Box::new(optional),
            default: Box::new(default),
        };
        made(kind, ty, span)
    }

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
        let (Some(ty), Some(resolved)) = (result(operator, &left.ty, &right.ty), resolve(operator))
        else {
            self.report_operator(operator, &left, &right, span);
            return broken(span);
        };
        joined(resolved, left, right, ty, span)
    }

    fn report_operator(
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
                && (result(operator, inner, inner).is_some() || is_ordered(inner))
            {
                let message = format!("what `{sign}` joins may be none");
                let problem = Diagnostic::new(Code::MayBeNone, side.span, message);
                let problem = problem.found(self.name_of(&side.ty));
                self.report(problem.note(
                    "ask first with `if some x = ...`, or say what it is then with `?? ...`",
                ));
                return;
            }
        }
        if let (Type::Int, Type::Float) | (Type::Float, Type::Int) = (&left.ty, &right.ty) {
            let int = if left.ty == Type::Int { left } else { right };
            let message = format!("`{sign}` does not mix {l} and {r}");
            let problem = Diagnostic::new(Code::MixedNumbers, span, message);
            let problem = problem.label(int.span, "this is an Int");
            self.report(match int.kind {
                ExpressionKind::Int(_) => {
                    let float = format!("{}.0", self.text(int.span));
                    problem.replace(format!("write `{float}`"), int.span, float)
                }
                _ => problem.mend(around(
                    "convert it with `Float(...)`",
                    int.span,
                    "Float(",
                    ")",
                )),
            });
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
            (false, _) => format!("`{sign}` does not join {l} and {r}"),
        };
        let problem = Diagnostic::new(Code::OperatorTypes, span, message);
        let problem = problem.label(left.span, l).label(right.span, r);
        self.report(match (&left.ty, &right.ty, operator) {
            (Type::String, _, BinaryOperator::Add) => problem.mend(around(
                "make a text of it with `String(...)`",
                right.span,
                "String(",
                ")",
            )),
            (_, Type::String, BinaryOperator::Add) => problem.mend(around(
                "make a text of it with `String(...)`",
                left.span,
                "String(",
                ")",
            )),
            (Type::Set(_), Type::Set(_), BinaryOperator::Add) => problem.note("it is `a.union(b)`"),
            (Type::Set(_), Type::Set(_), BinaryOperator::Subtract) => {
                problem.note("it is `a.difference(b)`")
            }
            (Type::Duration, Type::Int | Type::Float, _)
            | (Type::Int | Type::Float, Type::Duration, _) => {
                problem.note("a duration is written with its unit, such as `2s`")
            }
            _ => problem,
        });
    }
}

/// What a bare name on the other side of a comparison is expected to be.
fn comparable(ty: &Type) -> Type {
    match ty {
        Type::Optional(inner) => (**inner).clone(),
        _ => ty.clone(),
    }
}

/// The side of a comparison whose other side is `none`.
fn none_side(node: &ast::BinaryExpression) -> Option<ast::Expression> {
    let is_none = |side: &Option<ast::Expression>| matches!(side, Some(ast::Expression::Literal(literal)) if literal.value() == Literal::None);
    match (is_none(&node.left()), is_none(&node.right())) {
        (false, true) => node.left(),
        (true, false) => node.right(),
        _ => None,
    }
}

fn element_type(collection: &Type) -> Option<Type> {
    Some(match collection {
        Type::List(element) | Type::Set(element) => (**element).clone(),
        Type::Map(key, _) => (**key).clone(),
        Type::Range => Type::Int,
        Type::String => Type::String,
        _ => return None,
    })
}

fn joined(
    operator: Operator,
    left: Expression,
    right: Expression,
    ty: Type,
    span: Span,
) -> Expression {
    let kind = ExpressionKind::Binary {
        operator,
        left: Box::new(left),
        right: Box::new(right),
    };
    made(kind, ty, span)
}

/// A comparison with an error: it is a Bool all the same.
fn broken_bool(span: Span) -> Expression {
    made(ExpressionKind::Error, Type::Bool, span)
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

/// The type of what an operator of arithmetic gives; none if it does not join the two.
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
