//! Declarations: the start of a program, its actions, handlers, roles and functions.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::body::Body;
use super::call::{Argument, HostFunction, shared_kind};
use super::problem::{Compiled, Problem};
use super::types::Size;
use super::unit::{Finished, Routine, Unit};
use crate::check::Signature;
use crate::diagnostic::{self, Span};
use crate::ir::{self, Local, Site, Type};
use crate::machine::operand::Short;
use crate::machine::{self, FunctionKind, Instruction};

impl<'p> Unit<'p> {
    /// What gives the parameters their default values; nothing if none has one.
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
        body.end();
        Ok(Some(body.finish("defaults", Vec::new(), Vec::new())))
    }

    /// Notes the primitives that hosts do not have.
    pub fn note_unavailable(&mut self) {
        for binding in &self.program.bindings {
            let Some(kind) = binding.primitive.filter(|kind| !kind.is_available) else {
                continue;
            };
            let message = format!("robots do not have the primitive {} yet", kind.name());
            let code = diagnostic::Code::UnavailablePrimitive;
            let problem = Problem::new(code, binding.site.file, binding.site.span, message)
                .note("the program can be checked, but it cannot run");
            self.problems.push(*problem);
        }
    }

    /// What a program does at its start.
    pub fn start(&mut self) -> Compiled<Finished> {
        let program = self.program;
        let site = Site {
            file: 0,
            span: Span::empty(0),
        };
        let mut body = Body::new(self, FunctionKind::Procedure, &[], site);
        for (number, binding) in program.bindings.iter().enumerate() {
            body.bind_primitive(number as u32, binding)?;
        }
        for number in 0..program.shared.len() {
            body.bind_shared(ir::SharedId(number as u32))?;
        }
        for number in 0..program.variables.len() {
            body.initialize(ir::VariableId(number as u32), false)?;
        }
        if program.init.is_some() {
            body.run(Routine::Init)?;
        }
        if program.roles.is_some() {
            body.run(Routine::Enter)?;
        }
        body.end();
        Ok(body.finish("start", Vec::new(), Vec::new()))
    }

    /// A routine that others call.
    pub fn compile_routine(&mut self, routine: Routine) -> Compiled<Finished> {
        let program = self.program;
        match routine {
            Routine::Function(id) => self.function(&program[id]),
            Routine::Constant(id) => self.constant_function(&program[id]),
            Routine::Init => self.init(),
            Routine::Enter => self.enter(),
            Routine::EnterRole(number) => self.enter_role(number),
        }
    }

    fn function(&mut self, function: &'p ir::Function) -> Compiled<Finished> {
        let mut body = Body::new(
            self,
            FunctionKind::Function,
            &function.locals,
            function.site,
        );
        let mut arguments = Vec::new();
        for number in 0..function.parameters {
            let local = ir::LocalId(number);
            body.declare(local)?;
            arguments.push(body.machine_type(&function.locals[local.index()].ty)?);
        }
        let result = body.machine_type(&function.result)?;
        body.reserve(&function.result)?;
        body.block(&function.body)?;
        let name = body.unit.name_of(&function.name, function.site);
        Ok(body.finish(&name, arguments, Vec::from([result])))
    }

    fn constant_function(&mut self, constant: &'p ir::Constant) -> Compiled<Finished> {
        let mut body = Body::new(
            self,
            FunctionKind::Function,
            &constant.locals,
            constant.site,
        );
        let result = body.machine_type(&constant.ty)?;
        body.reserve(&constant.ty)?;
        body.give(Some(&constant.value))?;
        let name = body.unit.name_of(&constant.name, constant.site);
        Ok(body.finish(&name, Vec::new(), Vec::from([result])))
    }

    /// The name of a function of a file, with that of its library.
    fn name_of(&self, name: &str, site: Site) -> String {
        match self.program.files.get(site.file as usize) {
            Some(library) if site.file != 0 => format!("{library}.{name}"),
            _ => name.into(),
        }
    }

    fn init(&mut self) -> Compiled<Finished> {
        let site = Site {
            file: 0,
            span: Span::empty(0),
        };
        let Some(init) = &self.program.init else {
            return Ok(self.nothing("init"));
        };
        let mut body = Body::new(self, FunctionKind::Procedure, &init.locals, site);
        body.block(&init.body)?;
        body.end();
        Ok(body.finish("init", Vec::new(), Vec::new()))
    }

    /// What is done on entering a role: that of the role which the robot has.
    fn enter(&mut self) -> Compiled<Finished> {
        let program = self.program;
        let Some(roles) = &program.roles else {
            return Ok(self.nothing("role.enter"));
        };
        let place = self.variable(roles.variable);
        let site = program[roles.variable].site;
        let mut body = Body::new(self, FunctionKind::Procedure, &[], site);
        let role = body.scalar_at(super::location::Location::State(place))?;
        for number in 0..roles.roles.len() as u16 {
            if !body.unit.does_something(number) {
                continue;
            }
            let next = body.label();
            body.emit(Instruction::JumpIfNotEqualConstant {
                left: role.input(),
                right: Short(number as i16),
                target: next.target(),
            });
            body.run(Routine::EnterRole(number))?;
            body.leave(Size::NONE);
            body.place(next);
        }
        body.end();
        Ok(body.finish("role.enter", Vec::new(), Vec::new()))
    }

    fn nothing(&mut self, name: &str) -> Finished {
        let site = Site {
            file: 0,
            span: Span::empty(0),
        };
        let mut body = Body::new(self, FunctionKind::Procedure, &[], site);
        body.end();
        body.finish(name, Vec::new(), Vec::new())
    }

    fn does_something(&self, role: u16) -> bool {
        let program = self.program;
        let roles = program.roles.iter().flat_map(|roles| &roles.roles);
        let entry = roles.skip(usize::from(role)).map(|role| &role.entry).next();
        entry.is_some_and(Option::is_some)
            || (program.variables.iter()).any(|variable| variable.role == Some(role))
    }

    fn enter_role(&mut self, number: u16) -> Compiled<Finished> {
        let program = self.program;
        let roles = program.roles.as_ref().map(|roles| &roles.roles);
        let Some(role) = roles.and_then(|roles| roles.get(usize::from(number))) else {
            return Ok(self.nothing("role.enter"));
        };
        let mut body = Body::new(self, FunctionKind::Procedure, &[], role.site);
        for (index, variable) in program.variables.iter().enumerate() {
            if variable.role == Some(number) {
                body.initialize(ir::VariableId(index as u32), true)?;
            }
        }
        if let Some(entry) = &role.entry {
            body.part(&entry.locals, role.site, |body| body.block(&entry.body))?;
        }
        body.end();
        let name = format!("{}.enter", role.name);
        Ok(body.finish(&name, Vec::new(), Vec::new()))
    }

    /// The guard of an action.
    pub fn guard(&mut self, action: &'p ir::Action) -> Compiled<Finished> {
        let mut body = Body::new(self, FunctionKind::Guard, &action.locals, action.site);
        // The result: whether it holds, then the bindings.
        let holds = body.take(Size::SCALAR)?;
        let mut results = Vec::from([machine::Type::Bool]);
        let mut size = Size::SCALAR;
        for local in &action.bindings {
            body.declare(*local)?;
            let ty = &action.locals[local.index()].ty;
            results.push(body.machine_type(ty)?);
            size = size.plus(body.size(ty));
        }
        let no = body.label();
        let always = super::constant::folded(body.unit, &action.guard) == Some(1);
        body.branch(&action.guard, false, no)?;
        body.scalar(holds, 1);
        body.leave(size);
        if !always {
            body.place(no);
            body.emit(Instruction::ReturnFalse {
                until: machine::operand::Count(0),
            });
        }
        let name = format!("{}.pre", body.unit.action_name(action));
        Ok(body.finish(&name, Vec::new(), results))
    }

    /// The effect of an action.
    pub fn effect(&mut self, action: &'p ir::Action) -> Compiled<Finished> {
        let mut body = Body::new(self, FunctionKind::Procedure, &action.locals, action.site);
        let mut arguments = Vec::new();
        for local in &action.bindings {
            body.declare(*local)?;
            arguments.push(body.machine_type(&action.locals[local.index()].ty)?);
        }
        body.block(&action.effect)?;
        body.end();
        let name = format!("{}.eff", body.unit.action_name(action));
        Ok(body.finish(&name, arguments, Vec::new()))
    }

    /// The name of an action, with that of its role.
    pub fn action_name(&self, action: &ir::Action) -> String {
        match (action.role, &self.program.roles) {
            (Some(role), Some(roles)) => match roles.roles.get(usize::from(role)) {
                Some(role) => format!("{}.{}", role.name, action.name),
                None => action.name.clone(),
            },
            _ => action.name.clone(),
        }
    }

    /// A handler; gives the name of its event and its primitive too.
    pub fn handler(
        &mut self,
        handler: &'p ir::Handler,
    ) -> Compiled<(String, Option<u32>, Finished)> {
        let program = self.program;
        let mut body = Body::new(self, FunctionKind::Procedure, &handler.locals, handler.site);
        let (event, primitive, types) = match &handler.event {
            ir::Event::Error => return Err(body.broken()),
            ir::Event::Message(id) => {
                let message = &program[*id];
                let fields = message.fields.iter().map(|field| field.ty.clone());
                let types: Vec<Type> = core::iter::once(Type::Robot).chain(fields).collect();
                (program.message_name(*id), None, types)
            }
            ir::Event::Primitive { binding, event } => {
                let shapes = event.signature().parameters;
                let types = shapes.iter().map(|part| body.shape(&part.shape));
                let types = types.collect::<Option<Vec<Type>>>();
                let types = types.ok_or_else(|| body.broken())?;
                (event.name().into(), Some(binding.0), types)
            }
        };
        let mut arguments = Vec::new();
        for (number, ty) in types.iter().enumerate() {
            let slot = body.take_for(ty)?;
            arguments.push(body.machine_type(ty)?);
            if let Some(Some(local)) = handler.parameters.get(number) {
                body.bind(*local, slot);
            }
        }
        body.block(&handler.body)?;
        body.end();
        let name = match primitive {
            Some(number) => format!("on.{}.{event}", program.bindings[number as usize].name),
            None => format!("on.{event}"),
        };
        Ok((event, primitive, body.finish(&name, arguments, Vec::new())))
    }
}

