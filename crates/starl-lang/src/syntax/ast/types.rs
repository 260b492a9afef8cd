//! Types as they are written.

use super::super::{SyntaxKind, SyntaxToken};
use super::node::{choice, nodes, tokens};
use super::{Name, VariantList};

nodes! {
    /// `Int`, `List[Point]`, `geometry.Line`
    NamedType {
        /// The type arguments in the brackets.
        arguments: [Type] in TypeArguments,
    }
    /// `[Point]`
    TypeArguments {
        /// The types between the brackets.
        types: [Type],
    }
    /// `Point?`
    OptionalType {
        /// The type without the question mark.
        inner: Type,
    }
    /// `enum {a, b}`
    EnumType {
        /// The names of its values.
        variants: [Name] in VariantList,
    }
    /// `(Int, Point)`
    TupleType {
        /// The types of its parts.
        types: [Type],
    }
}

choice! {
    /// A type.
    Type {
        /// `Int`, `List[Point]`, `geometry.Line`
        Named(NamedType),
        /// `Point?`
        Optional(OptionalType),
        /// `enum {a, b}`
        Enum(EnumType),
        /// `(Int, Point)`
        Tuple(TupleType),
    }
}

impl NamedType {
    /// The words: the name, with the library's name before it if that is written.
    pub fn words(&self) -> impl Iterator<Item = SyntaxToken> + use<> {
        tokens(&self.0).filter(|token| token.kind() == SyntaxKind::Identifier)
    }
}
