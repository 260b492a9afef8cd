//! The compiler: from a checked program to the machine's bytecode.
//!
//! It walks the typed program ([`crate::ir`]) once and writes code as it goes. A function's registers
//! are a stack (`body`); a value is computed where it is wanted (`expression`); a condition becomes
//! jumps (`condition`); what functions share is numbered when it is first needed (`unit`).
//!
//! Invariant: the result can be loaded. Features that the machine or the robots do not support are reported as
//! diagnostics.

mod body;
mod breakpoint;
mod call;
mod code;
mod computed;
mod condition;
mod constant;
mod declaration;
mod expression;
mod join;
mod link;
mod problem;
mod size;
mod statement;
mod types;
mod unit;

use alloc::vec::Vec;

pub use breakpoint::{with_condition, with_value};

use crate::check::Checked;
use crate::diagnostic::{Diagnostic, Severity};
use crate::machine::Bytecode;

/// The problems that keep a checked program or library from running; empty if the checker has found errors.
#[must_use]
pub fn problems(checked: &Checked) -> Vec<Diagnostic> {
    match checked.has_errors() {
        true => Vec::new(),
        false => compile(checked).err().unwrap_or_default(),
    }
}

/// Compiles a program that was checked. Compiles all functions of a library, but only the used functions of a program.
///
/// # Errors
/// Features that the machine or the robots do not support; the checker's errors, if there are any.
pub fn compile(checked: &Checked) -> Result<Bytecode, Vec<Diagnostic>> {
    if checked.has_errors() {
        let all = checked.files.iter().flat_map(|file| &file.diagnostics);
        let errors = all.filter(|diagnostic| diagnostic.severity() == Severity::Error);
        return Err(errors.cloned().collect());
    }
    link::link(&checked.program, &checked.files).map_err(|problems| {
        let told = problems
            .into_iter()
            .map(|problem| problem.told(&checked.files));
        told.collect()
    })
}
