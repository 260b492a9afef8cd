//! Expressions: what each is, and of which type.

use alloc::boxed::Box;
use alloc::format;
use alloc::vec::Vec;

use super::body::Where;
use super::comparison::comparable;
use super::fit::{fits_float, same, whole};
use super::report::{broken, made};
use super::state::Checker;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{Expression, ExpressionKind, Type};
use crate::syntax::ast::{self, AstNode, Literal, PrefixOperator};

impl Checker {
    /// Checks an expression; `expected` is the type that would fit, where that is known. It need not
    /// be of that type: see [`Checker::expect`]. One that is missing was reported by the parser.
    pub fn infer(
        &mut self,
        expression: Option<ast::Expression>,
        expected: Option<&Type>,
    ) -> Expression {
        let Some(expression) = expression else {
            return broken(Span::empty(0));
        };
        let span = expression.span();
        // An error that was reported says nothing of what is expected, but that no value's type is unclear.
        let takes_its_type = matches!(
            expression,
            ast::Expression::Literal(_) | ast::Expression::List(_) | ast::Expression::Brace(_)
        );
        let expected = expected.filter(|ty| takes_its_type || !matches!(ty, Type::Error));
        let mark = (expression.is_closed_conjunction()).then(|| self.body.enter());
        let checked = self.infer_here(expression, span, expected);
        if let Some(mark) = mark {
            self.body.leave(mark);
        }
        checked
    }

    fn infer_here(
        &mut self,
        expression: ast::Expression,
        span: Span,
        expected: Option<&Type>,
    ) -> Expression {
        match expression {
            ast::Expression::Literal(node) => {
                let value = node.value();
                if let Literal::String(_) = value {
                    self.check_braces(&node, span);
                }
                self.literal(value, span, expected)
            }
            ast::Expression::Name(node) => self.name(&node.text(), span, expected),
            ast::Expression::Parenthesized(node) => self.infer(node.inner(), expected),
            ast::Expression::Tuple(node) => self.tuple(&node, span, expected),
            ast::Expression::Field(node) => self.member(&node, span),
            ast::Expression::Call(node) => self.call(&node, span),
            ast::Expression::Index(node) => self.index(&node, span),
            ast::Expression::Unwrap(node) => self.unwrap(&node, span, expected),
            ast::Expression::Prefix(node) => self.prefix(&node, span, expected),
            ast::Expression::Binary(node) => self.binary(&node, span, expected),
            ast::Expression::Some(node) => self.some(&node, span),
            ast::Expression::Conditional(node) => self.conditional(&node, span, expected),
            ast::Expression::Quantifier(node) => self.quantifier(&node, span),
            ast::Expression::List(node) => self.list(&node, span, expected),
            ast::Expression::Brace(node) => self.brace(&node, span, expected),
        }
    }

    /// Checks an expression that must have a value.
    pub fn value(
        &mut self,
        expression: Option<ast::Expression>,
        expected: Option<&Type>,
        role: &str,
    ) -> Expression {
        let value = self.infer(expression, expected);
        match value.ty {
            Type::Nothing => {
                let message = format!("{role} is a call that gives nothing");
                self.error(Code::WrongType, value.span, message);
                broken(value.span)
            }
            Type::Range => self.misplaced_range(value.span),
            _ => value,
        }
    }

    /// Checks an expression whose surroundings are broken, unless its type is that of its surroundings.
    pub fn infer_alone(&mut self, expression: Option<ast::Expression>) -> Expression {
        let can_be_checked =
            |value: &ast::Expression| !self.needs_hint(value) || self.holds_probe(value);
        self.infer(expression.filter(can_be_checked), None)
    }

    /// Whether the expression's type is that of its surroundings.
    pub fn needs_hint(&self, expression: &ast::Expression) -> bool {
        match expression {
            ast::Expression::Literal(node) => node.value() == Literal::None,
            ast::Expression::Name(node) => self.needs_context(&node.text()),
            ast::Expression::Parenthesized(node) => {
                node.inner().is_some_and(|inner| self.needs_hint(&inner))
            }
            ast::Expression::Tuple(node) => node.parts().any(|part| self.needs_hint(&part)),
            ast::Expression::List(node) => {
                node.comprehension().is_none()
                    && node.elements().all(|element| self.needs_hint(&element))
            }
            ast::Expression::Brace(node) => {
                node.comprehension().is_none()
                    && node.entries().next().is_none()
                    && node.elements().all(|element| self.needs_hint(&element))
            }
            _ => false,
        }
    }

