//! The compiler: from a checked program to the machine's bytecode.
//!
//! It walks the typed program ([`crate::ir`]) once and writes code as it goes. A function's registers
//! are a stack (`body`); a value is computed where it is wanted (`expression`); a condition becomes
//! jumps (`condition`); what functions share is numbered when it is first needed (`unit`).
//!
//! Invariant: what is given can be loaded. What the machine or the robots cannot do is told as
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

/// What keeps a program, or a library, that the checker finds correct from being run; nothing if the checker has found
/// errors.
#[must_use]
pub fn problems(checked: &Checked) -> Vec<Diagnostic> {
    match checked.has_errors() {
        true => Vec::new(),
        false => compile(checked).err().unwrap_or_default(),
    }
}

/// Compiles a program that was checked. Of a library all functions are compiled, of a program those
/// that it uses.
///
/// # Errors
/// What the machine or the robots cannot do; the checker's errors, if there are any.
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
