//! StarL programs on robots: the machine's host.
//!
//! [`Code`] is verified bytecode, joined to the functions that robots offer; [`RobotProgram`] runs it on one robot as a
//! [`starl_core::Program`], so that every host of native programs runs StarL programs too; [`properties`] judges the
//! program's properties.
//!
//! The functions that robots offer are in two tables: the language's built-in names, and kinds of primitives. Both list
//! the arguments and results of each function, so that loading rejects bytecode that was compiled for other tables. No
//! input from the network makes a program stop: unknown messages are ignored, and so are orders whose fields do not
//! fit, with a warning. A run-time error stops the program of this one robot and names the place in its source.

mod acting;
mod arguments;
mod atomic;
mod builtins;
mod code;
mod corruption;
mod defaults;
mod failure;
mod host;
mod inspection;
mod instance;
mod joint;
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
pub use orders::{Orders, WrongField};
pub use parameter::ParameterError;
pub use program::RobotProgram;

use alloc::string::{String, ToString};

/// The names of all functions that programs can import, as [`crate::machine::Import`] has them.
pub fn functions() -> impl Iterator<Item = String> {
    let builtins = builtins::BUILTINS.iter().map(|b| &b.signature);
    let observables = properties::observables().map(|o| &o.signature);
    let plain = builtins.chain(observables).map(|s| s.name.to_string());
    let members = primitives::KINDS.iter().flat_map(|kind| {
        let names = kind.members().map(|signature| signature.name);
        let names = ["bind"].into_iter().chain(names);
        names.map(|name| alloc::format!("{}.{name}", kind.name))
    });
    plain.chain(members)
}
