//! Constants that the machine itself computes, while the program is compiled.

use alloc::borrow::Cow;
use alloc::format;
use alloc::vec::Vec;

use super::body::Body;
use super::constant::folded;
use super::join::join;
use super::problem::{Compiled, Problem};
use super::unit::Unit;
use crate::diagnostic;
use crate::ir::{Expression, Local, Program, Site};
use crate::machine::{
    self, Bytecode, FunctionKind, Host, HostCall, Import, Limits, Machine, Workspace,
};

/// A host for constants, which never call it.
struct Nobody;

impl Host for Nobody {
    fn call(&mut self, _: u32, _: &mut HostCall<'_>) -> Result<u64, Cow<'static, str>> {
        Err("a constant cannot call the host".into())
    }
}

/// The value of a constant expression that is one scalar.
pub(super) fn computed(
    unit: &Unit<'_>,
    expression: &Expression,
    locals: &[Local],
    site: Site,
) -> Compiled<u64> {
    if let Some(known) = folded(&unit.known, expression) {
        return Ok(known);
    }
    let failed = |why: &dyn core::fmt::Display| {
        let code = diagnostic::Code::NotComputable;
        let message = "this value cannot be computed";
        Problem::new(code, site.file, expression.span, message).note(format!("{why}"))
    };
    let bytecode = alone(unit.program, expression, locals, site)?;
    let program = machine::Program::load(bytecode, &|_: &Import| None);
    let program = program.map_err(|error| failed(&error))?;
    let (mut state, mut workspace) = (program.new_state(), Workspace::new());
    let mut host = Nobody;
    let limits = Limits::default();
    let mut machine = Machine::new(&program, &mut state, &mut workspace, &mut host, limits);
    let result = machine.call(0, &[], &[]);
    let (scalars, _) = result.map_err(|error| failed(&error.fault))?;
    scalars
        .first()
        .copied()
        .ok_or_else(|| failed(&"it is nothing"))
}

/// A program of which the first function gives the value.
fn alone(
    program: &Program,
    expression: &Expression,
    locals: &[Local],
    site: Site,
) -> Compiled<Bytecode> {
    let mut unit = Unit::new(program);
    let number = unit.reserve();
    let mut body = Body::new(&mut unit, FunctionKind::Function, locals, site);
    let result = body.machine_type(&expression.ty)?;
    body.give(Some(expression))?;
    let function = body.finish("value", Vec::new(), Vec::from([result]));
    unit.define(number, Ok(function));
    unit.compile_routines();
    join(unit, Bytecode::default()).map_err(|problems| {
        let first = problems.into_iter().next();
        first.map_or_else(
            || {
                Problem::new(
                    diagnostic::Code::NotComputable,
                    site.file,
                    expression.span,
                    "",
                )
            },
            alloc::boxed::Box::new,
        )
    })
}
