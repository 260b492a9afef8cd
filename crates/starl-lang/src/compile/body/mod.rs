//! One function while it is compiled: its registers, its locals and its code.
//!
//! Registers are taken and given back like a stack. A local keeps its registers from where it is
//! declared to the end of its block; what is needed for a moment lies above. A call's window begins
//! above everything that is in use.
//!
//! Invariant: what lies at or above the top of the stack holds nothing that is still needed.

mod location;
mod moves;
mod slot;

pub(in crate::compile) use location::{Location, state_operand};
pub(in crate::compile) use slot::Slot;

use alloc::vec::Vec;

use crate::compile::code::{Code, Label};
use crate::compile::problem::{Compiled, Problem};
use crate::compile::size::Size;
use crate::compile::types::Unsuitable;
use crate::compile::unit::{Finished, Unit};
use crate::diagnostic::Span;
use crate::ir::{Local, LocalId};
use crate::machine::{FunctionKind, Instruction, Type};
use crate::{diagnostic, ir};
use slot::REGISTERS;

/// A function that is being compiled.
pub(in crate::compile) struct Body<'u, 'p> {
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
    /// The file of the compiled code.
    pub file: u32,
    /// The position of the compiled code.
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

    /// Compiles code with a position in the source.
    pub fn at<T>(&mut self, span: Span, compile: impl FnOnce(&mut Self) -> T) -> T {
        let outer = core::mem::replace(&mut self.span, span);
        let result = compile(self);
        self.span = outer;
        result
    }

    /// The registers in use now, to be passed to [`Body::release`].
    pub fn mark(&self) -> Size {
        self.top
    }

    /// Frees the registers taken since the mark.
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
            let message = "too many values are in use here";
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

    pub fn parts(&mut self, ty: &ir::Type) -> Compiled<Vec<crate::compile::types::Part>> {
        let parts = self.unit.types.parts(ty);
        parts.map_err(|why| self.unsuitable(ty, why))
    }

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

    /// The problem that the checked program violates an invariant of the checker.
    pub fn broken(&self) -> alloc::boxed::Box<Problem> {
        let message = "this cannot be compiled";
        let problem = Problem::new(diagnostic::Code::TooMuch, self.file, self.span, message);
        problem.note("the checker should have said why: please report it")
    }
}
