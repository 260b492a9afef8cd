//! One function while it is compiled: its registers, its locals and its code.
//!
//! Registers are taken and given back like a stack. A local keeps its registers from where it is
//! declared to the end of its block; what is needed for a moment lies above. A call's window begins
//! above all that is in use.
//!
//! Invariant: what lies at or above the top of the stack holds nothing that is still needed.

use alloc::vec::Vec;

use super::code::{Code, Label};
use super::problem::{Compiled, Problem};
use super::types::{Size, Unsuitable, WIDEST};
use super::unit::{Finished, Unit};
use crate::diagnostic::{self, Span};
use crate::ir::{self, Local, LocalId};
use crate::machine::operand::{
    Block, Count, Immediate, In, ObjectBlock, ObjectIn, ObjectInOut, ObjectOut, Out, PointIn,
    PointOut,
};
use crate::machine::{FunctionKind, Instruction, Type};

/// The scalar and object registers that a function may use: as many as a value may have.
const REGISTERS: Size = WIDEST;

/// Registers in a row: the first scalar and the first object of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Slot {
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

/// A function that is being compiled.
pub(super) struct Body<'u, 'p> {
    pub unit: &'u mut Unit<'p>,
    pub code: Code,
    pub kind: FunctionKind,
    /// The local variables.
    pub declared: &'p [Local],
    /// Where they are, once they are.
    locals: Vec<Option<Slot>>,
    /// The first registers that are free.
    top: Size,
    /// The most registers that were in use.
    most: Size,
    /// The file of what is compiled.
    pub file: u32,
    /// The place of what is compiled.
    pub span: Span,
}

impl<'u, 'p> Body<'u, 'p> {
    pub fn new(
        unit: &'u mut Unit<'p>,
        kind: FunctionKind,
        declared: &'p [Local],
        site: ir::Site,
    ) -> Self {
        Self {
            unit,
            code: Code::default(),
            kind,
            declared,
            locals: alloc::vec![None; declared.len()],
            top: Size::NONE,
            most: Size::NONE,
            file: site.file,
            span: site.span,
        }
    }

    /// The function, complete.
    pub fn finish(self, name: &str, arguments: Vec<Type>, results: Vec<Type>) -> Finished {
        Finished {
            name: name.into(),
            kind: self.kind,
            code: self.code,
            used: self.most,
            arguments,
            results,
        }
    }

    pub fn emit(&mut self, instruction: Instruction) {
        self.code.push(instruction, self.file, self.span);
    }

    pub fn label(&mut self) -> Label {
        self.code.label()
    }

    pub fn place(&mut self, label: Label) {
        self.code.place(label);
    }

    pub fn jump(&mut self, label: Label) {
        self.emit(Instruction::Jump {
            target: label.target(),
        });
    }

    /// Compiles something that stands at a place.
    pub fn at<T>(&mut self, span: Span, compile: impl FnOnce(&mut Self) -> T) -> T {
        let outer = core::mem::replace(&mut self.span, span);
        let result = compile(self);
        self.span = outer;
        result
    }

    // Registers.

    /// What is in use now, to be given to [`Body::release`].
    pub fn mark(&self) -> Size {
        self.top
    }

    /// Frees what was taken since the mark.
    pub fn release(&mut self, mark: Size) {
        self.top = mark;
    }

    /// Takes registers.
    pub fn take(&mut self, size: Size) -> Compiled<Slot> {
        let slot = Slot {
            scalar: self.top.scalars,
            object: self.top.objects,
        };
        let top = self.top.plus(size);
        if top.scalars > REGISTERS.scalars || top.objects > REGISTERS.objects {
            let message = "there are too many values at a time here";
            let code = diagnostic::Code::TooManyRegisters;
            let problem = Problem::new(code, self.file, self.span, message);
            return Err(problem.note(
                "a function holds at most 255 numbers and 127 texts and collections; split it, or put the values into a list",
            ));
        }
        self.top = top;
        self.most = self.most.max(top);
        Ok(slot)
    }

    /// Takes registers for a value.
    pub fn take_for(&mut self, ty: &ir::Type) -> Compiled<Slot> {
        let size = self.size(ty);
        self.take(size)
    }

    /// Whether nothing that is in use lies above these registers.
    pub fn is_on_top(&self, slot: Slot, size: Size) -> bool {
        slot.scalar + size.scalars == self.top.scalars
            && slot.object + size.objects == self.top.objects
    }

    pub fn size(&self, ty: &ir::Type) -> Size {
        self.unit.types.size(ty)
    }

    /// The number of the type of an object.
    pub fn object_type(&mut self, ty: &ir::Type) -> Compiled<crate::machine::operand::Type> {
        let made = self.unit.types.object(ty);
        let made = made.map_err(|why| self.unsuitable(ty, why));
        made.map(crate::machine::operand::Type)
    }

    /// The problem that the machine does not take a type which is used here.
    pub fn unsuitable(&self, ty: &ir::Type, why: Unsuitable) -> alloc::boxed::Box<Problem> {
        self.unit.unsuitable(ty, why, self.file, self.span)
    }

    pub fn machine_type(&mut self, ty: &ir::Type) -> Compiled<Type> {
        self.unit.machine_type(ty, self.file, self.span)
    }

    // Locals.

    /// Takes registers for a local.
    pub fn declare(&mut self, local: LocalId) -> Compiled<Slot> {
        let declared: &'p Local = &self.declared[local.index()];
        let slot = self.take_for(&declared.ty)?;
        self.bind(local, slot);
        Ok(slot)
    }

    /// Says where a local is.
    pub fn bind(&mut self, local: LocalId, slot: Slot) {
        self.locals[local.index()] = Some(slot);
    }

    /// Goes over to other locals; gives those before, for [`Body::restore_locals`].
    pub fn change_locals(&mut self, declared: &'p [Local]) -> (&'p [Local], Vec<Option<Slot>>) {
        let places = alloc::vec![None; declared.len()];
        let outer = core::mem::replace(&mut self.declared, declared);
        (outer, core::mem::replace(&mut self.locals, places))
    }

    /// Goes back to the locals before.
    pub fn restore_locals(&mut self, (declared, places): (&'p [Local], Vec<Option<Slot>>)) {
        self.declared = declared;
        self.locals = places;
    }

    /// Where a local is, if it is anywhere.
    pub fn bound(&self, local: LocalId) -> Option<Slot> {
        self.locals[local.index()]
    }

    /// Where a local is.
    pub fn local(&self, local: LocalId) -> Compiled<Slot> {
        self.bound(local).ok_or_else(|| self.broken())
    }

    /// The problem that the checked program is not what it is said to be.
    pub fn broken(&self) -> alloc::boxed::Box<Problem> {
        let message = "this cannot be compiled";
        let problem = Problem::new(diagnostic::Code::TooMuch, self.file, self.span, message);
        problem.note("the checker should have said why: please report it")
    }

    // Moving values.

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
            if let super::types::Part::Object(offset, kind) = part {
                self.emit(Instruction::ClearObject {
                    to: to.at(Size::new(0, offset)).object_out(),
                    kind: crate::machine::operand::Type(kind),
                });
            }
        }
        Ok(())
    }

    pub fn parts(&mut self, ty: &ir::Type) -> Compiled<Vec<super::types::Part>> {
        let parts = self.unit.types.parts(ty);
        parts.map_err(|why| self.unsuitable(ty, why))
    }
}
