//! The values that a parameter may have.

use super::bytecode::{Range, Variable};
use super::types::Type;
use super::value::tree::Value;
use alloc::format;
use alloc::string::String;
use starl_core::Duration;

impl Variable {
    /// Whether a value of its type is one that it may have.
    #[must_use]
    pub fn accepts(&self, value: &Value) -> bool {
        self.range.is_none_or(|range| range.contains(value))
    }

    /// Its range as text; none if there is no range.
    #[must_use]
    pub fn range_text(&self) -> Option<String> {
        let Range { from, before } = self.range?;
        Some(match self.kind {
            Type::Float => format!(
                "from {} to below {}",
                f64::from_bits(from),
                f64::from_bits(before)
            ),
            Type::Duration => format!("from {} to below {}", Duration(from), Duration(before)),
            _ => format!(
                "from {} to {}",
                from as i64,
                (before as i64).saturating_sub(1)
            ),
        })
    }
}

impl Range {
    /// Whether the value lies in it; false for values that have no order.
    #[must_use]
    pub fn contains(&self, value: &Value) -> bool {
        let Range { from, before } = *self;
        match *value {
            Value::Int(number) => (from as i64..before as i64).contains(&number),
            Value::Float(number) => {
                (f64::from_bits(from)..f64::from_bits(before)).contains(&number)
            }
            Value::Duration(span) => (from..before).contains(&span.0),
            _ => false,
        }
    }
}
