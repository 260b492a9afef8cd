//! Calls of functions, and the windows of calls.
//!
//! A call's window begins above all registers that are in use. Where the result is wanted in fresh
//! registers on top of the stack, the window begins there, and nothing has to be moved.

mod host;
mod primitive;
mod shared;

pub(in crate::compile) use host::{Argument, Arguments, HostFunction};
pub(in crate::compile) use shared::shared_kind;

use crate::compile::body::{Body, Slot};
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::{Expression, Type};
use crate::machine::Instruction;
use crate::machine::operand::FunctionIndex;

/// A call's window, while it is filled.
struct Window {
    /// Its first registers.
    base: Slot,
    /// The registers in use before.
    mark: Size,
}

impl<'p> Body<'_, 'p> {
    fn open(&mut self, to: Slot, result: Size, is_fresh: bool) -> Compiled<Window> {
        let mark = self.mark();
        if is_fresh && self.is_on_top(to, result) {
            self.release(Size::new(to.scalar, to.object));
        }
        let base = self.take(Size::NONE)?;
        Ok(Window { base, mark })
    }

    /// Takes the result of a call that was made.
    fn close(&mut self, window: &Window, to: Slot, result: Size) -> Compiled {
        self.release(Size::new(window.base.scalar, window.base.object));
        self.take(result)?;
        if window.base != to {
            self.move_value(to, window.base, result);
        }
        self.release(window.mark);
        Ok(())
    }

    /// A call of a function of the program.
    pub fn call_function(
        &mut self,
        function: u32,
        arguments: &'p [Expression],
        to: Slot,
        ty: &Type,
        is_fresh: bool,
    ) -> Compiled {
        let result = self.size(ty);
        let window = self.open(to, result, is_fresh)?;
        for argument in arguments {
            let slot = self.take_for(&argument.ty)?;
            self.into(argument, slot, true)?;
        }
        self.emit(Instruction::Call {
            scalars: window.base.block(),
            objects: window.base.objects(),
            function: FunctionIndex(function),
        });
        self.close(&window, to, result)
    }
}
