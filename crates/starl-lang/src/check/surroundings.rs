//! The syntactic context at a position, for completing a name in an editor.
//!
//! The editor replaces the name that is being typed by the probe, a name that no declaration has. The checker records
//! the context when it reaches the probe.

use alloc::string::String;
use alloc::vec::Vec;

use super::resolution::Symbol;
use super::tables::Purity;
use crate::ir::{Local, Type};

/// The context of a name that is being typed.
#[derive(Clone, Debug, PartialEq)]
pub enum Surroundings {
    /// It is a value, something that is called or something that is assigned to.
    Value(Reach),
    /// It is a part of a value of this type.
    Member {
        /// The type.
        of: Type,
        /// Whether it is in a property.
        in_property: bool,
    },
    /// It is a part of a library, a bound primitive or an enum.
    Part(Symbol),
    /// It is a type.
    Type,
    /// It is a kind of primitive.
    Primitive,
    /// It is a message or a primitive that reports something.
    Event,
    /// It is what this primitive reports.
    EventOf(Symbol),
}

/// The declarations in scope where a value is expected.
#[derive(Clone, Debug, PartialEq)]
pub struct Reach {
    /// The locals, the innermost last.
    pub locals: Vec<Local>,
    /// The expected type, if any.
    pub expected: Option<Type>,
    /// The highest purity of the built-in functions and primitives that may be used.
    pub purity: Purity,
    /// Whether the state is seen.
    pub sees_state: bool,
    /// Whether parameters are seen.
    pub sees_parameters: bool,
    /// Whether bound primitives are seen.
    pub sees_primitives: bool,
    /// Whether it is in a property.
    pub in_property: bool,
    /// If it is an argument: the parameters that are not given yet.
    pub parameters: Vec<String>,
}
