//! The keywords allowed at a position, and the checker's knowledge of it.

use starl_lang::check::{Purity, Reach, Surroundings};
use starl_lang::syntax::{SyntaxKind, SyntaxNode, SyntaxToken};

/// Where a word is typed.
#[derive(Clone, Debug)]
pub(super) enum Context {
    /// The name of a library.
    Import,
    /// A declaration begins.
    Declaration,
    /// A part of an action begins, or a declaration.
    Clause,
    /// A value, perhaps as the beginning of a statement; or what else the checker knows.
    Known {
        surroundings: Surroundings,
        begins_statement: bool,
    },
}

/// The context of the probe; none where a new name is made.
pub(super) fn of(probe: &SyntaxToken, found: Option<Surroundings>) -> Option<Context> {
    let parent = probe.parent()?;
    let begins_line = begins_line(probe);
    let within = |kind| parent.ancestors().any(|node| node.kind() == kind);
    let begins_statement = begins_statement(probe);
    if let Some(surroundings) = found {
        // A line in an action's body without a clause keyword is read as a statement.
        let in_clause = parent.ancestors().any(|node| is_begun_clause(&node));
        if begins_line && within(SyntaxKind::ActionBody) && !in_clause {
            return Some(Context::Clause);
        }
        return Some(Context::Known {
            surroundings,
            begins_statement,
        });
    }
    match parent.kind() {
        SyntaxKind::Name => match parent.parent()?.kind() {
            SyntaxKind::Import => return Some(Context::Import),
            // A name before anything else of its declaration may become any declaration.
            _ if begins_line && !within(SyntaxKind::Block) => {}
            _ => return None,
        },
        SyntaxKind::Import => return Some(Context::Import),
        _ => {}
    }
    if within(SyntaxKind::BindingDeclaration) && !begins_line {
        return Some(Context::Known {
            surroundings: Surroundings::Primitive,
            begins_statement: false,
        });
    }
    if begins_line && !within(SyntaxKind::Block) {
        let in_action = within(SyntaxKind::ActionBody) || follows_action(probe);
        return Some(if in_action {
            Context::Clause
        } else {
            Context::Declaration
        });
    }
    Some(Context::Known {
        surroundings: anything(),
        begins_statement,
    })
}

/// Whether it is a clause of an action that begins with its word.
fn is_begun_clause(node: &SyntaxNode) -> bool {
    let first = || node.first_token().map(|token| token.kind());
    match node.kind() {
        SyntaxKind::PreClause => true,
        SyntaxKind::EffClause => first() == Some(SyntaxKind::EffKeyword),
        _ => false,
    }
}

/// Whether the token is the first of a statement in a block.
fn begins_statement(token: &SyntaxToken) -> bool {
    let mut before = token.prev_token();
    while let Some(found) = before {
        let kind = found.kind();
        if kind.is_trivia() || matches!(kind, SyntaxKind::Indent | SyntaxKind::Dedent) {
            if kind == SyntaxKind::LineBreak {
                break;
            }
            before = found.prev_token();
            continue;
        }
        return matches!(
            kind,
            SyntaxKind::Newline
                | SyntaxKind::Semicolon
                | SyntaxKind::EffKeyword
                | SyntaxKind::ThenKeyword
                | SyntaxKind::ElseKeyword
        );
    }
    true
}

/// Whether the line, indented, comes right after the head of an action.
fn follows_action(probe: &SyntaxToken) -> bool {
    let Some(before) = probe.prev_token() else {
        return false;
    };
    if before.kind() != SyntaxKind::Whitespace {
        return false;
    }
    let mut last = before.prev_token();
    while let Some(found) = last {
        let is_space = found.kind().is_trivia()
            || matches!(
                found.kind(),
                SyntaxKind::Newline | SyntaxKind::Indent | SyntaxKind::Dedent
            );
        if !is_space {
            let mut nodes = found.parent_ancestors();
            return nodes.any(|node| node.kind() == SyntaxKind::ActionDeclaration);
        }
        last = found.prev_token();
    }
    false
}

/// Whether only white space stands before the token in its line.
fn begins_line(token: &SyntaxToken) -> bool {
    let mut before = token.prev_token();
    while let Some(found) = before {
        match found.kind() {
            SyntaxKind::Newline | SyntaxKind::LineBreak => return true,
            SyntaxKind::Whitespace | SyntaxKind::Indent | SyntaxKind::Dedent => {}
            _ => return found.text().ends_with('\n'),
        }
        before = found.prev_token();
    }
    true
}

/// The context if the checker did not reach the probe: some value.
fn anything() -> Surroundings {
    Surroundings::Value(Reach {
        locals: Vec::new(),
        expected: None,
        purity: Purity::Effect,
        sees_state: true,
        sees_parameters: true,
        sees_primitives: true,
        in_property: false,
        parameters: Vec::new(),
    })
}
