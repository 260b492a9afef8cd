//! StarL programs on robots: the machine's host.
//!
//! [`Code`] is verified bytecode, joined to the functions that robots offer; [`RobotProgram`] runs it on one robot as a
//! [`starl_core::Program`], so that every host of native programs runs StarL programs too; [`properties`] judges the
//! program's properties.
//!
//! The functions that robots offer are in two tables: the language's built-in names, and kinds of primitives. Both list
//! the arguments and results of each function, so that loading rejects bytecode that was compiled for other tables. The
//! functions take the context of a call and the program; these know functions by their numbers only. Loading, dispatch
//! and running stand above both. No input from the network makes a program stop: unknown messages are ignored, and so
//! are orders whose fields do not fit, with a warning. A run-time error stops the program of this one robot and names
//! the place in its source.

mod acting;
mod arguments;
mod atomic;
mod builtins;
mod code;
mod context;
mod corruption;
mod defaults;
mod dispatch;
mod failure;
mod host;
mod inspection;
mod instance;
mod joiner;
mod joint;
mod load;
mod messages;
mod orders;
mod pace;
mod parameter;
mod primitives;
mod program;
pub mod properties;
mod reports;
mod rest;
mod services;
mod shape;
mod stable;
mod stage;
mod words;
mod workbench;

pub use code::Code;
pub use failure::Failure;
pub use inspection::{ActionState, PrimitiveState, VariableState};
pub use joiner::functions;
pub use orders::{Orders, WrongField};
pub use parameter::ParameterError;
pub use program::RobotProgram;
