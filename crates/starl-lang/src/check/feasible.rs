//! Whether a condition can hold, judged from the program's text and the value of one enum variable.

use alloc::collections::BTreeSet;

use crate::ir::{Expression, ExpressionKind, Operator, Type, VariableId};

/// An assumption: the value of an enum variable.
pub(crate) type Assumption = Option<(VariableId, u16)>;

/// Whether the condition holds; none if that depends on more than the assumption.
pub(crate) fn truth(condition: &Expression, assumed: Assumption) -> Option<bool> {
    match &condition.kind {
        ExpressionKind::Bool(value) => Some(*value),
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
            Operator::Equal => Some(variant(left, assumed)? == variant(right, assumed)?),
            Operator::NotEqual => Some(variant(left, assumed)? != variant(right, assumed)?),
            _ => None,
        },
        ExpressionKind::In { item, collection } => {
            let value = variant(item, assumed)?;
            let (ExpressionKind::List(elements) | ExpressionKind::Set(elements)) = &collection.kind
            else {
                return None;
            };
            let mut is_open = false;
            for element in elements {
                match variant(element, assumed) {
                    Some(other) if other == value => return Some(true),
                    Some(_) => {}
                    None => is_open = true,
                }
            }
            (!is_open).then_some(false)
        }
        _ => None,
    }
}

/// Which variant an expression of an enum is, if that can be determined.
fn variant(expression: &Expression, assumed: Assumption) -> Option<u16> {
    if !matches!(expression.ty, Type::Enum(_)) {
        return None;
    }
    match expression.kind {
        ExpressionKind::Variant(number) => Some(number),
        ExpressionKind::Variable(id) => assumed.filter(|(of, _)| *of == id).map(|(_, value)| value),
        _ => None,
    }
}

/// The enum variables that the condition compares with something.
pub(crate) fn enum_variables(condition: &Expression, found: &mut BTreeSet<VariableId>) {
    match &condition.kind {
        ExpressionKind::Variable(id) if matches!(condition.ty, Type::Enum(_)) => {
            found.insert(*id);
        }
        ExpressionKind::Not(inner) => enum_variables(inner, found),
        ExpressionKind::Binary { left, right, .. } => {
            enum_variables(left, found);
            enum_variables(right, found);
        }
        ExpressionKind::In { item, .. } => enum_variables(item, found),
        _ => {}
    }
}
