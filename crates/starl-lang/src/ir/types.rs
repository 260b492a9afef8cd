//! Types, and the declarations that make them.

use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;

use super::{EnumId, RecordId, Site};

/// A type.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Type {
    /// The type of something with a reported error; it fits everywhere.
    Error,
    /// `Bool`
    Bool,
    /// `Int`
    Int,
    /// `Float`
    Float,
    /// `String`
    String,
    /// `Point`
    Point,
    /// `Time`
    Time,
    /// `Duration`
    Duration,
    /// `RobotId`
    Robot,
    /// `Area`
    Area,
    /// `Obstacles`
    Obstacles,
    /// An enum.
    Enum(EnumId),
    /// A record, a message or a tuple.
    Record(RecordId),
    /// `List[T]`
    List(Box<Self>),
    /// `Set[T]`
    Set(Box<Self>),
    /// `Map[K, V]`
    Map(Box<Self>, Box<Self>),
    /// `T?`
    Optional(Box<Self>),
    /// `a..b`; no variable has it.
    Range,
    /// Of a call that gives nothing.
    Nothing,
}

impl Type {
    /// Whether it is an enum or Bool, whose few values the checker can follow ([`crate::check::feasible`]).
    #[must_use]
    pub fn is_finite(&self) -> bool {
        matches!(self, Self::Enum(_) | Self::Bool)
    }

    /// The type with this name that every program has.
    #[must_use]
    pub fn built_in(name: &str) -> Option<Self> {
        Some(match name {
            "Bool" => Self::Bool,
            "Int" => Self::Int,
            "Float" => Self::Float,
            "String" => Self::String,
            "Point" => Self::Point,
            "Time" => Self::Time,
            "Duration" => Self::Duration,
            "RobotId" => Self::Robot,
            "Area" => Self::Area,
            "Obstacles" => Self::Obstacles,
            _ => return None,
        })
    }

    /// `List[element]`
    #[must_use]
    pub fn list(element: Self) -> Self {
        Self::List(Box::new(element))
    }

    /// `Set[element]`
    #[must_use]
    pub fn set(element: Self) -> Self {
        Self::Set(Box::new(element))
    }

    /// `Map[key, value]`
    #[must_use]
    pub fn map(key: Self, value: Self) -> Self {
        Self::Map(Box::new(key), Box::new(value))
    }

    /// `of?`; an optional type stays the same.
    #[must_use]
    pub fn optional(of: Self) -> Self {
        match of {
            Self::Optional(_) | Self::Error => of,
            _ => Self::Optional(Box::new(of)),
        }
    }

    /// Whether an error that was reported is in it.
    #[must_use]
    pub fn has_error(&self) -> bool {
        match self {
            Self::Error => true,
            Self::List(part) | Self::Set(part) | Self::Optional(part) => part.has_error(),
            Self::Map(key, value) => key.has_error() || value.has_error(),
            _ => false,
        }
    }
}

/// An enum. Its values are the numbers of its variants, from 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Enum {
    /// Its name; none of `enum {a, b}` in place of a type.
    pub name: Option<String>,
    /// The names of its variants.
    pub variants: Vec<Variant>,
    /// Where it is declared.
    pub site: Site,
    /// The comments above it.
    pub documentation: String,
}

/// A variant of an enum.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variant {
    /// Its name.
    pub name: String,
    /// Where it is named.
    pub site: Site,
}

/// A record, a message or a tuple. Tuples with parts of the same types are one record, whose fields are called by their
/// numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Record {
    /// Its name; empty for a tuple.
    pub name: String,
    /// Whether it is a message.
    pub is_message: bool,
    /// Its fields in order.
    pub fields: Vec<RecordField>,
    /// Where it is declared.
    pub site: Site,
    /// The comments above it.
    pub documentation: String,
}

impl Record {
    /// Whether it is a tuple.
    #[must_use]
    pub fn is_tuple(&self) -> bool {
        self.name.is_empty()
    }
}

/// A field of a record.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecordField {
    /// Its name.
    pub name: String,
    /// Its type.
    pub ty: Type,
    /// Where it is named.
    pub site: Site,
}
