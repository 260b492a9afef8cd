//! Whether values are equal, part by part.

use crate::compile::body::{Body, Location, Slot};
use crate::compile::code::Label;
use crate::compile::condition::short_slot;
use crate::compile::constant::folded;
use crate::compile::expression::is_located;
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::compile::types::Part;
use crate::ir::Expression;
use crate::machine::operand::{Out, Short, Target};
use crate::machine::{Instruction, operand};

pub(super) fn short(bits: Option<u64>) -> Option<i16> {
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
        let parts = self.parts(&left.ty)?;
        if let [Part::Scalar(_)] = parts[..] {
            return self.branch_equal_integers([left, right], when_equal, label);
        }
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
        let (left, right) = match folded(&self.unit.known, left) {
            Some(_) => (right, left),
            None => (left, right),
        };
        let constant = short(folded(&self.unit.known, right)).map(Short);
        if let Some(right) = constant
            && !when_equal
            && is_located(left)
            && let Some(location) = self.locate(left)?
        {
            return self.branch_unequal_location(location, right, target);
        }
        let left = self.value(left)?.input();
        let instruction = match (constant, when_equal) {
            (Some(right), true) => Instruction::JumpIfEqualConstant {
                left,
                right,
                target,
            },
            (Some(right), false) => Instruction::JumpIfNotEqualConstant {
                left,
                right,
                target,
            },
            (None, true) => Instruction::JumpIfEqual {
                left,
                right: self.value(right)?.input(),
                target,
            },
            (None, false) => Instruction::JumpIfNotEqual {
                left,
                right: self.value(right)?.input(),
                target,
            },
        };
        self.emit(instruction);
        Ok(())
    }

    /// Goes to the target if the scalar at a location is another one than a constant.
    fn branch_unequal_location(
        &mut self,
        location: Location,
        right: Short,
        target: Target,
    ) -> Compiled {
        let instruction = match short_slot(location) {
            Some(variable) => Instruction::JumpIfStateNot {
                right,
                target,
                variable,
            },
            None => Instruction::JumpIfNotEqualConstant {
                left: self.scalar_at(location)?.input(),
                right,
                target,
            },
        };
        self.emit(instruction);
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

    pub fn jump_if_different(
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
    pub fn equal_part(&mut self, part: Part, [left, right]: [Slot; 2], to: Out) {
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
}
