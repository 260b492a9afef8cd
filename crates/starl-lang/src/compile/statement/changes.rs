//! Whether statements may change a variable.

use crate::ir::{Expression, ExpressionKind, LocalId, Place, Root, Statement, StatementKind};

/// Whether the statements may change the variable that the expression names or is a part of. A computed value never
/// changes.
pub(in crate::compile) fn may_change(statements: &[Statement], expression: &Expression) -> bool {
    match root(expression) {
        Some(variable) => statements
            .iter()
            .any(|statement| changes(statement, variable)),
        None => false,
    }
}

/// A variable that a collection may be a part of.
#[derive(Clone, Copy)]
enum Variable {
    Local(LocalId),
    /// Any of the state: entering a role may change many.
    State,
}

fn root(expression: &Expression) -> Option<Variable> {
    match &expression.kind {
        ExpressionKind::Local(local) => Some(Variable::Local(*local)),
        ExpressionKind::Variable(_) => Some(Variable::State),
        ExpressionKind::Field { base, .. }
        | ExpressionKind::Coordinate { base, .. }
        | ExpressionKind::Unwrap(base) => root(base),
        ExpressionKind::Range { start, end } => root(end).or_else(|| root(start)),
        _ => None,
    }
}

fn changes(statement: &Statement, variable: Variable) -> bool {
    let any = |statements: &[Statement]| {
        (statements.iter()).any(|statement| changes(statement, variable))
    };
    match &statement.kind {
        StatementKind::Assign { place, .. } | StatementKind::Update { place, .. } => {
            is_in(place, variable)
        }
        StatementKind::ChangeRole { .. } => matches!(variable, Variable::State),
        StatementKind::If {
            then, otherwise, ..
        } => any(then) || any(otherwise),
        StatementKind::For { body, .. } | StatementKind::Atomic { body, .. } => any(body),
        StatementKind::Evaluate(expression) => match &expression.kind {
            ExpressionKind::Change { place, .. } => is_in(place, variable),
            _ => false,
        },
        StatementKind::Let { .. } | StatementKind::Return(_) => false,
    }
}

fn is_in(place: &Place, variable: Variable) -> bool {
    match (&place.root, variable) {
        (Root::Local(local), Variable::Local(other)) => *local == other,
        (Root::Variable(_), Variable::State) => true,
        _ => false,
    }
}
