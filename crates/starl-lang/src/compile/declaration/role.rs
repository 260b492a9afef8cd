//! The code that runs on entering a role.

use alloc::format;

use crate::compile::body::Body;
use crate::compile::body::Location;
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::compile::unit::{Finished, Routine, Unit};
use crate::ir;
use crate::machine::operand::Short;
use crate::machine::{FunctionKind, Instruction};

impl<'p> Unit<'p> {
    /// The code that runs on entering the robot's role.
    pub fn enter(&mut self) -> Compiled<Finished> {
        let program = self.program;
        let Some(roles) = &program.roles else {
            return Ok(self.nothing("role.enter"));
        };
        let place = self.variable(roles.variable);
        let site = program[roles.variable].site;
        let mut body = Body::new(self, FunctionKind::Procedure, &[], site);
        let role = body.scalar_at(Location::State(place))?;
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
        Ok(body.procedure("role.enter"))
    }

    fn does_something(&self, role: u16) -> bool {
        let program = self.program;
        let roles = program.roles.iter().flat_map(|roles| &roles.roles);
        let entry = roles.skip(usize::from(role)).map(|role| &role.entry).next();
        entry.is_some_and(Option::is_some)
            || (program.variables.iter()).any(|variable| variable.role == Some(role))
    }

    pub fn enter_role(&mut self, number: u16) -> Compiled<Finished> {
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
        Ok(body.procedure(&format!("{}.enter", role.name)))
    }
}
