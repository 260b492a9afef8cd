//! Signatures of the tables, met with the types of a program.

use alloc::collections::BTreeMap;

use super::prelude;
use super::scope::Entity;
use super::state::Checker;
use super::tables::Shape;
use crate::ir::Type;

/// The types bound to the letters of a signature.
pub(super) type Letters = BTreeMap<u8, Type>;

impl Checker {
    /// The type of a shape; none while a letter is unbound, and for `Any` and `Message`.
    pub fn shape_type(&self, shape: &Shape, letters: &Letters) -> Option<Type> {
        let part = |part: &Shape| self.shape_type(part, letters);
        Some(match shape {
            Shape::Nothing => Type::Nothing,
            Shape::Any | Shape::Message => return None,
            Shape::Letter(letter) => letters.get(letter)?.clone(),
            Shape::Model => Type::String,
            Shape::Named(name) => Type::built_in(name).or_else(|| self.prelude_type(name))?,
            Shape::List(element) => Type::list(part(element)?),
            Shape::Set(element) => Type::set(part(element)?),
            Shape::Map(key, value) => Type::map(part(key)?, part(value)?),
            Shape::Optional(inner) => Type::optional(part(inner)?),
        })
    }

    /// Whether a type matches the shape; binds the letters if it does.
    pub fn shape_matches(&self, shape: &Shape, of: &Type, letters: &mut Letters) -> bool {
        match (shape, of) {
            (_, Type::Error) => true,
            (Shape::Any, _) => !matches!(of, Type::Nothing | Type::Range),
            (Shape::Message, Type::Record(record)) => self.program[*record].is_message,
            (Shape::Letter(letter), _) => match letters.get(letter) {
                Some(known) => super::fit::same(known, of),
                None => {
                    letters.insert(*letter, of.clone());
                    self.letter_allows(*letter, of)
                }
            },
            (Shape::List(part), Type::List(of))
            | (Shape::Set(part), Type::Set(of))
            | (Shape::Optional(part), Type::Optional(of)) => self.shape_matches(part, of, letters),
            (Shape::Map(key, value), Type::Map(k, v)) => {
                self.shape_matches(key, k, letters) && self.shape_matches(value, v, letters)
            }
            _ => self
                .shape_type(shape, letters)
                .is_some_and(|known| known == *of),
        }
    }

    fn prelude_type(&self, name: &str) -> Option<Type> {
        match self.declared(prelude::FILE, name)? {
            Entity::Enum(id) => Some(Type::Enum(id)),
            Entity::Record(id) => Some(Type::Record(id)),
            _ => None,
        }
    }

    /// The text of a shape for messages, with the bound letters.
    pub fn shape_name(&self, shape: &Shape, letters: &Letters) -> alloc::string::String {
        use alloc::format;
        if let Some(known) = self.shape_type(shape, letters) {
            return self.name_of(&known);
        }
        let part = |part: &Shape| self.shape_name(part, letters);
        match shape {
            Shape::Letter(b'N') => "Int or Float".into(),
            Shape::Letter(b'M') => "Int, Float, Duration, Time or a tuple that `<` compares".into(),
            Shape::Letter(b'F') => "Float or RobotId".into(),
            Shape::Letter(b'O') => "what `<` compares".into(),
            Shape::Message => "a message".into(),
            Shape::List(element) => format!("List[{}]", part(element)),
            Shape::Set(element) => format!("Set[{}]", part(element)),
            Shape::Map(key, value) => format!("Map[{}, {}]", part(key), part(value)),
            Shape::Optional(inner) => format!("{}?", part(inner)),
            _ => "a value".into(),
        }
    }

    fn letter_allows(&self, letter: u8, of: &Type) -> bool {
        match letter {
            b'N' => matches!(of, Type::Int | Type::Float),
            b'M' => match of {
                Type::Record(_) => self.program.is_ordered(of),
                _ => matches!(of, Type::Int | Type::Float | Type::Duration | Type::Time),
            },
            b'O' => self.program.is_ordered(of),
            b'F' => matches!(of, Type::Float | Type::Robot),
            _ => !matches!(of, Type::Nothing | Type::Range),
        }
    }
}
