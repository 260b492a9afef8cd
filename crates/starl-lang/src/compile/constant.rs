//! Scalars that are known before the program runs.

use core::f64::consts::PI;

use crate::check::Builtin;
use crate::ir::{self, Expression, ExpressionKind, Operator};

/// The value of an expression if it is a scalar, where these constants are known. Expressions that would fail are left to run time.
pub(super) fn folded(known: &[Option<u64>], expression: &Expression) -> Option<u64> {
    match &expression.kind {
        ExpressionKind::Bool(value) => Some(u64::from(*value)),
        ExpressionKind::Int(value) => Some(*value as u64),
        ExpressionKind::Float(value) => float(*value),
        ExpressionKind::Duration(value) => i64::try_from(*value).ok().map(|_| *value),
        ExpressionKind::Variant(number) => Some(u64::from(*number)),
        ExpressionKind::Constant(id) => known[id.index()],
        ExpressionKind::Negate(value) => {
            let bits = folded(known, value)?;
            match value.ty {
                ir::Type::Int => (bits as i64).checked_neg().map(|value| value as u64),
                ir::Type::Float => float(-f64::from_bits(bits)),
                _ => None,
            }
        }
        ExpressionKind::Builtin {
            builtin: Builtin::Pi,
            ..
        } => float(PI),
        ExpressionKind::Builtin {
            builtin: Builtin::ToFloat,
            arguments,
            ..
        } => {
            let number = folded(known, arguments.first()?.as_ref()?)?;
            float(number as i64 as f64)
        }
        ExpressionKind::Binary {
            operator,
            left,
            right,
        } => match (&left.ty, &right.ty) {
            (ir::Type::Int, ir::Type::Int) => {
                let (left, right) = (folded(known, left)? as i64, folded(known, right)? as i64);
                let result = match operator {
                    Operator::Add => left.checked_add(right),
                    Operator::Subtract => left.checked_sub(right),
                    Operator::Multiply => left.checked_mul(right),
                    _ => None,
                };
                result.map(|value| value as u64)
            }
            (ir::Type::Float, ir::Type::Float) => {
                let (left, right) = (folded(known, left)?, folded(known, right)?);
                let (left, right) = (f64::from_bits(left), f64::from_bits(right));
                match operator {
                    Operator::Add => float(left + right),
                    Operator::Subtract => float(left - right),
                    Operator::Multiply => float(left * right),
                    Operator::Divide => float(left / right),
                    _ => None,
                }
            }
            _ => None,
        },
        _ => None,
    }
}

/// The bits of a Float. NaN has many representations, so it is left to the machine.
fn float(value: f64) -> Option<u64> {
    (!value.is_nan()).then(|| value.to_bits())
}
