//! Values as a tree with names, for hosts that show, record or send them.

use crate::machine::program::Program;
use crate::machine::types::{Layout, ObjectType, Type, is_tuple};
use crate::machine::value::object::{Block, Body, List, Map, Object};
use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;
use serde::{Deserialize, Serialize};
use starl_core::{Area, Duration, Point, RobotId, Time};

/// A value of the language.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Value {
    /// True or false.
    Bool(bool),
    /// An integer.
    Int(i64),
    /// A number.
    Float(f64),
    /// A moment.
    Time(Time),
    /// A span of time.
    Duration(Duration),
    /// A robot.
    Robot(RobotId),
    /// A variant of an enum, by name.
    Variant(String),
    /// A point, metres.
    Point(Point),
    /// No value, of an optional type.
    None,
    /// A value of an optional type.
    Some(Box<Value>),
    /// Fields in order.
    Record(Vec<(String, Value)>),
    /// Characters.
    Text(String),
    /// Elements of a list.
    List(Vec<Value>),
    /// Elements of a set, ascending.
    Set(Vec<Value>),
    /// Entries of a map, by ascending key.
    Map(Vec<(Value, Value)>),
    /// A region; none if the variable was never assigned.
    Area(Option<Area>),
    /// Obstacles.
    Obstacles(starl_core::motion::Obstacles),
}

/// The registers that have not been read yet.
struct Reader<'a> {
    program: &'a Program,
    scalars: core::slice::Iter<'a, u64>,
    objects: core::slice::Iter<'a, Object>,
}

impl Value {
    /// The value in these scalars and objects; none if there are too few of them, or they are not a value of that type.
    pub fn read(
        program: &Program,
        kind: &Type,
        scalars: &[u64],
        objects: &[Object],
    ) -> Option<Value> {
        let mut reader = Reader {
            program,
            scalars: scalars.iter(),
            objects: objects.iter(),
        };
        reader.value(kind)
    }

    /// The values of these types that lie one after the other in scalars and objects: arguments of a
    /// call, fields of a message, variables of a state.
    pub fn read_all<'a>(
        program: &Program,
        kinds: impl IntoIterator<Item = &'a Type>,
        scalars: &[u64],
        objects: &[Object],
    ) -> Option<Vec<Value>> {
        let mut reader = Reader {
            program,
            scalars: scalars.iter(),
            objects: objects.iter(),
        };
        kinds.into_iter().map(|kind| reader.value(kind)).collect()
    }

    /// Puts the value, which must be of this type, at the end of scalars and objects; false if it is
    /// of another type.
    #[must_use]
    pub fn write(
        &self,
        program: &Program,
        kind: &Type,
        scalars: &mut Vec<u64>,
        objects: &mut Vec<Object>,
    ) -> bool {
        let scalar = match (self, kind) {
            (Value::Bool(value), Type::Bool) => u64::from(*value),
            (Value::Int(value), Type::Int) => *value as u64,
            (Value::Float(value), Type::Float) => crate::machine::types::bits(*value),
            (Value::Time(value), Type::Time) => value.0.min(i64::MAX as u64),
            (Value::Duration(value), Type::Duration) => value.0.min(i64::MAX as u64),
            (Value::Robot(value), Type::Robot) => u64::from(value.0),
            (Value::Variant(name), Type::Enum(index)) => {
                let declared = program.bytecode.enums.get(usize::from(*index));
                match declared.and_then(|d| d.variants.iter().position(|v| v == name)) {
                    Some(number) => number as u64,
                    None => return false,
                }
            }
            (Value::Point(value), Type::Point) => {
                scalars.extend([value.x, value.y, value.z].map(crate::machine::types::bits));
                return true;
            }
            (Value::None, Type::Optional(_)) => {
                let layout = Layout::of([kind]);
                scalars.extend(layout.scalars.iter().map(|_| 0));
                objects.extend(layout.objects.iter().map(|_| Object::EMPTY));
                return true;
            }
            (Value::Some(value), Type::Optional(kind)) => {
                scalars.push(1);
                return value.write(program, kind, scalars, objects);
            }
            (Value::Record(values), Type::Record(kinds)) => {
                let mut fields = values.iter().zip(kinds);
                return values.len() == kinds.len()
                    && fields.all(|((name, value), (field, kind))| {
                        name == field && value.write(program, kind, scalars, objects)
                    });
            }
            (value, Type::Object(index)) => {
                let Some(object) = value.object(program, *index) else {
                    return false;
                };
                objects.push(object);
                return true;
            }
            _ => return false,
        };
        scalars.push(scalar);
        true
    }

    fn object(&self, program: &Program, index: u16) -> Option<Object> {
        let kind = program.bytecode.types.get(usize::from(index))?;
        let parts = program.parts.get(usize::from(index))?;
        let (keys, types) = (&parts.element, &program.parts);
        Some(match (self, kind) {
            (Value::Text(text), ObjectType::Text) => text.as_str().into(),
            (Value::Area(area), ObjectType::Area) => match area {
                Some(area) => area.clone().into(),
                None => Object::EMPTY,
            },
            (Value::Obstacles(obstacles), ObjectType::Obstacles) => obstacles.clone().into(),
            (Value::List(values), ObjectType::List(element)) => {
                list(program, values.iter(), element)?.into()
            }
            (Value::Set(values), ObjectType::Set(element)) => {
                let list = list(program, values.iter(), element)?;
                list.sorted(keys, types).deduplicated(keys, types).into()
            }
            (Value::Map(entries), ObjectType::Map(key, value)) => {
                let unsorted = list(program, entries.iter().map(|(key, _)| key), key)?;
                let values = list(program, entries.iter().map(|(_, value)| value), value)?;
                let order = unsorted.order(keys, types);
                let sorted = unsorted.arranged(order.iter().copied());
                if sorted.deduplicated(keys, types).len() < sorted.len() {
                    return None; // a key is there twice
                }
                let values = values.arranged(order.into_iter());
                Body::Map(Map::new(&sorted, &values)).into()
            }
            _ => return None,
        })
    }
}

