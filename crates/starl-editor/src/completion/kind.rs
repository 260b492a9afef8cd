//! The kind of a completion, which decides its icon.

use super::{Call, Completion};
use serde::Serialize;
use starl_lang::check::Symbol;

/// A kind, as the Language Server Protocol has them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CompletionKind {
    /// A primitive.
    Class,
    /// A constant.
    Constant,
    /// An enum.
    Enum,
    /// A variant of an enum.
    EnumMember,
    /// An action, an input or an event of a primitive.
    Event,
    /// A field, or an argument by its name.
    Field,
    /// A function.
    Function,
    /// A word of the language.
    Keyword,
    /// A method of a value or a primitive.
    Method,
    /// A library.
    Module,
    /// A flag of a primitive.
    Property,
    /// A record, a message or a built-in type.
    Struct,
    /// A variable, a parameter or a primitive that is bound to a name.
    Variable,
}

impl Completion {
    /// The kind of the completion.
    #[must_use]
    pub fn kind(&self) -> CompletionKind {
        let is_called = self.call != Call::No;
        match self.symbol {
            None if self.call == Call::Given => CompletionKind::Field,
            None if self.detail.starts_with("library ") && self.documentation.is_empty() => {
                CompletionKind::Module
            }
            None => CompletionKind::Keyword,
            Some(symbol) => match symbol {
                Symbol::Enum(_) => CompletionKind::Enum,
                Symbol::Variant(..) => CompletionKind::EnumMember,
                Symbol::Record(_) | Symbol::Type(_) => CompletionKind::Struct,
                Symbol::Field(..) | Symbol::Coordinate(_) | Symbol::RobotMember(_) => {
                    CompletionKind::Field
                }
                Symbol::Constant(_) => CompletionKind::Constant,
                Symbol::Function(_) => CompletionKind::Function,
                Symbol::Builtin(_) if is_called => CompletionKind::Function,
                Symbol::Builtin(_) => CompletionKind::Variable,
                Symbol::Method(_) => CompletionKind::Method,
                Symbol::Member(..) if is_called => CompletionKind::Method,
                Symbol::Member(..) => CompletionKind::Property,
                Symbol::Primitive(_) => CompletionKind::Class,
                Symbol::Event(..) | Symbol::Action(_) | Symbol::Input(_) => CompletionKind::Event,
                Symbol::File(_) => CompletionKind::Module,
                Symbol::Parameter(_)
                | Symbol::Variable(_)
                | Symbol::Shared(_)
                | Symbol::Binding(_)
                | Symbol::Local(_)
                | Symbol::Argument(..)
                | Symbol::Property(_) => CompletionKind::Variable,
            },
        }
    }
}
