//! Types that a program makes: enums, records and messages.

use super::node::{child, children, nodes};
use super::{Name, Type};

nodes! {
    /// `enum Name {a, b}`
    EnumDeclaration
    /// `{a, b}`, the values of an enum
    VariantList
    /// `record Name {x: Int}`
    RecordDeclaration
    /// `message Name(x: Int)`
    MessageDeclaration
    /// The fields of a record or a message
    FieldList
    /// `x: Int` in a record or a message
    Field
}

impl EnumDeclaration {
    /// The names of its values.
    pub fn variants(&self) -> impl Iterator<Item = Name> + use<> {
        child::<VariantList>(&self.0)
            .into_iter()
            .flat_map(|list| list.variants())
    }
}

impl VariantList {
    /// The names.
    pub fn variants(&self) -> impl Iterator<Item = Name> + use<> {
        children(&self.0)
    }
}

impl RecordDeclaration {
    /// Its fields.
    pub fn fields(&self) -> impl Iterator<Item = Field> + use<> {
        child::<FieldList>(&self.0)
            .into_iter()
            .flat_map(|list| children(&list.0))
    }
}

impl MessageDeclaration {
    /// Its fields.
    pub fn fields(&self) -> impl Iterator<Item = Field> + use<> {
        child::<FieldList>(&self.0)
            .into_iter()
            .flat_map(|list| children(&list.0))
    }
}

impl Field {
    /// Its type, if that is written.
    #[must_use]
    pub fn ty(&self) -> Option<Type> {
        child(&self.0)
    }
}
