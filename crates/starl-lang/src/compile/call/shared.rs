//! Shared variables: instances of three kinds of primitive, after those of the program.

use alloc::boxed::Box;
use alloc::format;
use alloc::vec::Vec;

use crate::compile::body::{Body, Slot};
use crate::compile::call::{Argument, HostFunction};
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::{Consistency, Expression, SharedId, Type};
use crate::machine::{Import, Instruction};
use crate::{ir, machine};

/// The kind of primitive that a shared variable is.
pub(in crate::compile) fn shared_kind(shared: &ir::Shared) -> &'static str {
    match (shared.is_single_writer, shared.consistency) {
        (true, _) => "SingleWriter",
        (false, Consistency::Linearizable) => "Linearizable",
        (false, _) => "MultiWriter",
    }
}

impl<'p> Body<'_, 'p> {
    fn shared_function(&self, id: SharedId, member: &str) -> HostFunction {
        let kind = shared_kind(&self.unit.program[id]);
        HostFunction::effect(&format!("{kind}.{member}"))
    }

    fn shared_instance(&self, id: SharedId) -> Argument<'p> {
        Argument::Int((self.unit.program.bindings.len() + id.index()) as u32)
    }

    /// A question about a shared variable, and its first arguments; in properties it is about a robot's copy.
    fn shared_query(
        &self,
        id: SharedId,
        member: &str,
        of: Option<&'p Expression>,
    ) -> (HostFunction, Vec<Argument<'p>>) {
        let mut arguments = Vec::from([self.shared_instance(id)]);
        let Some(robot) = of else {
            let import = HostFunction {
                is_query: true,
                ..self.shared_function(id, member)
            };
            return (import, arguments);
        };
        arguments.push(Argument::Value(robot));
        let import = HostFunction {
            labels: Vec::from([self.unit.program[id].name.clone()]),
            ..HostFunction::query(&format!("shared.{member}"))
        };
        (import, arguments)
    }

    /// `name[robot]` of a single-writer variable.
    pub fn shared_element(
        &mut self,
        id: SharedId,
        [robot, of]: [Option<&'p Expression>; 2],
        to: Slot,
        ty: &Type,
        is_fresh: bool,
    ) -> Compiled {
        let (import, mut arguments) = self.shared_query(id, "element", of);
        arguments.extend(robot.map(Argument::Value));
        let inner = &self.unit.program[id].ty;
        self.read_optional(import, &arguments, inner, to, ty, is_fresh)
    }

    /// Asks for an optional of a type. If that is an optional itself, the two are one to the program.
    fn read_optional(
        &mut self,
        import: HostFunction,
        arguments: &[Argument<'p>],
        inner: &Type,
        to: Slot,
        ty: &Type,
        is_fresh: bool,
    ) -> Compiled {
        let optional = Type::Optional(Box::new(inner.clone()));
        if *ty == optional {
            return self.host(import, arguments, &optional, to, is_fresh);
        }
        let mark = self.mark();
        let whole = self.take_for(&optional)?;
        self.host(import, arguments, &optional, whole, true)?;
        if inner != ty {
            return Err(self.broken());
        }
        let size = self.size(ty);
        self.move_value(to, whole.at(Size::SCALAR), size);
        self.release(mark);
        Ok(())
    }

    /// All of a single-writer variable.
    pub fn shared_map(
        &mut self,
        id: SharedId,
        of: Option<&'p Expression>,
        to: Slot,
        ty: &Type,
        is_fresh: bool,
    ) -> Compiled {
        let (import, arguments) = self.shared_query(id, "all", of);
        self.host(import, &arguments, ty, to, is_fresh)
    }

    /// A multi-writer variable. With an initial value it has one always.
    pub fn shared(
        &mut self,
        id: SharedId,
        of: Option<&'p Expression>,
        to: Slot,
        ty: &Type,
        is_fresh: bool,
    ) -> Compiled {
        let shared: &'p ir::Shared = &self.unit.program[id];
        let (import, arguments) = self.shared_query(id, "read", of);
        if shared.initial.is_none() {
            return self.read_optional(import, &arguments, &shared.ty, to, ty, is_fresh);
        }
        let mark = self.mark();
        let optional = Type::Optional(Box::new(shared.ty.clone()));
        let whole = self.take_for(&optional)?;
        self.host(import, &arguments, &optional, whole, true)?;
        self.emit(Instruction::Require {
            present: whole.input(),
        });
        let size = self.size(ty);
        self.move_value(to, whole.at(Size::SCALAR), size);
        self.release(mark);
        Ok(())
    }

    /// Passes the value of a shared variable to the host, by one of its members.
    pub fn write_shared(&mut self, id: SharedId, member: &str, value: &'p Expression) -> Compiled {
        let import = self.shared_function(id, member);
        let arguments = [self.shared_instance(id), Argument::Value(value)];
        self.tell(import, &arguments)
    }

    /// Passes the value of a shared variable that was changed in registers to the host.
    pub fn write_back_shared(&mut self, id: SharedId, value: Slot) -> Compiled {
        let ty = &self.unit.program[id].ty;
        let import = self.shared_function(id, "write");
        let mark = self.mark();
        let size = self.size(ty);
        let first = self.take(Size::SCALAR.plus(size))?;
        let Argument::Int(instance) = self.shared_instance(id) else {
            return Err(self.broken());
        };
        self.scalar(first, u64::from(instance));
        self.copy(first.at(Size::SCALAR), value, size);
        let kind = self.machine_type(ty)?;
        let import = Import {
            name: import.name,
            query: false,
            labels: Vec::new(),
            arguments: Vec::from([machine::Type::Int, kind]),
            results: Vec::new(),
        };
        self.call_host(import, first);
        self.release(mark);
        Ok(())
    }
}
