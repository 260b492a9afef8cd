//! Types and values in words.

use crate::machine::{Bytecode, ObjectType, Type, is_tuple};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

/// A type as the language writes it: `List[Point]`; of an enum also its variants.
pub(super) fn type_name(bytecode: &Bytecode, kind: &Type) -> String {
    let name = |part: &Type| type_name(bytecode, part);
    match kind {
        Type::Robot => "RobotId".into(),
        Type::Enum(index) => match bytecode.enums.get(usize::from(*index)) {
            Some(declared) => format!("{} {{{}}}", declared.name, declared.variants.join(", ")),
            None => kind.to_string(),
        },
        Type::Optional(value) => format!("{}?", name(value)),
        Type::Record(fields) if is_tuple(fields) => {
            let parts: Vec<String> = fields.iter().map(|(_, kind)| name(kind)).collect();
            format!("({})", parts.join(", "))
        }
        Type::Record(fields) => {
            let fields = fields.iter();
            let fields: Vec<String> = fields
                .map(|(field, kind)| format!("{field}: {}", name(kind)))
                .collect();
            format!("a record ({})", fields.join(", "))
        }
        Type::Object(index) => match bytecode.types.get(usize::from(*index)) {
            Some(ObjectType::Text) => "String".into(),
            Some(ObjectType::List(element)) => format!("List[{}]", name(element)),
            Some(ObjectType::Set(element)) => format!("Set[{}]", name(element)),
            Some(ObjectType::Map(key, value)) => format!("Map[{}, {}]", name(key), name(value)),
            Some(plain) => plain.to_string(),
            None => kind.to_string(),
        },
        plain => plain.to_string(),
    }
}

/// A text of at most so many characters; a longer one is cut off, and three points show that.
pub(super) fn shortened(mut text: String, most: usize) -> String {
    if let Some((end, _)) = text.char_indices().nth(most) {
        text.truncate(end);
        text += "...";
    }
    text
}
