//! Values of a program's parameters, set by the scenario.

use super::code::Code;
use super::failure::Failure;
use super::words::type_name;
use crate::machine::{Parameter, State, Value, Variable};
use alloc::string::String;
use alloc::vec::Vec;
use thiserror::Error;

/// Why a program cannot run with the parameters that it was given.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ParameterError {
    /// The program has no such parameter.
    #[error("the program has no parameter `{name}`; it has {}", if known.is_empty() { "none".into() } else { known.join(", ") })]
    Unknown {
        /// The given name.
        name: String,
        /// The parameters that there are.
        known: Vec<String>,
    },
    /// The value is not of the parameter's type.
    #[error("the parameter `{name}` is {expected}, not {found}")]
    WrongType {
        /// The parameter.
        name: String,
        /// Its type as the language writes it, e.g. `List[Point]`.
        expected: String,
        /// The value that was given.
        found: String,
    },
    /// The value is outside the parameter's range.
    #[error("the parameter `{name}` goes {range}, and {found} is not in that")]
    OutOfRange {
        /// The parameter.
        name: String,
        /// The range, e.g. `from 1 to 10`.
        range: String,
        /// The value that was given.
        found: String,
    },
    /// The parameter has no default and was not given.
    #[error("the parameter `{name}`, {expected}, is not given")]
    Missing {
        /// The parameter.
        name: String,
        /// Its type as the language writes it.
        expected: String,
    },
    /// A default could not be worked out.
    #[error(transparent)]
    Default(Failure),
}

/// A state with these values of the parameters, and the defaults of others.
pub(super) fn state(code: &Code, given: &[(&str, Value)]) -> Result<State, ParameterError> {
    let program = code.program();
    let parameters = || {
        let variables = program.bytecode().variables.iter();
        variables.filter(|variable| variable.parameter != Parameter::No)
    };
    let expected = |variable: &Variable| type_name(program.bytecode(), &variable.kind);
    let is_given = |variable: &&Variable| given.iter().any(|(name, _)| *name == variable.name);
    let mut missing = parameters().filter(|variable| variable.parameter == Parameter::Required);
    if let Some(missing) = missing.find(|variable| !is_given(variable)) {
        return Err(ParameterError::Missing {
            name: missing.name.clone(),
            expected: expected(missing),
        });
    }
    let initial = code.initial();
    let mut state = initial
        .map_err(|failure| ParameterError::Default(failure.clone()))?
        .clone();
    for (name, value) in given {
        let Some(variable) = parameters().find(|variable| variable.name == *name) else {
            return Err(ParameterError::Unknown {
                name: (*name).into(),
                known: parameters().map(|known| known.name.clone()).collect(),
            });
        };
        if !program.set(&mut state, name, value) {
            return Err(ParameterError::WrongType {
                name: (*name).into(),
                expected: expected(variable),
                found: alloc::format!("{value}"),
            });
        }
        if let Some(range) = variable.range_text().filter(|_| !variable.accepts(value)) {
            return Err(ParameterError::OutOfRange {
                name: (*name).into(),
                range,
                found: alloc::format!("{value}"),
            });
        }
    }
    Ok(state)
}
