//! Operators between two values.

use alloc::boxed::Box;
use alloc::format;

use super::comparison::comparable;
use super::report::{broken, joined, made};
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
                let left = self.infer(node.left(), Some(&Type::Bool));
                if let Type::Optional(inner) = &left.ty
                    && operator == BinaryOperator::Or
                    && **inner != Type::Bool
                {
                    return self.or_default(node, &left, &(**inner).clone(), span);
                }
                let left = self.fit(left, &Type::Bool, &role);
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
                // Arithmetic never gives none, nor does it take one.
                let expected = expected.map(comparable);
                let left = node.left();
                let left = self.value(left, expected.as_ref(), "the left operand");
                let hint = left.ty.clone();
                let right = self.value(node.right(), Some(&hint), "the right operand");
                self.arithmetic(operator, left, right, span)
            }
        }
    }

    /// Reports `optional or default`.
    fn or_default(
        &mut self,
        node: &ast::BinaryExpression,
        left: &Expression,
        inner: &Type,
        span: Span,
    ) -> Expression {
        let right = self.infer(node.right(), Some(inner));
        let message = "`or` joins conditions, and this is an optional";
        let problem = Diagnostic::new(Code::WrongType, left.span, message);
        let between = Span::new(left.span.end, right.span.start);
        let problem = match self.text(between).find("or") {
            Some(at) => {
                let start = between.start + at as u32;
                let word = Span::new(start, start + 2);
                problem.replace("write `??` for a default", word, "??")
            }
            None => problem,
        };
        self.report(problem);
        broken(span)
    }

    fn default(
        &mut self,
        node: &ast::BinaryExpression,
        span: Span,
        expected: Option<&Type>,
    ) -> Expression {
        let hint = expected.cloned().map(Type::optional);
        let optional = self.value(node.left(), hint.as_ref(), "the optional");
        let inner = match &optional.ty {
            Type::Optional(inner) => (**inner).clone(),
            Type::Error => {
                self.infer(node.right(), expected);
                return broken(span);
            }
            ty => {
                let message = "`??` needs an optional before it, and this always has a value";
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
        let default = self.value(node.right(), Some(&hint), "the default");
        let ty = if matches!(default.ty, Type::Optional(_)) {
            optional.ty.clone()
        } else {
            inner
        };
        let default = self.fit(default, &ty, "the default");
        self.check_dimensions("??", &optional, &default, span);
        let kind = ExpressionKind::Default {
            optional: Box::new(optional),
            default: Box::new(default),
        };
        made(kind, ty, span)
    }
}
