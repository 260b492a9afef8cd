//! `if x != none` tests an optional but gives its value no name, so the value may still be none where it is used. The
//! fix `if some known = x` is offered at the exact place of the comparison.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use crate::diagnostic::{Edit, Fix, Span};
use crate::syntax::ast::{
    AssignStatement, AstNode, BinaryExpression, BinaryOperator, ConditionalExpression, Expression,
    IfBranch, PreClause, UnwrapExpression,
};
use crate::syntax::{SyntaxKind, SyntaxNode};

/// The suggested name of the value.
const NAME: &str = "known";

/// A comparison with `none` that guards a use of the same optional.
pub(super) struct Asked {
    /// The comparison.
    pub span: Span,
    /// Gives the value a name there, and uses it.
    pub fix: Fix,
}

/// The comparison that decides over the expression at `span`.
pub(super) fn before(root: &SyntaxNode, source: &str, span: Span) -> Option<Asked> {
    let text = span.of(source);
    let range = rowan::TextRange::new(span.start.into(), span.end.into());
    let place = match root.covering_element(range) {
        rowan::NodeOrToken::Node(node) => node,
        rowan::NodeOrToken::Token(token) => token.parent()?,
    };
    let (comparison, scope) = place.ancestors().find_map(|node| {
        let over = node.parent()?;
        let condition = deciding(&over, &node)?;
        Some((conjunct(&condition, text, source)?, over))
    })?;
    let name = unused(source)?;
    let scope = whole(scope);
    let mut uses = Vec::new();
    collect(&scope, text, source, comparison.end, &mut uses);
    if !uses.iter().any(|used| used.start == span.start) {
        return None;
    }
    let condition = format!("some {name} = {text}");
    let message = format!("name it in the condition: `{condition}`");
    let mut edits = Vec::from([Edit::new(comparison, condition)]);
    edits.extend(uses.into_iter().map(|used| Edit::new(used, &*name)));
    Some(Asked {
        span: comparison,
        fix: Fix { message, edits },
    })
}

/// The condition that `node`, a part of `over`, is only reached after.
fn deciding(over: &SyntaxNode, node: &SyntaxNode) -> Option<Expression> {
    if let Some(both) = BinaryExpression::cast(over.clone()) {
        let is_and = both.operator() == Some(BinaryOperator::And);
        let is_right = both.right().is_some_and(|right| right.syntax() == node);
        return both.left().filter(|_| is_and && is_right);
    }
    if let Some(either) = ConditionalExpression::cast(over.clone()) {
        let is_then = either.then().is_some_and(|then| then.syntax() == node);
        return either.condition().filter(|_| is_then);
    }
    match node.kind() {
        SyntaxKind::Block => IfBranch::cast(over.clone())?.condition(),
        SyntaxKind::EffClause => over.children().find_map(PreClause::cast)?.condition(),
        _ => None,
    }
}

/// The comparison of the expression with this text with none, where it must be true for the condition.
fn conjunct(condition: &Expression, text: &str, source: &str) -> Option<Span> {
    let Expression::Binary(binary) = condition else {
        return None;
    };
    let (left, right) = (binary.left()?, binary.right()?);
    match binary.operator()? {
        BinaryOperator::And => {
            conjunct(&left, text, source).or_else(|| conjunct(&right, text, source))
        }
        BinaryOperator::NotEqual => {
            let is_it = |side: &Expression| side.span().of(source) == text;
            let is_none = |side: &Expression| side.span().of(source) == "none";
            let asks = is_it(&left) && is_none(&right) || is_none(&left) && is_it(&right);
            asks.then(|| binary.span())
        }
        _ => None,
    }
}

/// Everything that the condition decides over which a node is a part of.
fn whole(node: SyntaxNode) -> SyntaxNode {
    let mut scope = node;
    while scope.kind() == SyntaxKind::BinaryExpression {
        let Some(over) = scope.parent() else { break };
        let is_and = BinaryExpression::cast(over.clone())
            .is_some_and(|both| both.operator() == Some(BinaryOperator::And));
        match over.kind() {
            _ if is_and => scope = over,
            SyntaxKind::IfBranch | SyntaxKind::ConditionalExpression => return over,
            SyntaxKind::PreClause => return over.parent().unwrap_or(over),
            _ => break,
        }
    }
    scope
}

/// Where the expression with this text is read after `from`.
fn collect(node: &SyntaxNode, text: &str, source: &str, from: u32, uses: &mut Vec<Span>) {
    for child in node.children() {
        let target = AssignStatement::cast(node.clone()).and_then(|node| node.target());
        if target.is_some_and(|target| *target.syntax() == child) {
            continue;
        }
        if let Some(expression) = Expression::cast(child.clone()) {
            let inner = UnwrapExpression::cast(child.clone()).and_then(|unwrap| unwrap.base());
            let span = expression.span();
            let is_it = [Some(&expression), inner.as_ref()].into_iter().flatten();
            let is_it = is_it.map(AstNode::span).any(|span| span.of(source) == text);
            if is_it && span.start >= from {
                uses.push(span);
                continue;
            }
        }
        collect(&child, text, source, from, uses);
    }
}

/// A name that nothing in the file has.
fn unused(source: &str) -> Option<String> {
    let others = (2..9).map(|number| format!("{NAME}{number}"));
    let mut names = core::iter::once(String::from(NAME)).chain(others);
    names.find(|name| !source.contains(name.as_str()))
}
