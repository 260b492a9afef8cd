//! Assignments and calls: statements that begin with an expression.

use alloc::format;

use super::expression::Shape;
use super::{Code, Diagnostic, Parser, Span, SyntaxKind::*};

impl Parser<'_> {
    /// `x = e`, `x += e`, or a call.
    pub(super) fn expression_or_assignment(&mut self) {
        let start = self.checkpoint();
        let before = self.position;
        let span = self.span();
        let shape = self.expression().shape;
        if self.position == before {
            return self.nothing();
        }
        let whole = Span::new(span.start, self.end_of_last());
        match self.current() {
            kind if kind.is_assignment() => {
                self.check_target(shape, whole);
                self.assignment(whole);
                self.start_at(start, AssignStatement);
            }
            PlusPlus => {
                self.step(whole, "+");
                self.start_at(start, ExpressionStatement);
            }
            Minus => {
                self.step(whole, "-");
                self.start_at(start, ExpressionStatement);
            }
            _ => {
                self.check_effect(shape, whole);
                self.start_at(start, ExpressionStatement);
            }
        }
        self.finish();
    }

    fn assignment(&mut self, target: Span) {
        let (kind, span) = (self.current(), self.span());
        self.bump();
        let from = self.span().start;
        let shape = self.expression().shape;
        if !matches!(kind, SlashEqual | PercentEqual) {
            return;
        }
        let operator = if kind == SlashEqual { "/" } else { "%" };
        let message = format!("there is no operator {}", kind.name());
        let problem = Diagnostic::new(Code::ForeignOperator, span, message);
        let target = target.of(self.text);
        let operand = Span::new(from, self.end_of_last().max(from));
        let brackets = matches!(shape, Shape::Other | Shape::Equality(_))
            && operand.of(self.text).contains(' ');
        let operand_text = operand.of(self.text);
        let right = if brackets {
            format!("({operand_text})")
        } else {
            operand_text.into()
        };
        let fix = format!("= {target} {operator} {right}");
        let form = format!("write `{target} {fix}`");
        self.report(problem.replace(form, span.to(operand), fix));
    }

    /// `x++` or `x--`.
    fn step(&mut self, target: Span, sign: &str) {
        let mut span = self.span();
        self.start(Error);
        self.bump();
        if sign == "-" {
            span = span.to(self.span());
            self.bump();
        }
        self.finish();
        let form = format!("write `{} {sign}= 1`", target.of(self.text));
        let place = Span::new(target.end, span.end);
        let message = format!("there is no operator `{sign}{sign}`");
        let problem = Diagnostic::new(Code::ForeignOperator, place, message);
        self.report(problem.replace(form, place, format!(" {sign}= 1")));
    }

    fn check_target(&mut self, shape: Shape, span: Span) {
        if matches!(shape, Shape::Target | Shape::Broken) {
            return;
        }
        let problem = Diagnostic::new(Code::InvalidTarget, span, "this cannot be assigned to");
        self.report(problem.expected("a variable, or a field or an element of one"));
    }

    fn check_effect(&mut self, shape: Shape, span: Span) {
        match shape {
            Shape::Call | Shape::Broken => {}
            Shape::Equality(operator) => {
                let message = "`==` compares, but a statement stands here";
                let problem = Diagnostic::new(Code::ComparisonAsStatement, operator, message);
                self.report(problem.replace("assign with `=`", operator, "="));
            }
            _ if !self.at_line_end() => {}
            _ => {
                let problem = Diagnostic::new(Code::NoEffect, span, "this has no effect");
                self.report(problem.expected("a statement, such as a call or an assignment"));
            }
        }
    }
}
