//! Details of events by name: what traces hold, and what programs' own events are made of.

use crate::geometry::{Area, Obstacle, Point};
use crate::motion::Path;
use crate::{RobotId, time::Time};
use alloc::borrow::Cow;
use alloc::boxed::Box;
use alloc::sync::Arc;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

/// A short text that is usually known at compile time.
pub type Name = Cow<'static, str>;

/// Details of an event, by name. Most events have none: stored inline, they would make all events larger.
pub type Fields = Vec<(Name, Value)>;

/// A detail of an event.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Value {
    /// Yes or no.
    Bool(bool),
    /// A whole number.
    Int(i64),
    /// A number.
    Float(f64),
    /// A text.
    Text(Name),
    /// A moment.
    Time(Time),
    /// A place.
    Point(Point),
    /// Places in order.
    Path(Path),
    /// A robot.
    Robot(RobotId),
    /// Robots.
    Robots(Vec<RobotId>),
    /// Obstacles.
    Obstacles(Arc<[Obstacle]>),
    /// An area. By far the largest, and rare: in a box it does not make all events larger.
    Area(Box<Area>),
}

/// A [`Value`] that belongs to someone else. Serialized it is the same bytes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ValueRef<'a> {
    /// [`Value::Bool`].
    Bool(bool),
    /// [`Value::Int`].
    Int(i64),
    /// [`Value::Float`].
    Float(f64),
    /// [`Value::Text`].
    Text(&'a str),
    /// [`Value::Time`].
    Time(Time),
    /// [`Value::Point`].
    Point(Point),
    /// [`Value::Path`].
    Path(&'a [Point]),
    /// [`Value::Robot`].
    Robot(RobotId),
    /// [`Value::Robots`].
    Robots(&'a [RobotId]),
    /// [`Value::Obstacles`].
    Obstacles(&'a [Obstacle]),
    /// [`Value::Area`].
    Area(&'a Area),
}

/// The details of an event by name, in order. None of our events has more than are stored inline.
pub type ValueRefs<'a> = SmallVec<[(&'a str, ValueRef<'a>); 8]>;

impl Value {
    /// The same, borrowed.
    pub fn borrow(&self) -> ValueRef<'_> {
        match self {
            Value::Bool(value) => ValueRef::Bool(*value),
            Value::Int(value) => ValueRef::Int(*value),
            Value::Float(value) => ValueRef::Float(*value),
            Value::Text(value) => ValueRef::Text(value),
            Value::Time(value) => ValueRef::Time(*value),
            Value::Point(value) => ValueRef::Point(*value),
            Value::Path(value) => ValueRef::Path(value),
            Value::Robot(value) => ValueRef::Robot(*value),
            Value::Robots(value) => ValueRef::Robots(value),
            Value::Obstacles(value) => ValueRef::Obstacles(value),
            Value::Area(value) => ValueRef::Area(value),
        }
    }
}

impl From<ValueRef<'_>> for Value {
    fn from(value: ValueRef<'_>) -> Value {
        match value {
            ValueRef::Bool(value) => Value::Bool(value),
            ValueRef::Int(value) => Value::Int(value),
            ValueRef::Float(value) => Value::Float(value),
            ValueRef::Text(value) => Value::Text(Cow::Owned(value.into())),
            ValueRef::Time(value) => Value::Time(value),
            ValueRef::Point(value) => Value::Point(value),
            ValueRef::Path(value) => Value::Path(value.into()),
            ValueRef::Robot(value) => Value::Robot(value),
            ValueRef::Robots(value) => Value::Robots(value.into()),
            ValueRef::Obstacles(value) => Value::Obstacles(value.into()),
            ValueRef::Area(value) => Value::Area(Box::new(value.clone())),
        }
    }
}

/// The details of an event, borrowed.
pub fn borrowed(fields: &Fields) -> ValueRefs<'_> {
    let borrowed = fields.iter().map(|(name, value)| (&**name, value.borrow()));
    borrowed.collect()
}

macro_rules! value_from {
    ($($type:ty => $variant:ident),*) => {
        $(impl From<$type> for Value {
            fn from(value: $type) -> Value {
                Value::$variant(value.into())
            }
        })*
    };
}

value_from!(
    bool => Bool, i64 => Int, u32 => Int, i32 => Int, f64 => Float, &'static str => Text,
    Name => Text, Time => Time, Point => Point, Path => Path, RobotId => Robot,
    Vec<RobotId> => Robots, Arc<[Obstacle]> => Obstacles, Area => Area
);
