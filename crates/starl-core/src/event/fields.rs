//! Encodes the fields of typed events by name, and decodes them.
//!
//! Invariant: an encoded event decodes to the same event, and fields that do not decode exactly are not a typed event.

use super::{Name, Value, ValueRef, ValueRefs};
use crate::geometry::{Area, Obstacle, Point};
use crate::{Duration, RobotId, Time};
use alloc::boxed::Box;
use alloc::sync::Arc;
use alloc::vec::Vec;

/// Types of the fields of typed events.
pub trait Field: Sized {
    /// Adds the field's value; of a group of fields the values of all.
    fn show<'a>(&'a self, name: &'static str, shown: &mut ValueRefs<'a>);

    /// Reads the field; none if the next value is not such a field.
    fn read(name: &str, reader: &mut Reader<'_>) -> Option<Self>;
}

/// Reads fields in order.
pub struct Reader<'a>(pub &'a [(Name, Value)]);

impl<'a> Reader<'a> {
    /// The next field, if it is called so.
    fn next(&mut self, name: &str) -> Option<&'a Value> {
        let ((next, value), rest) = self.0.split_first()?;
        (next == name).then(|| {
            self.0 = rest;
            value
        })
    }

    /// The next field's text, if it has one and is called so.
    pub fn text(&mut self, name: &str) -> Option<&'a str> {
        match self.next(name)? {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The event, if that was all.
    pub fn end<E>(self, event: E) -> Option<E> {
        self.0.is_empty().then_some(event)
    }
}

/// A field that may be left out.
impl<F: Field> Field for Option<F> {
    fn show<'a>(&'a self, name: &'static str, shown: &mut ValueRefs<'a>) {
        if let Some(field) = self {
            field.show(name, shown);
        }
    }

    fn read(name: &str, reader: &mut Reader<'_>) -> Option<Option<F>> {
        match reader.0 {
            [(next, _), ..] if next == name => F::read(name, reader).map(Some),
            _ => Some(None),
        }
    }
}

/// Fields of one value: its type, the kind of value, how it is shown, how it is read.
macro_rules! plain {
    ($($type:ty: $variant:ident, $field:ident => $show:expr, $value:ident => $read:expr;)*) => {
        $(impl Field for $type {
            fn show<'a>(&'a self, name: &'static str, shown: &mut ValueRefs<'a>) {
                let $field = self;
                shown.push((name, ValueRef::$variant($show)));
            }

            fn read(name: &str, reader: &mut Reader<'_>) -> Option<$type> {
                match reader.next(name)? {
                    Value::$variant($value) => $read,
                    _ => None,
                }
            }
        })*
    };
}

plain! {
    bool: Bool, field => *field, value => Some(*value);
    i64: Int, field => *field, value => Some(*value);
    u32: Int, field => i64::from(*field), value => u32::try_from(*value).ok();
    // Traces have signed numbers only; these are as distinct as unsigned ones.
    u64: Int, field => *field as i64, value => Some(*value as u64);
    f64: Float, field => *field, value => Some(*value);
    Arc<str>: Text, field => field, value => Some(Arc::from(&**value));
    Time: Time, field => *field, value => Some(*value);
    Point: Point, field => *field, value => Some(*value);
    Vec<Point>: Path, field => field, value => Some(value.clone());
    RobotId: Robot, field => *field, value => Some(*value);
    Vec<RobotId>: Robots, field => field, value => Some(value.clone());
    Arc<[Obstacle]>: Obstacles, field => field, value => Some(value.clone());
    Box<Area>: Area, field => field, value => Some(value.clone());
    // Seconds.
    Duration: Float, field => field.seconds(), value => {
        let span = Duration::from_seconds_f64(*value);
        (span.seconds() == *value).then_some(span)
    };
}
