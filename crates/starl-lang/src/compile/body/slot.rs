//! Registers in a row, as operands of instructions.

use crate::compile::size::{Size, WIDEST};
use crate::machine::operand::{
    Block, In, ObjectBlock, ObjectIn, ObjectInOut, ObjectOut, Out, PointIn, PointOut,
};

/// The scalar and object registers that a function may use: as many as a value may have.
pub(super) const REGISTERS: Size = WIDEST;

/// Registers in a row: the first scalar and the first object of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::compile) struct Slot {
    pub scalar: u32,
    pub object: u32,
}

/// The number of a register. That of a value which takes no register may be beyond the last one; then
/// any will do.
const fn number(register: u32) -> u8 {
    if register < REGISTERS.scalars {
        register as u8
    } else {
        0
    }
}

impl Slot {
    /// The part that begins so far into it.
    pub const fn at(self, offset: Size) -> Self {
        Self {
            scalar: self.scalar + offset.scalars,
            object: self.object + offset.objects,
        }
    }

    pub const fn input(self) -> In {
        In(number(self.scalar))
    }

    pub const fn output(self) -> Out {
        Out(number(self.scalar))
    }

    pub const fn block(self) -> Block {
        Block(number(self.scalar))
    }

    pub const fn point(self) -> PointIn {
        PointIn(number(self.scalar))
    }

    pub const fn point_out(self) -> PointOut {
        PointOut(number(self.scalar))
    }

    /// The object as an operand.
    pub const fn operand(self) -> u8 {
        if self.object < REGISTERS.objects {
            self.object as u8
        } else {
            0
        }
    }

    pub const fn objects(self) -> ObjectBlock {
        ObjectBlock(self.operand())
    }

    pub const fn object_in(self) -> ObjectIn {
        ObjectIn(self.operand())
    }

    pub const fn object_out(self) -> ObjectOut {
        ObjectOut(self.operand())
    }

    pub const fn object_in_out(self) -> ObjectInOut {
        ObjectInOut(self.operand())
    }
}
