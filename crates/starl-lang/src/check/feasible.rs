//! Whether a condition can hold, judged from the program's text and the value of one variable: a Bool, or of an enum.

use alloc::collections::BTreeSet;

use crate::ir::{Expression, ExpressionKind, Operator, Type, VariableId};

/// An assumption: the value of a variable, as the number of an enum's variant, or 0 for false and 1 for true.
pub type Assumption = Option<(VariableId, u16)>;

/// Whether the condition holds; none if that depends on more than the assumption.
#[must_use]
pub fn truth(condition: &Expression, assumed: Assumption) -> Option<bool> {
    match &condition.kind {
        ExpressionKind::Bool(value) => Some(*value),
        ExpressionKind::Variable(id) => value_of(*id, assumed).map(|value| value == 1),
        ExpressionKind::Not(inner) => truth(inner, assumed).map(|value| !value),
        ExpressionKind::Binary {
            operator,
            left,
            right,
        } => match operator {
            Operator::And => match (truth(left, assumed), truth(right, assumed)) {
                (Some(false), _) | (_, Some(false)) => Some(false),
                (Some(true), Some(true)) => Some(true),
                _ => None,
            },
            Operator::Or => match (truth(left, assumed), truth(right, assumed)) {
                (Some(true), _) | (_, Some(true)) => Some(true),
                (Some(false), Some(false)) => Some(false),
                _ => None,
            },
            Operator::Equal => Some(value(left, assumed)? == value(right, assumed)?),
            Operator::NotEqual => Some(value(left, assumed)? != value(right, assumed)?),
            _ => None,
        },
        ExpressionKind::In { item, collection } => {
            let own = value(item, assumed)?;
            let (ExpressionKind::List(elements) | ExpressionKind::Set(elements)) = &collection.kind
            else {
                return None;
            };
            let mut is_open = false;
            for element in elements {
                match value(element, assumed) {
                    Some(other) if other == own => return Some(true),
                    Some(_) => {}
                    None => is_open = true,
                }
            }
            (!is_open).then_some(false)
        }
        _ => None,
    }
}

/// The value of an expression, if it can be determined.
fn value(expression: &Expression, assumed: Assumption) -> Option<u16> {
    match (&expression.ty, &expression.kind) {
        (Type::Enum(_), ExpressionKind::Variant(number)) => Some(*number),
        (Type::Enum(_), ExpressionKind::Variable(id)) => value_of(*id, assumed),
        (Type::Bool, _) => truth(expression, assumed).map(u16::from),
        _ => None,
    }
}

fn value_of(variable: VariableId, assumed: Assumption) -> Option<u16> {
    let (of, value) = assumed?;
    (of == variable).then_some(value)
}

/// The Bools and variables of enums by which the condition decides.
#[must_use]
pub fn finite_variables(condition: &Expression) -> BTreeSet<VariableId> {
    match &condition.kind {
        ExpressionKind::Variable(id) if condition.ty.is_finite() => BTreeSet::from([*id]),
        ExpressionKind::Not(inner) => finite_variables(inner),
        ExpressionKind::Binary { left, right, .. } => {
            &finite_variables(left) | &finite_variables(right)
        }
        ExpressionKind::In { item, .. } => finite_variables(item),
        _ => BTreeSet::new(),
    }
}
