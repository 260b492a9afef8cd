//! What statements do with enum variables: which values each gets, where that can be told.

use alloc::collections::{BTreeMap, BTreeSet};

use super::tables::Builtin;
use crate::ir::*;

/// What some statements do.
#[derive(Default)]
pub(super) struct Transitions {
    /// The values that enum variables get.
    pub given: BTreeMap<VariableId, Given>,
    /// They say that the program is at its end.
    pub ends: bool,
}

/// The values that a variable gets.
#[derive(Default)]
pub(super) struct Given {
    pub values: BTreeSet<u16>,
    /// It gets one that cannot be told.
    pub is_open: bool,
}

impl Transitions {
    pub fn of(statements: &[Statement], program: &Program) -> Self {
        let mut transitions = Self::default();
        transitions.collect(statements, program);
        transitions
    }

    fn collect(&mut self, statements: &[Statement], program: &Program) {
        for statement in statements {
            match &statement.kind {
                StatementKind::Assign { place, value } => {
                    if let (Root::Variable(id), Type::Enum(_)) = (&place.root, &value.ty)
                        && place.path.is_empty()
                    {
                        self.given.entry(*id).or_default().value(value);
                    }
                }
                StatementKind::ChangeRole { value } => {
                    if let Some(roles) = &program.roles {
                        self.given.entry(roles.variable).or_default().value(value);
                    }
                }
                StatementKind::If {
                    then, otherwise, ..
                } => {
                    self.collect(then, program);
                    self.collect(otherwise, program);
                }
                StatementKind::For { body, .. } | StatementKind::Atomic { body, .. } => {
                    self.collect(body, program);
                }
                StatementKind::Evaluate(Expression {
                    kind: ExpressionKind::Builtin { builtin, .. },
                    ..
                }) => {
                    self.ends |= matches!(builtin, Builtin::Finish | Builtin::Fail | Builtin::Stop);
                }
                _ => {}
            }
        }
    }
}

impl Given {
    /// The values that an expression may have.
    pub fn value(&mut self, value: &Expression) {
        match &value.kind {
            ExpressionKind::Variant(number) => {
                self.values.insert(*number);
            }
            ExpressionKind::Conditional {
                then, otherwise, ..
            } => {
                self.value(then);
                self.value(otherwise);
            }
            _ => self.is_open = true,
        }
    }
}
