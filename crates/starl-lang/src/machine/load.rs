//! From bytecode to a program that can be run.

use super::{known, verify};
use crate::machine::bytecode::Bytecode;
use crate::machine::error::LoadError;
use crate::machine::host::{Import, Resolve, Signature};
use crate::machine::program::Program;
use crate::machine::types::Layout;
use alloc::vec::Vec;

impl Program {
    /// Verifies bytecode and resolves its imports.
    pub fn load(bytecode: Bytecode, host: &dyn Resolve) -> Result<Program, LoadError> {
        let tables = verify::verify(&bytecode)?;
        let resolve = |import: &Import| match host.resolve(import) {
            Some(number) => Ok(Signature {
                number,
                arguments: Layout::of(&import.arguments),
                results: Layout::of(&import.results),
            }),
            None => Err(LoadError::UnknownImport(import.name.clone())),
        };
        let signatures = bytecode
            .imports
            .iter()
            .map(resolve)
            .collect::<Result<_, _>>()?;
        let object_registers = bytecode.functions.iter().map(|f| f.object_registers);
        let mut program = Program {
            known: Vec::new(),
            object_registers: object_registers.max().unwrap_or(0).into(),
            entries: bytecode.functions.iter().map(|f| f.entry).collect(),
            texts: bytecode
                .texts
                .iter()
                .map(|text| text.as_str().into())
                .collect(),
            layouts: tables.arguments.into_iter().zip(tables.results).collect(),
            parts: tables.parts,
            state: tables.state,
            signatures,
            bytecode,
        };
        program.known = known::of(&program);
        Ok(program)
    }
}
