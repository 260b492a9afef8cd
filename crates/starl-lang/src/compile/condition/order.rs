//! Which of two values is less.

use crate::compile::body::{Body, Slot};
use crate::compile::code::Label;
use crate::compile::condition::equality::short;
use crate::compile::constant::folded;
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::compile::types::Part;
use crate::ir::{Expression, Operator, Type};
use crate::machine::operand::{In, Out, Short, Target};
use crate::machine::{Instruction, operand};

/// An order comparison: left less than right, or equal as well if `or_equal`.
struct Order {
    left: In,
    right: In,
    or_equal: bool,
}

impl<'p> Body<'_, 'p> {
    /// Goes to the label if the order of two values is as said, or if it is not.
    pub fn branch_order(
        &mut self,
        operator: Operator,
        [left, right]: [&'p Expression; 2],
        when: bool,
        label: Label,
    ) -> Compiled {
        let target = label.target();
        match left.ty {
            Type::Record(_) => {
                let parts = self.parts(&left.ty)?;
                let (left, right) = (self.value(left)?, self.value(right)?);
                let sides = match operator {
                    Operator::Less | Operator::LessEqual => [left, right],
                    _ => [right, left],
                };
                let or_equal = matches!(operator, Operator::LessEqual | Operator::GreaterEqual);
                return self.branch_parts_order(&parts, sides, or_equal, when, label);
            }
            Type::String => {
                let less = self.take(Size::SCALAR)?;
                self.compare(operator, [left, right], less)?;
                self.jump_on(less, when, label);
                return Ok(());
            }
            Type::Float => {}
            _ => {
                if self.branch_order_constant(operator, [left, right], when, target)? {
                    return Ok(());
                }
            }
        }
        let is_float = left.ty == Type::Float;
        let order = self.order(operator, [left, right])?;
        self.emit(jump(is_float, &order, when, target));
        Ok(())
    }

    /// Goes to the label if the left tuple is less, or equal as well if `or_equal`, or if it is not: the first parts that
    /// differ decide.
    pub fn branch_parts_order(
        &mut self,
        parts: &[Part],
        [left, right]: [Slot; 2],
        or_equal: bool,
        when: bool,
        label: Label,
    ) -> Compiled {
        let end = self.label();
        let (yes, no) = if when { (label, end) } else { (end, label) };
        for part in parts {
            let offset = Self::part_offset(*part);
            let (l, r) = (left.at(offset), right.at(offset));
            match part {
                Part::Object(_, kind) => {
                    let mark = self.mark();
                    let less = self.take(Size::SCALAR)?;
                    self.emit(Instruction::LessObject {
                        to: less.output(),
                        left: l.object_in(),
                        right: r.object_in(),
                        kind: operand::Type(*kind),
                    });
                    self.jump_on(less, true, yes);
                    self.release(mark);
                }
                _ => {
                    let order = Order {
                        left: l.input(),
                        right: r.input(),
                        or_equal: false,
                    };
                    let is_float = matches!(part, Part::Float(_));
                    self.emit(jump(is_float, &order, true, yes.target()));
                }
            }
            self.jump_if_different(*part, [left, right], no)?;
        }
        self.jump(if or_equal { yes } else { no });
        self.place(end);
        Ok(())
    }

    /// Both sides, the lesser one on the left.
    fn order(&mut self, operator: Operator, sides: [&'p Expression; 2]) -> Compiled<Order> {
        let left = self.value(sides[0])?.input();
        let right = self.value(sides[1])?.input();
        let or_equal = matches!(operator, Operator::LessEqual | Operator::GreaterEqual);
        let (left, right) = match operator {
            Operator::Less | Operator::LessEqual => (left, right),
            _ => (right, left),
        };
        Ok(Order {
            left,
            right,
            or_equal,
        })
    }

    /// The same with a small constant on one side, if there is one.
    fn branch_order_constant(
        &mut self,
        operator: Operator,
        [left, right]: [&'p Expression; 2],
        when: bool,
        target: Target,
    ) -> Compiled<bool> {
        use Operator::{Greater, GreaterEqual, Less, LessEqual};
        let (operator, variable, constant) =
            if let Some(constant) = short(folded(&self.unit.known, right)) {
                (operator, left, constant)
            } else if let Some(constant) = short(folded(&self.unit.known, left)) {
                let turned = match operator {
                    Less => Greater,
                    LessEqual => GreaterEqual,
                    Greater => Less,
                    _ => LessEqual,
                };
                (turned, right, constant)
            } else {
                return Ok(false);
            };
        // All four are whether it is less than some bound, or whether it is not.
        let bound = match operator {
            Less | GreaterEqual => Some(constant),
            _ => constant.checked_add(1),
        };
        let Some(bound) = bound else {
            return Ok(false);
        };
        let when_less = matches!(operator, Less | LessEqual) == when;
        let (left, right) = (self.value(variable)?.input(), Short(bound));
        self.emit(match when_less {
            true => Instruction::JumpIfLessConstant {
                left,
                right,
                target,
            },
            false => Instruction::JumpUnlessLessConstant {
                left,
                right,
                target,
            },
        });
        Ok(true)
    }

    /// A comparison of scalars, points or single objects, as a value.
    pub fn compare(
        &mut self,
        operator: Operator,
        [left, right]: [&'p Expression; 2],
        to: Slot,
    ) -> Compiled {
        let output = to.output();
        let is_equality = matches!(operator, Operator::Equal | Operator::NotEqual);
        let parts = self.parts(&left.ty)?;
        let is_negated = match parts.first() {
            Some(Part::Object(_, kind)) => {
                let kind = operand::Type(*kind);
                self.compare_objects(operator, [left, right], kind, output)?
            }
            Some(Part::Scalar(_)) if operator == Operator::NotEqual => {
                let left = self.value(left)?.input();
                let right = self.value(right)?.input();
                self.emit(Instruction::NotEqual {
                    to: output,
                    left,
                    right,
                });
                false
            }
            Some(part) if is_equality => {
                let left = self.value(left)?;
                let right = self.value(right)?;
                self.equal_part(*part, [left, right], output);
                operator == Operator::NotEqual
            }
            _ => {
                let is_float = left.ty == Type::Float;
                let order = self.order(operator, [left, right])?;
                self.emit(less(is_float, &order, output));
                false
            }
        };
        if is_negated {
            self.emit(Instruction::Not {
                to: output,
                from: to.input(),
            });
        }
        Ok(())
    }

    /// Compares two objects for equality or order; whether the opposite is what was asked for.
    fn compare_objects(
        &mut self,
        operator: Operator,
        [left, right]: [&'p Expression; 2],
        kind: operand::Type,
        to: Out,
    ) -> Compiled<bool> {
        let (left, right) = (self.object(left)?, self.object(right)?);
        let (left, right) = match operator {
            Operator::Greater | Operator::LessEqual => (right, left),
            _ => (left, right),
        };
        self.emit(match operator {
            Operator::Equal | Operator::NotEqual => Instruction::EqualObject {
                to,
                left,
                right,
                kind,
            },
            _ => Instruction::LessObject {
                to,
                left,
                right,
                kind,
            },
        });
        Ok(matches!(
            operator,
            Operator::NotEqual | Operator::LessEqual | Operator::GreaterEqual
        ))
    }
}

fn less(is_float: bool, order: &Order, to: Out) -> Instruction {
    let (left, right) = (order.left, order.right);
    match (is_float, order.or_equal) {
        (false, false) => Instruction::LessInt { to, left, right },
        (false, true) => Instruction::LessEqualInt { to, left, right },
        (true, false) => Instruction::LessFloat { to, left, right },
        (true, true) => Instruction::LessEqualFloat { to, left, right },
    }
}

/// Goes to the target if the order is as said, or if it is not.
fn jump(is_float: bool, order: &Order, when: bool, target: Target) -> Instruction {
    let (left, right) = (order.left, order.right);
    if is_float {
        // NaN compares false in every order.
        return match (order.or_equal, when) {
            (false, true) => Instruction::JumpIfLessFloat {
                left,
                right,
                target,
            },
            (false, false) => Instruction::JumpUnlessLessFloat {
                left,
                right,
                target,
            },
            (true, true) => Instruction::JumpIfLessEqualFloat {
                left,
                right,
                target,
            },
            (true, false) => Instruction::JumpUnlessLessEqualFloat {
                left,
                right,
                target,
            },
        };
    }
    // Not less is the other one less or equal.
    let (left, right) = if when { (left, right) } else { (right, left) };
    match order.or_equal == when {
        true => Instruction::JumpIfLessEqual {
            left,
            right,
            target,
        },
        false => Instruction::JumpIfLess {
            left,
            right,
            target,
        },
    }
}
