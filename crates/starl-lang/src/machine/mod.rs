//! The machine that runs compiled programs.
//!
//! A program is a set of functions in [bytecode](Bytecode) for a register machine (see [`Instruction`]), with tables
//! that say which of them are its actions, handlers and properties. [`Program::load`] verifies bytecode and joins it to
//! a host; [`Machine`] runs parts of a program on the [`State`] of one robot, until they end or fail.
//!
//! Invariants: bytecode that was verified cannot make the machine panic, run longer than its fuel allows or hold more
//! memory than its budget; equal states, inputs and answers of the host give equal states and equal fuel, on every
//! target; only the [`State`] is kept from one activation to the next.
//!
//! The module `compile` translates a program's text as follows:
//! - A state variable's scalars and objects are at fixed places of the [`State`], in the order of the
//!   declarations. Scalars are loaded, worked on and stored; objects are worked on where they are.
//! - A parameter is a variable that nothing assigns, after the others; `defaults` gives it its default
//!   value. So is the variable `role`, as far as the host is concerned.
//! - A constant that is one scalar stands in the code; another one is a function without arguments.
//! - `pre` is a guard function: it ends by `return` with true and the bindings of `if some` and the
//!   like, or by `return_false`. `eff` is a procedure with those bindings as its arguments.
//! - A primitive's instance number is its place among the [`Binding`]s; the start calls the import
//!   `Mutex.bind` (or like) with that number and the arguments. `mux.acquire(x)` calls `Mutex.acquire`
//!   with the number and x; `mux.held` calls the query `Mutex.held` with the number.
//! - A shared variable is an instance of `SingleWriter` or `MultiWriter`, after the program's own.
//!   `pos[r]` calls `SingleWriter.element`, `pos` alone `SingleWriter.all`; `pos[me] = e` is
//!   `SingleWriter.write`.
//! - `role = r` stores the role and, if it is another one, calls the procedure `role.enter`, which calls
//!   that of the role. The start does so too, after `init`.
//! - `for x in xs` counts with `loop` through `list_get` (also for sets) or `map_entry`; it runs over a
//!   copy of the collection, which is a share, if its body may change the variable.
//! - `xs[i].f = e` reads the element, changes the register and writes it back.
//! - `if some p = q` jumps unless the optional's Bool; `q!` is `require`.
//! - A property's function takes robots and reads their variables by `load_other`; without
//!   quantifiers it takes one, the robot itself. Inner quantifiers are loops over a query's result.

mod bytecode;
mod error;
mod host;
mod instruction;
mod interpreter;
mod known;
mod load;
pub mod operand;
mod program;
mod range;
mod text;
mod types;
mod value;
mod verify;

pub use bytecode::{
    Action, Binding, Bytecode, Claim, Enum, Function, FunctionKind, Handler, Model, Origin,
    Parameter, Property, Range, SourceFile, Span, Variable,
};
pub use error::{Fault, LoadError, RuntimeError};
pub use host::{Host, HostCall, Import, Resolve};
pub use instruction::Instruction;
pub use interpreter::workspace::Workspace;
pub use interpreter::{Limits, Machine};
pub use program::Program;
pub use text::{AssemblyError, assemble, disassemble};
pub use types::{Layout, ObjectType, Order, Parts, Type, is_tuple};
pub use value::object::{Block, Body, List, Map, Object};
pub use value::state::State;
pub use value::tree::Value;
