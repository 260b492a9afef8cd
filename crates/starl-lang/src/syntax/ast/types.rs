//! Types as they are written.

use super::super::{SyntaxKind, SyntaxToken};
use super::node::{child, children, choice, nodes, tokens};
use super::{Name, VariantList};

nodes! {
    /// `Int`, `List[Point]`, `geometry.Line`
    NamedType
    /// `[Point]`
    TypeArguments
    /// `Point?`
    OptionalType
    /// `enum {a, b}`
    EnumType
    /// `(Int, Point)`
    TupleType
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

    /// The type arguments in the brackets.
    pub fn arguments(&self) -> impl Iterator<Item = Type> + use<> {
        child::<TypeArguments>(&self.0)
            .into_iter()
            .flat_map(|arguments| arguments.types())
    }
}

impl TypeArguments {
    /// The types between the brackets.
    pub fn types(&self) -> impl Iterator<Item = Type> + use<> {
        children(&self.0)
    }
}

impl OptionalType {
    /// The type without the question mark.
    #[must_use]
    pub fn inner(&self) -> Option<Type> {
        child(&self.0)
    }
}

impl EnumType {
    /// The names of its values.
    pub fn variants(&self) -> impl Iterator<Item = Name> + use<> {
        child::<VariantList>(&self.0)
            .into_iter()
            .flat_map(|list| list.variants())
    }
}

impl TupleType {
    /// The types of its parts.
    pub fn types(&self) -> impl Iterator<Item = Type> + use<> {
        children(&self.0)
    }
}
