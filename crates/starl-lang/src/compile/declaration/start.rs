//! The start of a program: primitives are bound, variables get their first values.

use alloc::boxed::Box;
use alloc::format;
use alloc::vec::Vec;

use crate::check::Signature;
use crate::compile::body::Body;
use crate::compile::call::{Argument, HostFunction, shared_kind};
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::compile::unit::{Finished, Routine, Unit};
use crate::ir;
use crate::ir::{Consistency, Site, Type};
use crate::machine::FunctionKind;

impl<'p> Unit<'p> {
    /// The code that gives parameters their defaults; `None` if no parameter has one.
    pub fn defaults(&mut self) -> Compiled<Option<Finished>> {
        let program = self.program;
        let Some(first) = (program.parameters.iter()).find(|parameter| parameter.default.is_some())
        else {
            return Ok(None);
        };
        let mut body = Body::new(self, FunctionKind::Procedure, &[], first.site);
        for (number, parameter) in program.parameters.iter().enumerate() {
            let Some(default) = &parameter.default else {
                continue;
            };
            let place = body.unit.parameter(ir::ParameterId(number as u32));
            body.part(&parameter.locals, parameter.site, |body| {
                let value = body.take_for(&parameter.ty)?;
                body.into(default, value, true)?;
                body.store(place, value, &parameter.ty)
            })?;
        }
        Ok(Some(body.procedure("defaults")))
    }

    /// The code that runs at the start of a program.
    pub fn start(&mut self) -> Compiled<Finished> {
        let program = self.program;
        let mut body = Body::new(self, FunctionKind::Procedure, &[], Site::START);
        for (number, binding) in program.bindings.iter().enumerate() {
            body.bind_primitive(number as u32, binding)?;
        }
        for number in 0..program.shared.len() {
            body.bind_shared(ir::SharedId(number as u32))?;
        }
        for number in 0..program.variables.len() {
            let id = ir::VariableId(number as u32);
            body.initialize(id, false)?;
            if program[id].is_stable {
                body.recall(id)?;
            }
        }
        body.run_init()?;
        Ok(body.procedure("start"))
    }

    /// Restarts the program when a check is false: primitives stop, variables get their initial values, and `init`
    /// runs. The role does not change.
    pub fn reset(&mut self) -> Compiled<Finished> {
        let program = self.program;
        let mut body = Body::new(self, FunctionKind::Procedure, &[], Site::START);
        body.tell(HostFunction::effect("reset"), &[])?;
        let role = program.roles.as_ref().map(|roles| roles.variable);
        for number in 0..program.variables.len() {
            let id = ir::VariableId(number as u32);
            if role != Some(id) {
                body.initialize(id, true)?;
            }
        }
        body.run_init()?;
        Ok(body.procedure("reset"))
    }

    pub fn init(&mut self) -> Compiled<Finished> {
        let Some(init) = &self.program.init else {
            return Ok(self.nothing("init"));
        };
        let mut body = Body::new(self, FunctionKind::Procedure, &init.locals, Site::START);
        body.block(&init.body)?;
        Ok(body.procedure("init"))
    }
}

impl<'p> Body<'_, 'p> {
    /// Runs `init`, and that of the role.
    fn run_init(&mut self) -> Compiled {
        if self.unit.program.init.is_some() {
            self.run(Routine::Init)?;
        }
        if self.unit.program.roles.is_some() {
            self.run(Routine::Enter)?;
        }
        Ok(())
    }

    fn bind_primitive(&mut self, number: u32, binding: &'p ir::Binding) -> Compiled {
        let Some(kind) = binding.primitive else {
            return Err(self.broken());
        };
        self.part(&binding.locals, binding.site, |body| {
            let mut arguments = Vec::from([Argument::Int(number)]);
            let signature = Signature::read(kind.constructor);
            arguments.extend(body.arguments(&signature, &binding.arguments)?);
            let import = HostFunction::effect(&format!("{}.bind", kind.name()));
            body.tell(import, &arguments)
        })
    }

    fn bind_shared(&mut self, id: ir::SharedId) -> Compiled {
        let shared: &'p ir::Shared = &self.unit.program[id];
        let number = (self.unit.program.bindings.len() + id.index()) as u32;
        self.part(&shared.locals, shared.site, |body| {
            let import = HostFunction::effect(&format!("{}.bind", shared_kind(shared)));
            let arguments = [
                Argument::Int(number),
                Argument::MaybeText(match shared.consistency {
                    Consistency::Eventual => None,
                    named => Some(named.name()),
                }),
            ];
            body.tell(import, &arguments)?;
            if let Some(initial) = &shared.initial {
                body.write_shared(id, "initialize", initial)?;
            }
            Ok(())
        })
    }

    /// Gives a variable its first value. That of its type is there at the start already.
    pub fn initialize(&mut self, id: ir::VariableId, is_again: bool) -> Compiled {
        let variable: &'p ir::Variable = &self.unit.program[id];
        let place = self.unit.variable(id);
        self.part(&variable.locals, variable.site, |body| {
            if variable.initial.is_none() && !is_again {
                return Ok(());
            }
            let value = body.take_for(&variable.ty)?;
            match &variable.initial {
                Some(initial) => body.into(initial, value, true)?,
                None => body.zeros(value, &variable.ty)?,
            }
            body.store(place, value, &variable.ty)
        })
    }

    /// Gives a variable the value that was saved, if one was.
    fn recall(&mut self, id: ir::VariableId) -> Compiled {
        let variable: &'p ir::Variable = &self.unit.program[id];
        let place = self.unit.variable(id);
        self.part(&[], variable.site, |body| {
            let optional = Type::Optional(Box::new(variable.ty.clone()));
            let saved = body.take_for(&optional)?;
            let import = HostFunction::query("saved");
            body.host(import, &[Argument::Int(id.0)], &optional, saved, true)?;
            let nothing = body.label();
            body.jump_on(saved, false, nothing);
            body.store(place, saved.at(Size::SCALAR), &variable.ty)?;
            body.place(nothing);
            Ok(())
        })
    }
}
