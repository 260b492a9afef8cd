//! The meanings of names outside of bodies.

use alloc::collections::BTreeMap;
use alloc::string::String;

use crate::diagnostic::Span;
use crate::ir::{
    BindingId, ConstantId, EnumId, FunctionId, ParameterId, RecordId, SharedId, VariableId,
};

/// The meaning of a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Entity {
    Enum(EnumId),
    Record(RecordId),
    Parameter(ParameterId),
    Constant(ConstantId),
    Variable(VariableId),
    Shared(SharedId),
    Binding(BindingId),
    Function(FunctionId),
    /// An imported library, by its file.
    Library(u32),
    /// A declaration with an error, about which nothing more is reported.
    Broken,
}

impl Entity {
    /// The phrase for messages.
    pub fn what(self) -> &'static str {
        match self {
            Self::Enum(_) => "an enum",
            Self::Record(_) => "a record",
            Self::Parameter(_) => "a parameter",
            Self::Constant(_) => "a constant",
            Self::Variable(_) => "a variable",
            Self::Shared(_) => "a shared variable",
            Self::Binding(_) => "a primitive",
            Self::Function(_) => "a function",
            Self::Library(_) => "a library",
            Self::Broken => "unknown",
        }
    }
}

/// A name that a file declares.
#[derive(Clone, Copy, Debug)]
pub(super) struct Declared {
    pub entity: Entity,
    /// Where.
    pub span: Span,
}

/// The names that a file declares.
pub(super) type Scope = BTreeMap<String, Declared>;
