//! Comparisons: equality, order, `none`, and `in`.

use alloc::boxed::Box;

use super::arithmetic::alike;
use super::body::Where;
use super::fit::same;
use super::report::{joined, made};
use super::state::Checker;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{Expression, ExpressionKind, Operator, Type};
use crate::syntax::ast::{self, BinaryOperator, Literal};

impl Checker {
    /// Both sides of a comparison, each checked with the type of the other where it needs that.
    pub fn sides(&mut self, node: &ast::BinaryExpression) -> (Expression, Expression) {
        let (before, after) = ("the left operand", "the right operand");
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

    pub fn equality(
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
        let (left, right) = alike(operator, left, right);
        if !same(&left.ty, &right.ty) {
            self.report_operator(operator, &left, &right, span);
            return broken_bool(span);
        }
        self.check_dimensions(operator.text(), &left, &right, span);
        let operator = if operator == BinaryOperator::Equal {
            Operator::Equal
        } else {
            Operator::NotEqual
        };
        joined(operator, left, right, Type::Bool, span)
    }

    /// `other == none` or `other != none`.
    pub fn is_none(
        &mut self,
        other: ast::Expression,
        operator: BinaryOperator,
        span: Span,
    ) -> Expression {
        let other = self.value(Some(other), None, "the optional");
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

    pub fn order(
        &mut self,
        node: &ast::BinaryExpression,
        operator: BinaryOperator,
        span: Span,
    ) -> Expression {
        let (left, right) = self.sides(node);
        if left.ty == Type::Error || right.ty == Type::Error {
            return broken_bool(span);
        }
        let (left, right) = alike(operator, left, right);
        if !same(&left.ty, &right.ty) || !self.program.is_ordered(&left.ty) {
            self.report_operator(operator, &left, &right, span);
            return broken_bool(span);
        }
        self.check_dimensions(operator.text(), &left, &right, span);
        let operator = match operator {
            BinaryOperator::Less => Operator::Less,
            BinaryOperator::LessEqual => Operator::LessEqual,
            BinaryOperator::Greater => Operator::Greater,
            _ => Operator::GreaterEqual,
        };
        joined(operator, left, right, Type::Bool, span)
    }

    pub fn contained(&mut self, node: &ast::BinaryExpression, span: Span) -> Expression {
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
                self.value(node.left(), hint.as_ref(), "the value before `in`"),
                collection,
            )
        } else {
            let item = self.value(node.left(), None, "the value before `in`");
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
            let message = "`in` does not apply to this";
            let problem = Diagnostic::new(Code::NotCollection, collection.span, message);
            let found = self.name_of(&collection.ty);
            let expected = "a list, a set, a map, a range or a text";
            let problem = problem.expected(expected).found(found);
            let between = Span::new(item.span.end, collection.span.start);
            let word = self
                .text(between)
                .find("in")
                .map(|at| between.start + at as u32);
            self.report(match word {
                Some(start)
                    if collection.ty == Type::Duration && self.body.place == Where::Property =>
                {
                    let word = Span::new(start, start + 2);
                    problem.replace("write `within` for a deadline", word, "within")
                }
                _ => problem,
            });
            return broken_bool(span);
        };
        let item = self.fit(item, &element, "the value before `in`");
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
}

/// The type expected of a bare name on the other side of a comparison.
pub(super) fn comparable(ty: &Type) -> Type {
    match ty {
        Type::Optional(inner) => (**inner).clone(),
        _ => ty.clone(),
    }
}

/// The side of a comparison whose other side is `none`.
pub(super) fn none_side(node: &ast::BinaryExpression) -> Option<ast::Expression> {
    let is_none = |side: &Option<ast::Expression>| matches!(side, Some(ast::Expression::Literal(literal)) if literal.value() == Literal::None);
    match (is_none(&node.left()), is_none(&node.right())) {
        (false, true) => node.left(),
        (true, false) => node.right(),
        _ => None,
    }
}

pub(super) fn element_type(collection: &Type) -> Option<Type> {
    Some(match collection {
        Type::List(element) | Type::Set(element) => (**element).clone(),
        Type::Map(key, _) => (**key).clone(),
        Type::Range => Type::Int,
        Type::String => Type::String,
        _ => return None,
    })
}

/// A comparison with an error, which is a Bool nevertheless.
pub(super) fn broken_bool(span: Span) -> Expression {
    made(ExpressionKind::Error, Type::Bool, span)
}
