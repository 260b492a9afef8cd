//! The machine that runs compiled programs.
//!
//! A program is a set of functions in [bytecode](Bytecode) for a register machine (see
//! [`Instruction`]), with tables that say which of them are its actions, handlers and properties.
//! [`Program::load`] verifies bytecode and joins it to a host; [`Machine`] runs parts of a program on
//! the [`State`] of one robot, until they end or something goes wrong.
//!
//! Invariants: bytecode that was verified cannot make the machine panic, run longer than its fuel
//! allows or hold more memory than its budget; equal states, inputs and answers of the host give equal
//! states and equal fuel, on every target; a robot's program is its program and its [`State`], nothing
//! else is kept from one activation to the next.

mod error;
mod host;
mod instruction;
mod interpreter;
pub mod operand;
mod program;
mod text;
mod types;
mod value;
mod verify;

pub use error::{Fault, LoadError, RuntimeError};
pub use host::{Host, HostCall, Import, Resolve};
pub use instruction::Instruction;
pub use interpreter::workspace::Workspace;
pub use interpreter::{Limits, Machine};
pub use program::{
    Action, Binding, Bytecode, Claim, Enum, Function, FunctionKind, Handler, Program, Property,
    Span, Variable,
};
pub use text::{AssemblyError, assemble, disassemble};
pub use types::{Layout, ObjectType, Order, Parts, Type};
pub use value::list::{Block, List};
pub use value::object::{Body, Map, Object};
pub use value::state::State;
pub use value::tree::Value;