    /// `(a, b)`
    fn tuple(
        &mut self,
        node: &ast::TupleExpression,
        span: Span,
        expected: Option<&Type>,
    ) -> Expression {
        let nodes: Vec<ast::Expression> = node.parts().collect();
        let hints = match expected.map(comparable) {
            Some(Type::Record(id)) if self.program[id].is_tuple() => {
                let fields = self.program[id].fields.iter();
                fields.map(|field| field.ty.clone()).collect()
            }
            _ => Vec::new(),
        };
        let fits = hints.len() == nodes.len();
        let mut parts = Vec::new();
        for (number, part) in nodes.into_iter().enumerate() {
            let part = Some(part);
            parts.push(match hints.get(number).filter(|_| fits) {
                Some(ty) => self.expect(part, ty, &format!("the part `.{number}`")),
                None => self.value(part, None, "a part of a tuple"),
            });
        }
        let types = parts.iter().map(|part| part.ty.clone()).collect();
        let ty = self.tuple_type(types, span);
        match ty {
            Type::Error => broken(span),
            _ => made(ExpressionKind::Record(parts), ty, span),
        }
    }

    fn literal(&mut self, literal: Literal, span: Span, expected: Option<&Type>) -> Expression {
        match literal {
            Literal::Int(value) => match i64::try_from(value) {
                Ok(value) => made(ExpressionKind::Int(value), Type::Int, span),
                // Only the least Int is written with such a number, after `-`; the parser says so.
                Err(_) => broken(span),
            },
            Literal::Float(value) => made(ExpressionKind::Float(value), Type::Float, span),
            Literal::Duration(value) => made(ExpressionKind::Duration(value), Type::Duration, span),
            Literal::String(value) => made(ExpressionKind::String(value), Type::String, span),
            Literal::Bool(value) => made(ExpressionKind::Bool(value), Type::Bool, span),
            Literal::None => self.none(span, expected),
            Literal::Malformed => broken(span),
        }
    }

    fn none(&mut self, span: Span, expected: Option<&Type>) -> Expression {
        match expected {
            Some(ty @ Type::Optional(_)) => made(ExpressionKind::None, ty.clone(), span),
            Some(Type::Error) => broken(span),
            Some(ty) => {
                let problem =
                    Diagnostic::new(Code::WrongType, span, "`none` is not a value of this type");
                let name = self.name_of(ty);
                let note = format!("only an optional, `{name}?`, may be none");
                self.refuse(problem.expected(name).found("none").note(note))
            }
            None => {
                let message = "the type of this `none` is unknown";
                let problem = Diagnostic::new(Code::UnclearType, span, message);
                self.refuse(problem.note("declare its type, as in `let x: Point? = none`"))
            }
        }
    }

    fn unwrap(
        &mut self,
        node: &ast::UnwrapExpression,
        span: Span,
        expected: Option<&Type>,
    ) -> Expression {
        let hint = expected.cloned().map(Type::optional);
        let base = self.value(node.base(), hint.as_ref(), "this");
        match base.ty.clone() {
            Type::Optional(inner) => made(ExpressionKind::Unwrap(Box::new(base)), *inner, span),
            Type::Error => broken(span),
            _ => {
                let mark = Span::new(base.span.end, span.end);
                let problem = Diagnostic::new(Code::NotOptional, mark, "`!` needs an optional");
                let problem = problem.found(self.name_of(&base.ty));
                self.report(problem.replace("remove `!`", mark, ""));
                base
            }
        }
    }

    fn prefix(
        &mut self,
        node: &ast::PrefixExpression,
        span: Span,
        expected: Option<&Type>,
    ) -> Expression {
        match node.operator() {
            Some(PrefixOperator::Not) => {
                let operand = self.expect(node.operand(), &Type::Bool, "what `not` turns round");
                made(ExpressionKind::Not(Box::new(operand)), Type::Bool, span)
            }
            Some(PrefixOperator::Negate) => self.negate(node, span, expected),
            None => broken(span),
        }
    }

    fn negate(
        &mut self,
        node: &ast::PrefixExpression,
        span: Span,
        expected: Option<&Type>,
    ) -> Expression {
        if let Some(ast::Expression::Literal(literal)) = node.operand()
            && let Literal::Int(value) = literal.value()
        {
            // The parser lets no more than 2^63 through, whose negative is the least Int.
            let value = 0_i64.wrapping_sub_unsigned(value);
            return made(ExpressionKind::Int(value), Type::Int, span);
        }
        // The operand of a negation is never none.
        let expected = expected.map(comparable);
        let operand = self.value(node.operand(), expected.as_ref(), "the operand");
        match operand.ty {
            Type::Int | Type::Point => {
                let ty = operand.ty.clone();
                made(ExpressionKind::Negate(Box::new(operand)), ty, span)
            }
            Type::Float => match operand.kind {
                ExpressionKind::Float(value) => {
                    made(ExpressionKind::Float(-value), Type::Float, span)
                }
                _ => made(ExpressionKind::Negate(Box::new(operand)), Type::Float, span),
            },
            Type::Error => broken(span),
            Type::Duration => {
                let message = "durations cannot be negative";
                self.error(Code::OperatorTypes, span, message);
                broken(span)
            }
            _ => {
                let message = format!("`-` does not apply to {}", self.name_of(&operand.ty));
                self.error(Code::OperatorTypes, span, message);
                broken(span)
            }
        }
    }