impl<'p> Body<'_, 'p> {
    /// Compiles a part of the function that has locals of its own.
    fn part<T>(
        &mut self,
        locals: &'p [Local],
        site: Site,
        compile: impl FnOnce(&mut Self) -> Compiled<T>,
    ) -> Compiled<T> {
        let mark = self.mark();
        let outer = self.change_locals(locals);
        let (file, span) = (self.file, self.span);
        (self.file, self.span) = (site.file, site.span);
        let result = compile(self)?;
        (self.file, self.span) = (file, span);
        self.restore_locals(outer);
        self.release(mark);
        Ok(result)
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
            let nowhere = body.take(Size::NONE)?;
            body.host(import, &arguments, &Type::Nothing, nowhere, false)
        })
    }

    fn bind_shared(&mut self, id: ir::SharedId) -> Compiled {
        let shared: &'p ir::Shared = &self.unit.program[id];
        let number = (self.unit.program.bindings.len() + id.index()) as u32;
        self.part(&shared.locals, shared.site, |body| {
            let import = HostFunction::effect(&format!("{}.bind", shared_kind(shared)));
            let arguments = [
                Argument::Int(number),
                Argument::MaybeText(shared.consistency.as_deref()),
            ];
            let nowhere = body.take(Size::NONE)?;
            body.host(import, &arguments, &Type::Nothing, nowhere, false)?;
            if let Some(initial) = &shared.initial {
                body.write_shared(id, "initialize", initial)?;
            }
            Ok(())
        })
    }

    /// Gives a variable its first value. That of its type is there at the start already.
    fn initialize(&mut self, id: ir::VariableId, is_again: bool) -> Compiled {
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

    /// Sees that there are registers for the result.
    fn reserve(&mut self, result: &Type) -> Compiled {
        let mark = self.mark();
        self.release(Size::NONE);
        self.take_for(result)?;
        self.release(mark);
        Ok(())
    }
}
