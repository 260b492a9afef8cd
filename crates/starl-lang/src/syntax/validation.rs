//! Checks of the whole tree: the places of `some`, and problems that are consequences of others.

use alloc::vec::Vec;

use super::SyntaxKind::*;
use super::SyntaxNode;
use crate::diagnostic::{Code, Diagnostic, Span};

/// Adds the problems of the tree.
pub(super) fn validate(root: &SyntaxNode, diagnostics: &mut Vec<Diagnostic>) {
    for node in root
        .descendants()
        .filter(|node| node.kind() == SomeExpression)
    {
        if !decides(&node) {
            let problem = Diagnostic::new(
                Code::MisplacedSome,
                node.text_range().into(),
                "`some` cannot stand here",
            );
            let note = "it is allowed in the condition of `if`, `elif` or `pre`, alone or joined to others by `and`";
            diagnostics.push(problem.note(note));
        }
    }
}

/// Whether the node is a whole condition, or a part of one that must hold for it to hold.
fn decides(node: &SyntaxNode) -> bool {
    let Some(parent) = node.parent() else {
        return false;
    };
    match parent.kind() {
        IfBranch | PreClause | ComprehensionClause => true,
        ConditionalExpression => parent.first_child().as_ref() == Some(node),
        ParenthesizedExpression => decides(&parent),
        BinaryExpression => {
            let joins = parent
                .children_with_tokens()
                .any(|child| child.kind() == AndKeyword);
            joins && decides(&parent)
        }
        _ => false,
    }
}

/// Drops reports of unclosed brackets on a line that ends in an unterminated string: it contains the closing brackets.
pub(super) fn forget_swallowed(text: &str, diagnostics: &mut Vec<Diagnostic>) {
    let is_open = |problem: &&Diagnostic| {
        problem.code == Code::MalformedString && problem.span.of(text).starts_with('"')
    };
    let open = diagnostics.iter().filter(is_open);
    let strings: Vec<Span> = open.map(|problem| problem.span).collect();
    let is_swallowed = |open: Span| {
        strings.iter().any(|string| {
            open.end <= string.start && !Span::new(open.end, string.start).of(text).contains('\n')
        })
    };
    diagnostics.retain(|problem| {
        problem.code != Code::UnbalancedBracket
            || problem.span.of(text).starts_with([')', ']', '}'])
            || !is_swallowed(problem.span)
    });
}