fn list<'a>(
    program: &Program,
    values: impl Iterator<Item = &'a Value>,
    kind: &Type,
) -> Option<List> {
    let mut list = List::new(&Layout::of([kind]));
    for value in values {
        let (mut scalars, mut objects) = (Vec::new(), Vec::new());
        if !value.write(program, kind, &mut scalars, &mut objects) {
            return None;
        }
        let block = Block {
            scalars: &scalars,
            objects: &objects,
        };
        if !list.push(block) {
            return None;
        }
    }
    Some(list)
}

impl Reader<'_> {
    fn value(&mut self, kind: &Type) -> Option<Value> {
        Some(match kind {
            Type::Bool => Value::Bool(self.scalar()? != 0),
            Type::Int => Value::Int(self.scalar()? as i64),
            Type::Float => Value::Float(self.float()?),
            Type::Time => Value::Time(Time(self.scalar()?)),
            Type::Duration => Value::Duration(Duration(self.scalar()?)),
            Type::Robot => Value::Robot(RobotId(self.scalar()? as u32)),
            Type::Enum(index) => {
                let declared = self.program.bytecode.enums.get(usize::from(*index))?;
                let number = usize::try_from(self.scalar()?).ok()?;
                Value::Variant(declared.variants.get(number)?.clone())
            }
            Type::Point => Value::Point(Point::new(self.float()?, self.float()?, self.float()?)),
            Type::Optional(value) => {
                let present = self.scalar()? != 0;
                if present {
                    Value::Some(Box::new(self.value(value)?))
                } else {
                    let layout = Layout::of([&**value]);
                    layout
                        .scalars
                        .iter()
                        .try_for_each(|_| self.scalar().map(|_| ()))?;
                    layout
                        .objects
                        .iter()
                        .try_for_each(|_| self.objects.next().map(|_| ()))?;
                    Value::None
                }
            }
            Type::Record(fields) => {
                let fields = fields.iter();
                let values = fields.map(|(name, kind)| Some((name.clone(), self.value(kind)?)));
                Value::Record(values.collect::<Option<_>>()?)
            }
            Type::Object(index) => {
                let kind = self.program.bytecode.types.get(usize::from(*index))?;
                self.object(kind)?
            }
        })
    }

    fn object(&mut self, kind: &ObjectType) -> Option<Value> {
        let object = self.objects.next()?;
        Some(match kind {
            ObjectType::Text => Value::Text(object.text().into()),
            ObjectType::Area => Value::Area(object.area().cloned()),
            ObjectType::Obstacles => Value::Obstacles(match object.body() {
                Some(Body::Obstacles(obstacles)) => obstacles.clone(),
                _ => [].into(),
            }),
            ObjectType::List(element) => Value::List(self.elements(object, element)?),
            ObjectType::Set(element) => Value::Set(self.elements(object, element)?),
            ObjectType::Map(key, value) => {
                let entries = object.map().into_iter().flat_map(Map::iter);
                let read =
                    |[k, v]: [Block<'_>; 2]| Some((self.block(k, key)?, self.block(v, value)?));
                Value::Map(entries.map(read).collect::<Option<_>>()?)
            }
        })
    }

    fn elements(&self, object: &Object, kind: &Type) -> Option<Vec<Value>> {
        let Some(list) = object.list() else {
            return Some(Vec::new());
        };
        list.iter().map(|block| self.block(block, kind)).collect()
    }

    fn block(&self, block: Block<'_>, kind: &Type) -> Option<Value> {
        Value::read(self.program, kind, block.scalars, block.objects)
    }

    fn scalar(&mut self) -> Option<u64> {
        self.scalars.next().copied()
    }

    fn float(&mut self) -> Option<f64> {
        self.scalar().map(f64::from_bits)
    }
}

