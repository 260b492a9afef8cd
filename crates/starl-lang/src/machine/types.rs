//! Types of compiled programs: the layout of values in registers, and their order.
//!
//! Invariant of a loaded program: object types refer to earlier ones only, so every value is a tree
//! of limited depth.

use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};

/// The deepest that collections may be nested.
pub const DEEPEST_TYPE: u32 = 32;

/// A type of the language.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Type {
    /// True or false.
    Bool,
    /// A signed integer of 64 bits.
    Int,
    /// A number of IEEE 754, binary64.
    Float,
    /// A moment, nanoseconds since the run started.
    Time,
    /// A span of time, nanoseconds.
    Duration,
    /// A robot's number.
    Robot,
    /// The number of a variant of an enum, which is an index into the program's enums.
    Enum(u16),
    /// Three Floats, metres.
    Point,
    /// A value of the object type with this index.
    Object(u16),
    /// A value or none.
    Optional(Box<Type>),
    /// Fields in order, with their names.
    Record(Vec<(String, Type)>),
}

/// A type whose values are objects.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ObjectType {
    /// Characters.
    Text,
    /// A region.
    Area,
    /// Obstacles, as the host gives them.
    Obstacles,
    /// Elements in any order.
    List(Type),
    /// Elements once each, in ascending order.
    Set(Type),
    /// Values by key, in ascending order of the keys.
    Map(Type, Type),
}

/// How a scalar is ordered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Order {
    /// As a signed integer: everything except Floats.
    Integer,
    /// As a Float: -0.0 equals 0.0, NaN equals itself and comes last (first with its sign set).
    Float,
}

/// How a value lies in registers: its scalars, then its objects, both in the order of the text.
/// Values are ordered by their parts in the order of the text.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Layout {
    /// The order of each scalar.
    pub scalars: Vec<Order>,
    /// The type of each object.
    pub objects: Vec<u16>,
    /// For each object how many scalars are before it in the text.
    pub before: Vec<u16>,
}

/// Whether these are the fields of a tuple, which are called by their numbers.
pub fn is_tuple<T>(fields: &[(String, T)]) -> bool {
    fields.first().is_some_and(|(name, _)| name == "0")
}

impl Layout {
    /// The layout of values of these types, one after the other.
    pub fn of<'a>(types: impl IntoIterator<Item = &'a Type>) -> Layout {
        let mut layout = Layout::default();
        for part in types {
            layout.push(part);
        }
        layout
    }

    fn push(&mut self, part: &Type) {
        match part {
            Type::Float => self.scalars.push(Order::Float),
            Type::Point => self.scalars.extend([Order::Float; 3]),
            Type::Object(index) => {
                self.objects.push(*index);
                self.before.push(self.scalars.len() as u16);
            }
            Type::Optional(value) => {
                self.scalars.push(Order::Integer);
                self.push(value);
            }
            Type::Record(fields) => fields.iter().for_each(|(_, field)| self.push(field)),
            _ => self.scalars.push(Order::Integer),
        }
    }
}

/// The layouts of an object type's parts: elements of a list or set, or keys and values of a map.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Parts {
    /// An element, or a key.
    pub element: Layout,
    /// A value.
    pub value: Layout,
    /// The kind of a map's keys.
    pub keys: Keys,
}

/// Kinds of keys, which are looked up in different ways.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Keys {
    /// One whole number each.
    Numbers,
    /// One text each.
    Texts,
    /// Something else, or it is no map.
    #[default]
    Others,
}

impl Parts {
    /// The parts of an object type among all; nothing for types without parts.
    pub fn of(object: &ObjectType, all: &[ObjectType]) -> Parts {
        match object {
            ObjectType::List(element) | ObjectType::Set(element) => Parts {
                element: Layout::of([element]),
                ..Parts::default()
            },
            ObjectType::Map(key, value) => {
                let element = Layout::of([key]);
                let is_text =
                    |object: &u16| all.get(usize::from(*object)) == Some(&ObjectType::Text);
                Parts {
                    keys: match (&element.scalars[..], &element.objects[..]) {
                        ([Order::Integer], []) => Keys::Numbers,
                        ([], [object]) if is_text(object) => Keys::Texts,
                        _ => Keys::Others,
                    },
                    element,
                    value: Layout::of([value]),
                }
            }
            ObjectType::Text | ObjectType::Area | ObjectType::Obstacles => Parts::default(),
        }
    }
}

/// The bits of a Float; all NaN become one, because processors differ in the NaN they produce.
#[inline(always)]
pub(in crate::machine) fn bits(number: f64) -> u64 {
    if number.is_nan() {
        f64::NAN.to_bits()
    } else {
        number.to_bits()
    }
}
