//! Errors of loading and running a program.

use alloc::borrow::Cow;
use alloc::format;
use alloc::string::String;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Why a program stopped.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, Error)]
#[serde(rename_all = "snake_case")]
pub enum Fault {
    /// There is no element at this index of a list.
    #[error("{}", if *length == 0 { format!("index {index} of an empty list") } else { format!("index {index} is out of range 0..{length}") })]
    IndexOutOfRange {
        /// The index asked for.
        index: i64,
        /// How many elements there are.
        length: u32,
    },
    /// The map has no such key.
    #[error("the map has no such key")]
    KeyMissing,
    /// The result does not fit into 64 bits, or a span would be negative.
    #[error("the result is too great")]
    Overflow,
    /// An Int or a Duration was divided by zero.
    #[error("division by zero")]
    DivisionByZero,
    /// The value of an optional that has none was asked for.
    #[error("there is no value: it is none")]
    NoneUnwrapped,
    /// A number is outside what its new type or use allows.
    #[error("the number is out of range")]
    ConversionOutOfRange,
    /// The activation was not over when its fuel was.
    #[error("the activation takes too many instructions")]
    OutOfFuel,
    /// The program's values would need more bytes than it may have.
    #[error("values need more than {budget} bytes of memory")]
    OutOfMemory {
        /// The budget.
        budget: u64,
    },
    /// Functions called one another too deeply.
    #[error("functions call one another too deeply")]
    CallDepth,
    /// The host refused a call.
    #[error("{0}")]
    Host(Cow<'static, str>),
    /// A value is not of the type that the program was verified for: the host gave a wrong one.
    #[error("the host gave a value of a wrong type")]
    Malformed,
}

/// A fault and where it happened.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, Error)]
#[error("{fault} (instruction {position})")]
pub struct RuntimeError {
    /// The fault.
    pub fault: Fault,
    /// The instruction, an index into the program's code; see
    /// [`Program::span`](crate::machine::Program::span).
    pub position: u32,
}

/// Why bytecode was not taken.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum LoadError {
    /// The host offers no function that an import names.
    #[error("the host has no function `{0}`")]
    UnknownImport(String),
    /// A model is not a network that robots can evaluate.
    #[error("{path}: {reason}")]
    Model {
        /// Its path.
        path: String,
        /// Why not, and what to do.
        reason: String,
    },
    /// The bytecode breaks a rule of the machine.
    #[error("{}: {reason}", position.map_or("invalid bytecode".into(), |at| format!("instruction {at}")))]
    Invalid {
        /// The instruction, if it is one that breaks the rule.
        position: Option<u32>,
        /// The rule.
        reason: &'static str,
    },
}
