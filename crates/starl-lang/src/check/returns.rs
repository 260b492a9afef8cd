//! Whether execution can reach the end of statements.

use crate::ir::{Statement, StatementKind};

/// Whether every way through the statements returns.
pub(super) fn always_returns(statements: &[Statement]) -> bool {
    statements.iter().any(|statement| match &statement.kind {
        StatementKind::Return(_) => true,
        StatementKind::If {
            then, otherwise, ..
        } => always_returns(then) && always_returns(otherwise),
        StatementKind::Atomic { body, .. } => always_returns(body),
        _ => false,
    })
}
