//! Comparisons, as jumps and as values.

use alloc::vec::Vec;

use super::body::{Body, Slot};
use super::code::Label;
use super::condition::short_slot;
use super::constant::folded;
use super::expression::is_located;
use super::problem::Compiled;
use super::types::{Part, Size};
use crate::ir::{Expression, Operator, Type};
use crate::machine::Instruction;
use crate::machine::operand::{self, In, Out, Short, Target};

/// What order says: the left is less than the right, or equal too if `or_equal`.
struct Order {
    left: In,
    right: In,
    or_equal: bool,
}

fn short(bits: Option<u64>) -> Option<i16> {
    i16::try_from(bits? as i64).ok()
}

impl<'p> Body<'_, 'p> {
    /// Goes to the label if two values are equal, or if they are not.
    pub fn branch_equal(
        &mut self,
        [left, right]: [&'p Expression; 2],
        when_equal: bool,
        label: Label,
    ) -> Compiled {
        let is_integer = self.size(&left.ty) == Size::SCALAR && left.ty != Type::Float;
        if is_integer {
            return self.branch_equal_integers([left, right], when_equal, label);
        }
        let parts = self.parts(&left.ty)?;
        if let [Part::Object(_, kind)] = parts[..] {
            let left = self.object(left)?;
            let right = self.object(right)?;
            let equal = self.take(Size::SCALAR)?;
            self.emit(Instruction::EqualObject {
                to: equal.output(),
                left,
                right,
                kind: operand::Type(kind),
            });
            self.jump_on(equal, when_equal, label);
            return Ok(());
        }
        let left = self.value(left)?;
        let right = self.value(right)?;
        self.branch_parts(&parts, [left, right], when_equal, label)
    }

    fn branch_equal_integers(
        &mut self,
        [left, right]: [&'p Expression; 2],
        when_equal: bool,
        label: Label,
    ) -> Compiled {
        let target = label.target();
        // A constant is on the right from here on.
        let (left, right) = match folded(self.unit, left) {
            Some(_) => (right, left),
            None => (left, right),
        };
        let Some(constant) = short(folded(self.unit, right)) else {
            let left = self.value(left)?.input();
            let right = self.value(right)?.input();
            self.emit(match when_equal {
                true => Instruction::JumpIfEqual {
                    left,
                    right,
                    target,
                },
                false => Instruction::JumpIfNotEqual {
                    left,
                    right,
                    target,
                },
            });
            return Ok(());
        };
        let right = Short(constant);
        if !when_equal && is_located(left) {
            let location = self.locate(left)?;
            if let Some(variable) = location.and_then(short_slot) {
                self.emit(Instruction::JumpIfStateNot {
                    right,
                    target,
                    variable,
                });
                return Ok(());
            }
        }
        let left = self.value(left)?.input();
        self.emit(match when_equal {
            true => Instruction::JumpIfEqualConstant {
                left,
                right,
                target,
            },
            false => Instruction::JumpIfNotEqualConstant {
                left,
                right,
                target,
            },
        });
        Ok(())
    }

    fn branch_parts(
        &mut self,
        parts: &[Part],
        [left, right]: [Slot; 2],
        when_equal: bool,
        label: Label,
    ) -> Compiled {
        let different = match when_equal {
            true => self.label(),
            false => label,
        };
        for part in parts {
            self.jump_if_different(*part, [left, right], different)?;
        }
        if when_equal {
            self.jump(label);
            self.place(different);
        }
        Ok(())
    }

    fn jump_if_different(
        &mut self,
        part: Part,
        [left, right]: [Slot; 2],
        label: Label,
    ) -> Compiled {
        let offset = Self::part_offset(part);
        let (left, right) = (left.at(offset), right.at(offset));
        if let Part::Scalar(_) = part {
            self.emit(Instruction::JumpIfNotEqual {
                left: left.input(),
                right: right.input(),
                target: label.target(),
            });
            return Ok(());
        }
        let mark = self.mark();
        let equal = self.take(Size::SCALAR)?;
        self.equal_part(part, [left, right], equal.output());
        self.jump_on(equal, false, label);
        self.release(mark);
        Ok(())
    }

    /// Whether two parts are equal; their slots are those of the parts.
    fn equal_part(&mut self, part: Part, [left, right]: [Slot; 2], to: Out) {
        self.emit(match part {
            Part::Scalar(_) => Instruction::Equal {
                to,
                left: left.input(),
                right: right.input(),
            },
            Part::Float(_) => Instruction::EqualFloat {
                to,
                left: left.input(),
                right: right.input(),
            },
            Part::Point(_) => Instruction::EqualPoint {
                to,
                left: left.point(),
                right: right.point(),
            },
            Part::Object(_, kind) => Instruction::EqualObject {
                to,
                left: left.object_in(),
                right: right.object_in(),
                kind: operand::Type(kind),
            },
        });
    }

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
        let Order {
            left,
            right,
            or_equal,
        } = self.order(operator, [left, right])?;
        self.emit(match (is_float, or_equal, when) {
            (true, false, true) => Instruction::JumpIfLessFloat {
                left,
                right,
                target,
            },
            (true, false, false) => Instruction::JumpUnlessLessFloat {
                left,
                right,
                target,
            },
            (true, true, true) => Instruction::JumpIfLessEqualFloat {
                left,
                right,
                target,
            },
            (true, true, false) => Instruction::JumpUnlessLessEqualFloat {
                left,
                right,
                target,
            },
            (false, false, true) => Instruction::JumpIfLess {
                left,
                right,
                target,
            },
            (false, false, false) => Instruction::JumpIfLessEqual {
                left: right,
                right: left,
                target,
            },
            (false, true, true) => Instruction::JumpIfLessEqual {
                left,
                right,
                target,
            },
            (false, true, false) => Instruction::JumpIfLess {
                left: right,
                right: left,
                target,
            },
        });
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
        let (operator, variable, constant) = if let Some(constant) = short(folded(self.unit, right))
        {
            (operator, left, constant)
        } else if let Some(constant) = short(folded(self.unit, left)) {
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
        let parts: Vec<Part> = self.parts(&left.ty)?;
        let negated = match (parts.first(), is_equality) {
            (Some(Part::Object(_, kind)), _) => {
                let kind = operand::Type(*kind);
                let (l, r) = (self.object(left)?, self.object(right)?);
                let turned = matches!(operator, Operator::Greater | Operator::LessEqual);
                let (left, right) = if turned { (r, l) } else { (l, r) };
                self.emit(match is_equality {
                    true => Instruction::EqualObject {
                        to: output,
                        left,
                        right,
                        kind,
                    },
                    false => Instruction::LessObject {
                        to: output,
                        left,
                        right,
                        kind,
                    },
                });
                matches!(
                    operator,
                    Operator::NotEqual | Operator::LessEqual | Operator::GreaterEqual
                )
            }
            (Some(Part::Scalar(_)), true) if operator == Operator::NotEqual => {
                let left = self.value(left)?.input();
                let right = self.value(right)?.input();
                self.emit(Instruction::NotEqual {
                    to: output,
                    left,
                    right,
                });
                false
            }
            (Some(part), true) => {
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
        if negated {
            self.emit(Instruction::Not {
                to: output,
                from: to.input(),
            });
        }
        Ok(())
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
