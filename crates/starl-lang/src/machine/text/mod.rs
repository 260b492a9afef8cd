//! The machine's text form, which tests are written in and a person reads.

mod assembler;
mod disassembler;
mod types;

pub use assembler::{AssemblyError, assemble};
pub use disassembler::disassemble;
