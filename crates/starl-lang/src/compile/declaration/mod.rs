//! Functions that others call.

mod action;
mod handler;
mod property;
mod role;
mod start;

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use crate::compile::body::Body;
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::compile::unit::{Finished, Routine, Unit};
use crate::ir;
use crate::ir::{Local, Site, Type};
use crate::machine::FunctionKind;

impl<'p> Unit<'p> {
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

    fn nothing(&mut self, name: &str) -> Finished {
        Body::new(self, FunctionKind::Procedure, &[], Site::START).procedure(name)
    }
}

impl<'p> Body<'_, 'p> {
    /// The function, complete, which takes and returns nothing.
    fn procedure(mut self, name: &str) -> Finished {
        self.end();
        self.finish(name, Vec::new(), Vec::new())
    }

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

    /// Sees that there are registers for the result.
    fn reserve(&mut self, result: &Type) -> Compiled {
        let mark = self.mark();
        self.release(Size::NONE);
        self.take_for(result)?;
        self.release(mark);
        Ok(())
    }
}