/// As it would be written in a program.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Bool(value) => write!(f, "{value}"),
            Value::Int(value) => write!(f, "{value}"),
            Value::Float(value) => write!(f, "{value:?}"),
            Value::Time(value) => write!(f, "{value}"),
            Value::Duration(value) => write!(f, "{value}"),
            Value::Robot(robot) => write!(f, "robot{}", robot.0),
            Value::Variant(name) => f.write_str(name),
            Value::Point(p) => write!(f, "({:?}, {:?}, {:?})", p.x, p.y, p.z),
            Value::None => f.write_str("none"),
            Value::Some(value) => write!(f, "{value}"),
            Value::Text(text) => write!(f, "{text:?}"),
            Value::Record(fields) if is_tuple(fields) => {
                join(f, ["(", ")"], fields.iter(), |f, (_, v)| write!(f, "{v}"))
            }
            Value::Record(fields) => {
                let fields = fields.iter();
                join(f, ["(", ")"], fields, |f, (name, value)| {
                    write!(f, "{name} = {value}")
                })
            }
            Value::List(values) => join(f, ["[", "]"], values.iter(), |f, v| write!(f, "{v}")),
            Value::Set(values) => join(f, ["{", "}"], values.iter(), |f, v| write!(f, "{v}")),
            Value::Map(entries) if entries.is_empty() => f.write_str("{:}"),
            Value::Map(entries) => {
                let entries = entries.iter();
                join(f, ["{", "}"], entries, |f, (key, value)| {
                    write!(f, "{key}: {value}")
                })
            }
            Value::Area(area) => write!(f, "{area:?}"),
            Value::Obstacles(obstacles) => write!(f, "{} obstacles", obstacles.len()),
        }
    }
}

fn join<T>(
    f: &mut fmt::Formatter<'_>,
    [open, close]: [&str; 2],
    parts: impl Iterator<Item = T>,
    write: impl Fn(&mut fmt::Formatter<'_>, T) -> fmt::Result,
) -> fmt::Result {
    f.write_str(open)?;
    for (index, part) in parts.enumerate() {
        if index > 0 {
            f.write_str(", ")?;
        }
        write(f, part)?;
    }
    f.write_str(close)
}
