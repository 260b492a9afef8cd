//! Conditions: jumps that depend on Bools, without making the Bool where that can be helped.

mod binding;
mod equality;
mod order;
mod quantifier;

use crate::compile::body::{Body, Location, Slot};
use crate::compile::code::Label;
use crate::compile::constant::folded;
use crate::compile::expression::is_located;
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::{Expression, ExpressionKind, Operator, Type};
use crate::machine::Instruction;
use crate::machine::operand::{Short, ShortSlot};

/// The operand for a scalar of the state in a jump, if there is one.
pub(in crate::compile) fn short_slot(location: Location) -> Option<ShortSlot> {
    match location {
        Location::State(start) => u8::try_from(start.scalars).ok().map(ShortSlot),
        _ => None,
    }
}

impl<'p> Body<'_, 'p> {
    /// Goes to the label if the condition is `when`. Locals that it binds keep their registers; all
    /// else is released.
    pub fn branch(&mut self, condition: &'p Expression, when: bool, label: Label) -> Compiled {
        let outer = core::mem::replace(&mut self.span, condition.span);
        self.branch_here(condition, when, label)?;
        self.span = outer;
        Ok(())
    }

    fn branch_here(&mut self, condition: &'p Expression, when: bool, label: Label) -> Compiled {
        if let Some(bits) = folded(&self.unit.known, condition) {
            if (bits != 0) == when {
                self.jump(label);
            }
            return Ok(());
        }
        match &condition.kind {
            ExpressionKind::Not(inner) => return self.branch(inner, !when, label),
            ExpressionKind::Binary {
                operator: operator @ (Operator::And | Operator::Or),
                left,
                right,
            } => {
                let decides = *operator == Operator::Or;
                return self.branch_both(decides, [left, right], when, label);
            }
            ExpressionKind::Bind { local, value } => {
                return self.branch_bind(*local, value, when, label);
            }
            _ => {}
        }
        let mark = self.mark();
        match &condition.kind {
            ExpressionKind::Binary {
                operator: operator @ (Operator::Equal | Operator::NotEqual),
                left,
                right,
            } => {
                let when_equal = (*operator == Operator::Equal) == when;
                self.branch_equal([left, right], when_equal, label)?;
            }
            ExpressionKind::Binary {
                operator,
                left,
                right,
            } => self.branch_order(*operator, [left, right], when, label)?,
            ExpressionKind::IsNone(optional) => self.branch_flag(optional, !when, label)?,
            ExpressionKind::In { item, collection } if collection.ty == Type::Range => {
                self.branch_range(item, collection, when, label)?;
            }
            ExpressionKind::Conditional {
                condition,
                then,
                otherwise,
            } => {
                let (no, end) = (self.label(), self.label());
                self.branch(condition, false, no)?;
                self.branch(then, when, label)?;
                self.jump(end);
                self.place(no);
                self.branch(otherwise, when, label)?;
                self.place(end);
            }
            ExpressionKind::Quantifier {
                is_universal,
                robots,
                condition,
            } => self.branch_quantifier(*is_universal, robots, condition, when, label)?,
            ExpressionKind::Over {
                is_universal,
                variables,
                collection,
                condition,
            } => {
                let (is_universal, variables) = (*is_universal, *variables);
                self.branch_decided(is_universal, when, label, |body, decided| {
                    body.for_each(collection, variables, false, |body| {
                        body.branch(condition, !is_universal, decided)
                    })
                })?;
            }
            _ => self.branch_flag(condition, when, label)?,
        }
        self.release(mark);
        Ok(())
    }

    /// `and` or `or`, of which `decides` is what one side must be to decide.
    fn branch_both(
        &mut self,
        decides: bool,
        [left, right]: [&'p Expression; 2],
        when: bool,
        label: Label,
    ) -> Compiled {
        if when == decides {
            self.branch(left, when, label)?;
            return self.branch(right, when, label);
        }
        let end = self.label();
        self.branch(left, decides, end)?;
        self.branch(right, when, label)?;
        self.place(end);
        Ok(())
    }

    /// Goes to the label if the first scalar of a value, a Bool, is `when`.
    fn branch_flag(&mut self, value: &'p Expression, when: bool, label: Label) -> Compiled {
        if is_located(value)
            && let Some(location) = self.locate(value)?
        {
            return self.branch_location(location, when, label);
        }
        let slot = self.value(value)?;
        self.jump_on(slot, when, label);
        Ok(())
    }

    /// The same of a value that is at a location.
    fn branch_location(&mut self, location: Location, when: bool, label: Label) -> Compiled {
        if let Some(variable) = short_slot(location) {
            self.emit(Instruction::JumpIfStateNot {
                right: Short(i16::from(!when)),
                target: label.target(),
                variable,
            });
            return Ok(());
        }
        let slot = self.scalar_at(location)?;
        self.jump_on(slot, when, label);
        Ok(())
    }

    /// Goes to the label if a Bool in a register is `when`.
    pub fn jump_on(&mut self, condition: Slot, when: bool, label: Label) {
        let (condition, target) = (condition.input(), label.target());
        self.emit(match when {
            true => Instruction::JumpIf { condition, target },
            false => Instruction::JumpUnless { condition, target },
        });
    }

    /// `item in start..end`
    fn branch_range(
        &mut self,
        item: &'p Expression,
        range: &'p Expression,
        when: bool,
        label: Label,
    ) -> Compiled {
        let ExpressionKind::Range { start, end } = &range.kind else {
            return Err(self.broken());
        };
        let item = self.value(item)?;
        let start = self.value(start)?;
        let end = self.value(end)?;
        let outside = match when {
            true => self.label(),
            false => label,
        };
        self.emit(Instruction::JumpIfLess {
            left: item.input(),
            right: start.input(),
            target: outside.target(),
        });
        if when {
            self.emit(Instruction::JumpIfLess {
                left: item.input(),
                right: end.input(),
                target: label.target(),
            });
            self.place(outside);
        } else {
            self.emit(Instruction::JumpIfLessEqual {
                left: end.input(),
                right: item.input(),
                target: label.target(),
            });
        }
        Ok(())
    }

    /// A Bool as a value.
    pub fn truth(&mut self, expression: &'p Expression, to: Slot) -> Compiled {
        match &expression.kind {
            ExpressionKind::Not(inner) if self.is_direct(inner) => {
                self.into(inner, to, false)?;
                self.emit(Instruction::Not {
                    to: to.output(),
                    from: to.input(),
                });
                return Ok(());
            }
            ExpressionKind::Binary {
                operator,
                left,
                right,
            } if self.is_direct(expression) => {
                return self.compare(*operator, [left, right], to);
            }
            ExpressionKind::In { item, collection } if self.is_direct(expression) => {
                return self.contained(item, collection, to);
            }
            _ => {}
        }
        let (no, end) = (self.label(), self.label());
        self.branch(expression, false, no)?;
        self.scalar(to, 1);
        self.jump(end);
        self.place(no);
        self.scalar(to, 0);
        self.place(end);
        Ok(())
    }

    /// Whether there are instructions that make the Bool, rather than jumps.
    fn is_direct(&self, expression: &Expression) -> bool {
        match &expression.kind {
            ExpressionKind::Binary { operator, left, .. } => match operator {
                Operator::And | Operator::Or => false,
                Operator::Equal | Operator::NotEqual => {
                    let size = self.size(&left.ty);
                    left.ty == Type::Point || size == Size::SCALAR || size == Size::OBJECT
                }
                _ => !matches!(left.ty, Type::Record(_)),
            },
            ExpressionKind::In { collection, .. } => collection.ty != Type::Range,
            ExpressionKind::Not(_)
            | ExpressionKind::IsNone(_)
            | ExpressionKind::Conditional { .. }
            | ExpressionKind::Quantifier { .. }
            | ExpressionKind::Over { .. }
            | ExpressionKind::Bind { .. } => false,
            _ => true,
        }
    }
}
