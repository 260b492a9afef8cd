//! Actions: guards and effects.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use crate::compile::body::Body;
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::compile::unit::{Finished, Unit};
use crate::machine::{FunctionKind, Instruction};
use crate::{ir, machine};

impl<'p> Unit<'p> {
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
        let always = crate::compile::constant::folded(&body.unit.known, &action.guard) == Some(1);
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

    /// The function that gives how long a guard has to hold, or how often an action fires.
    pub fn time(
        &mut self,
        action: &'p ir::Action,
        time: &'p ir::Expression,
        word: &str,
    ) -> Compiled<Finished> {
        let mut body = Body::new(self, FunctionKind::Guard, &action.locals, action.site);
        let is_there = body.take(Size::SCALAR)?;
        let value = body.take_for(&time.ty)?;
        Body::into(&mut body, time, value, true)?;
        body.scalar(is_there, 1);
        body.leave(Size::SCALAR.plus(body.size(&time.ty)));
        let name = format!("{}.{word}", body.unit.action_name(action));
        let results = Vec::from([machine::Type::Bool, machine::Type::Duration]);
        Ok(body.finish(&name, Vec::new(), results))
    }

    /// The guard of a check: whether it is false.
    pub fn check(&mut self, check: &'p ir::Check) -> Compiled<Finished> {
        let mut body = Body::new(self, FunctionKind::Guard, &check.locals, check.site);
        let fails = body.take(Size::SCALAR)?;
        let holds = body.label();
        body.branch(&check.condition, true, holds)?;
        body.scalar(fails, 1);
        body.leave(Size::SCALAR);
        body.place(holds);
        body.emit(Instruction::ReturnFalse {
            until: machine::operand::Count(0),
        });
        Ok(body.finish("check", Vec::new(), Vec::from([machine::Type::Bool])))
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
}
