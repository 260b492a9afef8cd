//! Types that a program makes: enums, records and messages.

use super::node::nodes;
use super::{Name, Type};

nodes! {
    /// `enum Name {a, b}`
    EnumDeclaration {
        /// The names of its values.
        variants: [Name] in VariantList,
    }
    /// `{a, b}`, the values of an enum
    VariantList
    /// `record Name {x: Int}`
    RecordDeclaration {
        /// Its fields.
        fields: [Field] in FieldList,
    }
    /// `message Name(x: Int)`
    MessageDeclaration {
        /// Its fields.
        fields: [Field] in FieldList,
    }
    /// The fields of a record or a message
    FieldList
    /// `x: Int` in a record or a message
    Field {
        /// Its type, if that is written.
        ty: Type,
    }
}
