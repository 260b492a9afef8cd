//! Why a program on a robot stops.

use crate::machine::{Fault, Program, RuntimeError};
use alloc::string::String;
use starl_primitives::register::OperationError;
use thiserror::Error;

/// Why a program cannot continue, or a part of it cannot be evaluated.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum Failure {
    /// An instruction failed.
    #[error("{}{fault}", place.as_ref().map_or(String::new(), |place| place.clone() + ": "))]
    Fault {
        /// Its place in the text, e.g. `race.starl:12:5`, or its function if that is not known.
        place: Option<String>,
        /// The fault.
        fault: Fault,
    },
    /// The program calls `fail`.
    #[error("{0}")]
    Told(String),
    /// An action with `atomic` cannot be stored.
    #[error("what an atomic action wrote is not stored: {0}")]
    NotStored(OperationError),
}

impl Failure {
    /// An error with its place in the program's text.
    pub(super) fn of(program: &Program, error: &RuntimeError) -> Failure {
        let function = || Some(program.function_at(error.position)?.name.clone());
        Failure::Fault {
            place: program.source(error.position).or_else(function),
            fault: error.fault.clone(),
        }
    }
}
