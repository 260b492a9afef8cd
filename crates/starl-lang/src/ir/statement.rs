//! Statements.

use alloc::vec::Vec;

use super::{Expression, LocalId, Operator, SharedId, VariableId};
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

/// The variables that a loop or a comprehension binds for each element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoopVariables {
    /// An element of a list, set or range, or a key of a map; none for `_`.
    One(Option<LocalId>),
    /// Key and value of a map; none for `_`.
    Two(Option<LocalId>, Option<LocalId>),
}

/// Something that can be written.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The variable.
    pub root: Root,
    /// The way from the variable to its part.
    pub path: Vec<Step>,
    /// The type of the written value.
    pub ty: super::Type,
    /// Where it is.
    pub span: Span,
}

/// The variable that is written, or a part of it.
#[derive(Clone, Debug, PartialEq)]
pub enum Root {
    /// An error: the target is not a variable.
    Error,
    /// A local variable.
    Local(LocalId),
    /// A state variable.
    Variable(VariableId),
    /// This robot's element of a single-writer variable; always written whole.
    OwnElement(SharedId),
    /// A multi-writer variable. It is read, changed and written whole if there is a path, which there
    /// is only if it has an initial value.
    Shared(SharedId),
}

/// A step from a value to a part of it.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// The field of a record with this number.
    Field(u32),
    /// A coordinate of a point: 0 for x, 1 for y, 2 for z.
    Coordinate(u8),
    /// An element of a list; outside of the list it is a run-time error.
    Index(Expression),
    /// The value of a key of a map. As the last step it may be new: an update by `+` or `-` and a method that adds
    /// ([`Method::adds`](crate::check::Method::adds)) then start from the default value of the type. Otherwise, and
    /// before the last step, a missing key is a run-time error.
    Key(Expression),
}
