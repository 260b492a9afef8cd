//! Bytecode from compiled functions and tables.

use alloc::vec::Vec;

use super::problem::Problem;
use super::unit::Unit;
use crate::diagnostic::Span;
use crate::ir::Type;
use crate::machine::{Bytecode, Function};

/// Puts the functions one after the other.
pub(super) fn join(mut unit: Unit<'_>, mut bytecode: Bytecode) -> Result<Bytecode, Vec<Problem>> {
    // The machine asks for the type of texts by itself.
    if !unit.texts.is_empty()
        && let Err(why) = unit.types.object(&Type::String)
    {
        let problem = unit.unsuitable(&Type::String, why, 0, Span::empty(0));
        unit.problems.push(*problem);
    }
    if !unit.problems.is_empty() {
        return Err(unit.problems);
    }
    for finished in unit.functions.into_iter().flatten() {
        let entry = bytecode.code.len() as u32;
        let objects = finished.used.objects as u8;
        finished
            .code
            .append_to(objects, &mut bytecode.code, &mut bytecode.spans);
        bytecode.functions.push(Function {
            name: finished.name,
            kind: finished.kind,
            entry,
            end: bytecode.code.len() as u32,
            registers: finished.used.scalars as u16,
            object_registers: objects,
            arguments: finished.arguments,
            results: finished.results,
        });
    }
    bytecode.constants = unit.constants;
    bytecode.texts = unit.texts;
    bytecode.enums = unit.types.enums;
    bytecode.types = unit.types.objects;
    bytecode.imports = unit.imports;
    Ok(bytecode)
}
