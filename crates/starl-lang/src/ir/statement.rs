//! Statements.

use alloc::vec::Vec;

use super::{Expression, LocalId, LoopVariables, Operator, Place, SharedId};
use crate::diagnostic::Span;

/// A statement.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// Its kind, with its parts.
    pub kind: StatementKind,
    /// Where it is, in the file of the declaration that it belongs to.
    pub span: Span,
}

/// The kind of a statement.
#[derive(Clone, Debug, PartialEq)]
pub enum StatementKind {
    /// `let x = value`
    Let {
        /// The new local.
        local: LocalId,
        /// Its value, of the local's type.
        value: Expression,
    },
    /// `x = value`. The places' indices are evaluated first, from left to right, then the value.
    Assign {
        /// The assigned place.
        place: Place,
        /// The value, of the place's type.
        value: Expression,
    },
    /// `x += value`: the place's indices are evaluated once.
    Update {
        /// The changed place.
        place: Place,
        /// `+`, `-` or `*`, with the place's value on the left and the place's type as result.
        operator: Operator,
        /// The value on the right.
        value: Expression,
    },
    /// `role = value`: the variable `role` is set, and if it had another value the entry of the new
    /// role runs, before the next statement.
    ChangeRole {
        /// The new role.
        value: Expression,
    },
    /// `if condition`
    If {
        /// The condition.
        condition: Expression,
        /// The statements if it holds.
        then: Vec<Statement>,
        /// The statements if it does not hold.
        otherwise: Vec<Statement>,
    },
    /// `for x in collection`. The collection is evaluated once; changes of the variable that it came
    /// from do not matter.
    For {
        /// The loop variables.
        variables: LoopVariables,
        /// A list, set, map or range.
        collection: Expression,
        /// The statements for each element, in order.
        body: Vec<Statement>,
    },
    /// `return value`; without a value outside of functions.
    Return(Option<Expression>),
    /// A call whose result is dropped.
    Evaluate(Expression),
    /// `atomic`: the statements run while this robot alone writes the shared variables.
    Atomic {
        /// The shared variables that are touched, in the order of their numbers; not those that
        /// functions touch, since functions touch none.
        shared: Vec<SharedId>,
        /// The statements.
        body: Vec<Statement>,
    },
}
