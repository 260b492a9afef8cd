//! Types as people write them.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::{Program, Type};

pub(super) fn type_name(program: &Program, of: &Type) -> String {
    let name = |part: &Type| type_name(program, part);
    match of {
        Type::Error => "?".into(),
        Type::Bool => "Bool".into(),
        Type::Int => "Int".into(),
        Type::Float => "Float".into(),
        Type::String => "String".into(),
        Type::Point => "Point".into(),
        Type::Time => "Time".into(),
        Type::Duration => "Duration".into(),
        Type::Robot => "RobotId".into(),
        Type::Area => "Area".into(),
        Type::Obstacles => "Obstacles".into(),
        Type::Enum(id) => program[*id].name.clone().unwrap_or_else(|| {
            let variants: Vec<&str> = (program[*id].variants.iter())
                .map(|variant| variant.name.as_str())
                .collect();
            format!("enum {{{}}}", variants.join(", "))
        }),
        Type::Record(id) => program[*id].name.to_string(),
        Type::List(element) => format!("List[{}]", name(element)),
        Type::Set(element) => format!("Set[{}]", name(element)),
        Type::Map(key, value) => format!("Map[{}, {}]", name(key), name(value)),
        Type::Optional(inner) => format!("{}?", name(inner)),
        Type::Range => "a range".into(),
        Type::Nothing => "nothing".into(),
    }
}
