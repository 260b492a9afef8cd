//! Copying and moving values between registers, and writing those that are known.

use crate::compile::body::{Body, Slot};
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir;
use crate::machine::Instruction;
use crate::machine::operand::{Count, Immediate};

impl<'u, 'p> Body<'u, 'p> {
    /// Copies a value from registers to registers.
    pub fn copy(&mut self, to: Slot, from: Slot, size: Size) {
        self.copy_scalars(to, from, size.scalars);
        for object in 0..size.objects {
            let offset = Size::new(0, object);
            if to.object != from.object {
                self.emit(Instruction::CopyObject {
                    to: to.at(offset).object_out(),
                    from: from.at(offset).object_in(),
                });
            }
        }
    }

    /// Moves a value from registers that are not needed any more.
    pub fn move_value(&mut self, to: Slot, from: Slot, size: Size) {
        self.copy_scalars(to, from, size.scalars);
        for object in 0..size.objects {
            let offset = Size::new(0, object);
            if to.object != from.object {
                self.emit(Instruction::MoveObject {
                    to: to.at(offset).object_out(),
                    from: from.at(offset).object_in_out(),
                });
            }
        }
    }

    fn copy_scalars(&mut self, to: Slot, from: Slot, count: u32) {
        if to.scalar == from.scalar {
            return;
        }
        match count {
            0 => {}
            1 => self.emit(Instruction::Copy {
                to: to.output(),
                from: from.input(),
            }),
            3 => self.emit(Instruction::CopyPoint {
                to: to.point_out(),
                from: from.point(),
            }),
            _ => {
                // A block's length is a byte.
                let half = count.min(255);
                self.emit(Instruction::CopyBlock {
                    to: to.block(),
                    from: from.block(),
                    count: Count(half as u8),
                });
                let rest = Size::new(half, 0);
                self.copy_scalars(to.at(rest), from.at(rest), count - half);
            }
        }
    }

    /// Writes a scalar that is known.
    pub fn scalar(&mut self, to: Slot, bits: u64) {
        let instruction = match i32::try_from(bits as i64) {
            Ok(value) => Instruction::Int {
                to: to.output(),
                value: Immediate(value),
            },
            Err(_) => {
                let constant = self.unit.constant(bits);
                Instruction::Constant {
                    to: to.output(),
                    constant: crate::machine::operand::Constant(constant),
                }
            }
        };
        self.emit(instruction);
    }

    /// Writes a constant text.
    pub fn text(&mut self, to: Slot, text: &str) {
        let constant = crate::machine::operand::Text(self.unit.text(text));
        self.emit(Instruction::Text {
            to: to.object_out(),
            constant,
        });
    }

    /// Writes the value of a type that is all zeros, empty and none.
    pub fn zeros(&mut self, to: Slot, ty: &ir::Type) -> Compiled {
        for scalar in 0..self.size(ty).scalars {
            self.scalar(to.at(Size::new(scalar, 0)), 0);
        }
        for part in self.parts(ty)? {
            if let crate::compile::types::Part::Object(offset, kind) = part {
                self.emit(Instruction::ClearObject {
                    to: to.at(Size::new(0, offset)).object_out(),
                    kind: crate::machine::operand::Type(kind),
                });
            }
        }
        Ok(())
    }
}
