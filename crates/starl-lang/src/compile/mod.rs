//! The compiler: from a checked program to the machine's bytecode.

use alloc::vec::Vec;

use crate::check::Checked;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::machine::Bytecode;

/// Compiles a program that was checked.
///
/// # Errors
/// What the machine or the robots cannot do; the checker's errors, if the program has any.
pub fn compile(checked: &Checked) -> Result<Bytecode, Vec<Diagnostic>> {
    let _ = checked;
    let message = "programs cannot be compiled yet";
    Err(Vec::from([Diagnostic::new(
        Code::TooMuch,
        Span::empty(0),
        message,
    )]))
}