    fn conditional(
        &mut self,
        node: &ast::ConditionalExpression,
        span: Span,
        expected: Option<&Type>,
    ) -> Expression {
        let mark = self.body.enter();
        let condition = self.expect(node.condition(), &Type::Bool, "the condition");
        let then_first =
            expected.is_some() || !node.then().is_some_and(|then| self.needs_hint(&then));
        let (then, otherwise) = if then_first {
            let then = self.value(node.then(), expected, "the value");
            self.body.leave(mark);
            let hint = expected.cloned().unwrap_or_else(|| then.ty.clone());
            let otherwise = self.value(node.otherwise(), Some(&hint), "the value after `else`");
            (then, otherwise)
        } else {
            let names = self.body.names.split_off(mark);
            let otherwise = self.value(node.otherwise(), None, "the value after `else`");
            self.body.names.extend(names);
            let hint = otherwise.ty.clone();
            let then = self.value(node.then(), Some(&hint), "the value after `then`");
            self.body.leave(mark);
            (then, otherwise)
        };
        let is_float = match expected {
            Some(ty) => *ty == Type::Float,
            None => then.ty == Type::Float || otherwise.ty == Type::Float,
        };
        let (then, otherwise) = match is_float && fits_float(&then) && fits_float(&otherwise) {
            true => (whole(then), whole(otherwise)),
            false => (then, otherwise),
        };
        let ty = match expected {
            Some(ty) if same(&then.ty, ty) || same(&Type::optional(then.ty.clone()), ty) => {
                ty.clone()
            }
            // One may be none, so both may.
            _ if matches!(&otherwise.ty, Type::Optional(inner) if same(inner, &then.ty)) => {
                otherwise.ty.clone()
            }
            _ if then.ty == Type::Error => otherwise.ty.clone(),
            _ => then.ty.clone(),
        };
        let then = self.fit(then, &ty, "the value after `then`");
        let otherwise = self.fit(otherwise, &ty, "the value after `else`");
        self.check_dimensions("else", &then, &otherwise, span);
        let kind = ExpressionKind::Conditional {
            condition: Box::new(condition),
            then: Box::new(then),
            otherwise: Box::new(otherwise),
        };
        made(kind, ty, span)
    }

    fn quantifier(&mut self, node: &ast::QuantifierExpression, span: Span) -> Expression {
        if let Some(variables) = node.loop_variables() {
            return self.quantifier_over(node, &variables, span);
        }
        if self.body.place != Where::Property {
            let word = if node.is_universal() {
                "forall"
            } else {
                "exists"
            };
            let message = format!("`{word}` cannot stand here");
            let problem = Diagnostic::new(Code::MisplacedQuantifier, span, message);
            let note = format!(
                "in properties it is about all robots; here name a collection, as in `{word} r in peers: ...`"
            );
            return self.refuse(problem.note(note));
        }
        let mark = self.body.enter();
        let robots = (node.variables())
            .filter_map(|name| self.declare_local(&name, Type::Robot, None))
            .collect();
        let robot = self.body.robot;
        // A value is one robot's also where it asks about all.
        self.body.robot = robot.filter(|_| self.value.is_some());
        let condition = self.expect(node.condition(), &Type::Bool, "the condition");
        self.body.robot = robot;
        self.body.leave(mark);
        let kind = ExpressionKind::Quantifier {
            is_universal: node.is_universal(),
            robots,
            condition: Box::new(condition),
        };
        made(kind, Type::Bool, span)
    }

    fn quantifier_over(
        &mut self,
        node: &ast::QuantifierExpression,
        variables: &ast::LoopVariables,
        span: Span,
    ) -> Expression {
        let mark = self.body.enter();
        let collection = self.infer(node.collection(), None);
        let variables = self.loop_variables(variables.patterns(), &collection);
        let condition = self.expect(node.condition(), &Type::Bool, "the condition");
        self.body.leave(mark);
        let kind = ExpressionKind::Over {
            is_universal: node.is_universal(),
            variables,
            collection: Box::new(collection),
            condition: Box::new(condition),
        };
        made(kind, Type::Bool, span)
    }
}
