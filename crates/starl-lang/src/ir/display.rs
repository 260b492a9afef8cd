//! Types as people write them.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::{Program, Type};

/// Tuples are written as far as this depth: one may hold lists of others over and over, and its whole name be endless.
const DEEPEST: u32 = 8;

pub(super) fn type_name(program: &Program, of: &Type) -> String {
    written(program, of, DEEPEST)
}

fn written(program: &Program, of: &Type, depth: u32) -> String {
    let name = |part: &Type| written(program, part, depth);
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
        Type::Record(id) if !program[*id].is_tuple() => program[*id].name.to_string(),
        Type::Record(_) if depth == 0 => "(...)".into(),
        Type::Record(id) => {
            let parts = program[*id].fields.iter();
            let parts: Vec<String> = parts
                .map(|part| written(program, &part.ty, depth - 1))
                .collect();
            format!("({})", parts.join(", "))
        }
        Type::List(element) => format!("List[{}]", name(element)),
        Type::Set(element) => format!("Set[{}]", name(element)),
        Type::Map(key, value) => format!("Map[{}, {}]", name(key), name(value)),
        Type::Optional(inner) => format!("{}?", name(inner)),
        Type::Range => "a range".into(),
        Type::Nothing => "nothing".into(),
    }
}
