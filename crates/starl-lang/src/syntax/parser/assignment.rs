//! Assignments and calls: statements that begin with an expression.

use alloc::format;

use super::expression::{Shape, expression as value};
use super::{Code, Diagnostic, Parser, Span, SyntaxKind::*, slips, statement};

/// `x = e`, `x += e`, or a call.
pub(super) fn expression_or_assignment(parser: &mut Parser<'_>) {
    let start = parser.checkpoint();
    let before = parser.position;
    let span = parser.span();
    let shape = value(parser);
    if parser.position == before {
        return statement::nothing(parser);
    }
    let whole = Span::new(span.start, parser.end_of_last());
    match parser.current() {
        kind if kind.is_assignment() => {
            check_target(parser, shape, whole);
            assignment(parser, whole);
            parser.start_at(start, AssignStatement);
        }
        PlusPlus => {
            step(parser, whole, "+");
            parser.start_at(start, ExpressionStatement);
        }
        Minus => {
            step(parser, whole, "-");
            parser.start_at(start, ExpressionStatement);
        }
        _ => {
            check_effect(parser, shape, whole);
            parser.start_at(start, ExpressionStatement);
        }
    }
    parser.finish();
}

fn assignment(parser: &mut Parser<'_>, target: Span) {
    let (kind, span) = (parser.current(), parser.span());
    parser.bump();
    let from = parser.span().start;
    let shape = value(parser);
    if !matches!(kind, SlashEqual | PercentEqual) {
        return;
    }
    let operator = if kind == SlashEqual { "/" } else { "%" };
    let message = format!("there is no operator {}", kind.name());
    let problem = Diagnostic::new(Code::ForeignOperator, span, message);
    let target = target.of(parser.text);
    let operand = Span::new(from, parser.end_of_last().max(from));
    let brackets =
        matches!(shape, Shape::Other | Shape::Equality(_)) && operand.of(parser.text).contains(' ');
    let operand_text = operand.of(parser.text);
    let right = if brackets {
        format!("({operand_text})")
    } else {
        operand_text.into()
    };
    let fix = format!("= {target} {operator} {right}");
    let form = format!("write `{target} {fix}`");
    parser.report(problem.replace(form, span.to(operand), fix));
}

/// `x++` or `x--`.
fn step(parser: &mut Parser<'_>, target: Span, sign: &str) {
    let mut span = parser.span();
    parser.start(Error);
    parser.bump();
    if sign == "-" {
        span = span.to(parser.span());
        parser.bump();
    }
    parser.finish();
    let form = format!("write `{} {sign}= 1`", target.of(parser.text));
    let place = Span::new(target.end, span.end);
    let message = format!("there is no operator `{sign}{sign}`");
    slips::foreign_operator(parser, place, &message, (&form, &format!(" {sign}= 1")));
}

fn check_target(parser: &mut Parser<'_>, shape: Shape, span: Span) {
    if matches!(shape, Shape::Target | Shape::Broken) {
        return;
    }
    let problem = Diagnostic::new(Code::InvalidTarget, span, "this cannot be assigned to");
    parser.report(problem.expected("a variable, or a field or an element of one"));
}

fn check_effect(parser: &mut Parser<'_>, shape: Shape, span: Span) {
    match shape {
        Shape::Call | Shape::Broken => {}
        Shape::Equality(operator) => {
            let problem = Diagnostic::new(
                Code::ComparisonAsStatement,
                operator,
                "`==` compares, but a statement stands here",
            );
            parser.report(problem.replace("assign with `=`", operator, "="));
        }
        _ if !parser.at_line_end() => {}
        _ => {
            let problem = Diagnostic::new(Code::NoEffect, span, "this has no effect");
            parser.report(problem.expected("a statement, such as a call or an assignment"));
        }
    }
}
