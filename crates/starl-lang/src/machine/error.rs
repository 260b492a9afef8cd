//! Errors of loading and running a program.

use alloc::borrow::Cow;
use alloc::string::String;
use core::fmt;
use serde::{Deserialize, Serialize};

/// Why a program stopped.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Fault {
    /// There is no element at this index of a list.
    IndexOutOfRange {
        /// The index asked for.
        index: i64,
        /// How many elements there are.
        length: u32,
    },
    /// The map has no such key.
    KeyMissing,
    /// The result does not fit into 64 bits, or a span would be negative.
    Overflow,
    /// An Int or a Duration was divided by zero.
    DivisionByZero,
    /// The value of an optional that has none was asked for.
    NoneUnwrapped,
    /// A number is outside what its new type or use allows.
    ConversionOutOfRange,
    /// The activation was not over when its fuel was.
    OutOfFuel,
    /// The program's values would need more bytes than it may have.
    OutOfMemory {
        /// The budget.
        budget: u64,
    },
    /// Functions called one another too deeply.
    CallDepth,
    /// The host refused a call.
    Host(Cow<'static, str>),
    /// A value is not of the type that the program was verified for: the host gave a wrong one.
    Malformed,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fault::IndexOutOfRange { index, length: 0 } => {
                write!(f, "index {index} of an empty list")
            }
            Fault::IndexOutOfRange { index, length } => {
                write!(f, "index {index} is out of range 0..{length}")
            }
            Fault::KeyMissing => f.write_str("the map has no such key"),
            Fault::Overflow => f.write_str("the result is too great"),
            Fault::DivisionByZero => f.write_str("division by zero"),
            Fault::NoneUnwrapped => f.write_str("there is no value: it is none"),
            Fault::ConversionOutOfRange => f.write_str("the number is out of range"),
            Fault::OutOfFuel => f.write_str("the activation takes too many instructions"),
            Fault::OutOfMemory { budget } => {
                write!(f, "values need more than {budget} bytes of memory")
            }
            Fault::CallDepth => f.write_str("functions call one another too deeply"),
            Fault::Host(text) => f.write_str(text),
            Fault::Malformed => f.write_str("the host gave a value of a wrong type"),
        }
    }
}

/// A fault and where it happened.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RuntimeError {
    /// The fault.
    pub fault: Fault,
    /// The instruction, an index into the program's code; see
    /// [`Program::span`](crate::machine::Program::span).
    pub position: u32,
}

impl fmt::Display for RuntimeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} (instruction {})", self.fault, self.position)
    }
}

impl core::error::Error for RuntimeError {}

/// Why bytecode was not taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LoadError {
    /// The host offers no function that an import names.
    UnknownImport(String),
    /// A model is not a network that robots can evaluate.
    Model {
        /// Its path.
        path: String,
        /// Why not, and what to do.
        reason: String,
    },
    /// The bytecode breaks a rule of the machine.
    Invalid {
        /// The instruction, if it is one that breaks the rule.
        position: Option<u32>,
        /// The rule.
        reason: &'static str,
    },
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LoadError::UnknownImport(name) => write!(f, "the host has no function `{name}`"),
            LoadError::Model { path, reason } => write!(f, "{path}: {reason}"),
            LoadError::Invalid {
                position: Some(position),
                reason,
            } => write!(f, "instruction {position}: {reason}"),
            LoadError::Invalid {
                position: None,
                reason,
            } => write!(f, "invalid bytecode: {reason}"),
        }
    }
}

impl core::error::Error for LoadError {}
