//! Values as the reference computes with them, and how they are ordered, compared and shown.

use starl_core::{Area, Duration, Point, RobotId, Time};
use starl_lang::ir::{Program, Type};
use starl_lang::machine;
use std::cmp::Ordering;

/// A value.
#[derive(Clone, Debug)]
pub enum Value {
    Bool(bool),
    Int(i64),
    Float(f64),
    Time(u64),
    Duration(u64),
    Robot(u32),
    Variant(u16),
    Point(Point),
    Text(String),
    Area(Option<Area>),
    Obstacles(starl_core::motion::Obstacles),
    Optional(Option<Box<Value>>),
    Record(Vec<Value>),
    List(Vec<Value>),
    Set(Vec<Value>),
    Map(Vec<(Value, Value)>),
}

/// Whether two values are equal; none if a number is NaN and the result is unspecified.
pub fn equal(left: &Value, right: &Value, is_part: bool) -> Option<bool> {
    use Value::*;
    let lists = |left: &[Value], right: &[Value]| -> Option<bool> {
        let mut all = left.len() == right.len();
        for (left, right) in left.iter().zip(right) {
            all &= equal(left, right, true)?;
        }
        Some(all)
    };
    Some(match (left, right) {
        (Bool(left), Bool(right)) => left == right,
        (Int(left), Int(right)) => left == right,
        (Float(left), Float(right)) if is_part && (left.is_nan() || right.is_nan()) => return None,
        (Float(left), Float(right)) => left == right,
        (Time(left), Time(right)) | (Duration(left), Duration(right)) => left == right,
        (Robot(left), Robot(right)) => left == right,
        (Variant(left), Variant(right)) => left == right,
        (Point(left), Point(right)) => {
            let has_nan = |p: &starl_core::Point| (p.x + p.y + p.z).is_nan();
            if is_part && (has_nan(left) || has_nan(right)) {
                return None;
            }
            left.x == right.x && left.y == right.y && left.z == right.z
        }
        (Text(left), Text(right)) => left == right,
        // Areas and obstacles are as they are made.
        (Area(left), Area(right)) => left == right,
        (Obstacles(left), Obstacles(right)) => left == right,
        (Optional(left), Optional(right)) => match (left, right) {
            (Some(left), Some(right)) => equal(left, right, true)?,
            (None, None) => true,
            _ => false,
        },
        (Record(left), Record(right)) | (List(left), List(right)) | (Set(left), Set(right)) => {
            lists(left, right)?
        }
        (Map(left), Map(right)) => {
            let keys =
                |of: &[(Value, Value)]| of.iter().map(|(key, _)| key.clone()).collect::<Vec<_>>();
            let values =
                |of: &[(Value, Value)]| of.iter().map(|(_, v)| v.clone()).collect::<Vec<_>>();
            lists(&keys(left), &keys(right))? & lists(&values(left), &values(right))?
        }
        _ => panic!("{left:?} is compared with {right:?}"),
    })
}

/// Of how many parts a value is made.
pub fn weight(value: &Value) -> usize {
    let all = |values: &[Value]| values.iter().map(weight).sum::<usize>();
    1 + match value {
        Value::Text(text) => text.len() / 8,
        Value::Optional(Some(value)) => weight(value),
        Value::Record(values) | Value::List(values) | Value::Set(values) => all(values),
        Value::Map(entries) => entries.iter().map(|(k, v)| weight(k) + weight(v)).sum(),
        _ => 0,
    }
}

/// A number or a text in a value.
enum Part<'a> {
    Int(i64),
    Float(f64),
    Text(&'a str),
}

impl Value {
    /// The numbers and the texts of what can be a key or sorted, in the order of the text.
    fn parts<'a>(&'a self, parts: &mut Vec<Part<'a>>) {
        match self {
            Value::Bool(value) => parts.push(Part::Int(i64::from(*value))),
            Value::Int(value) => parts.push(Part::Int(*value)),
            Value::Float(value) => parts.push(Part::Float(*value)),
            Value::Time(value) | Value::Duration(value) => parts.push(Part::Int(*value as i64)),
            Value::Robot(value) => parts.push(Part::Int(i64::from(*value))),
            Value::Variant(value) => parts.push(Part::Int(i64::from(*value))),
            Value::Point(p) => parts.extend([p.x, p.y, p.z].map(Part::Float)),
            Value::Text(text) => parts.push(Part::Text(text)),
            Value::Record(fields) => fields.iter().for_each(|field| field.parts(parts)),
            _ => panic!("{self:?} is no key"),
        }
    }
}

/// The order of keys and sorted values: the first parts that differ decide.
pub fn order(left: &Value, right: &Value) -> Ordering {
    let (mut parts, mut others) = (Vec::new(), Vec::new());
    left.parts(&mut parts);
    right.parts(&mut others);
    let orders = parts.iter().zip(&others).map(|parts| match parts {
        (Part::Int(left), Part::Int(right)) => left.cmp(right),
        // A zero has no sign here.
        (Part::Float(left), Part::Float(right)) => (left + 0.0).total_cmp(&(right + 0.0)),
        (Part::Text(left), Part::Text(right)) => left.cmp(right),
        _ => panic!("keys of two types"),
    });
    orders
        .into_iter()
        .find(|order| order.is_ne())
        .unwrap_or(Ordering::Equal)
}

/// The order that `<` and its like compare by; none if NaN decides.
pub fn comparison(left: &Value, right: &Value) -> Option<Ordering> {
    match (left, right) {
        (Value::Float(left), Value::Float(right)) => left.partial_cmp(right),
        (Value::Record(left), Value::Record(right)) => {
            let orders = left.iter().zip(right).map(|(l, r)| comparison(l, r));
            let mut different = orders.filter(|order| *order != Some(Ordering::Equal));
            different.next().unwrap_or(Some(Ordering::Equal))
        }
        _ => Some(order(left, right)),
    }
}

/// The value that a variable of the type has if none is given.
pub fn default(program: &Program, ty: &Type) -> Value {
    match ty {
        Type::Bool => Value::Bool(false),
        Type::Int => Value::Int(0),
        Type::Float => Value::Float(0.0),
        Type::Time => Value::Time(0),
        Type::Duration => Value::Duration(0),
        Type::Robot => Value::Robot(0),
        Type::Enum(_) => Value::Variant(0),
        Type::Point => Value::Point(Point::new(0.0, 0.0, 0.0)),
        Type::String => Value::Text(String::new()),
        Type::Area => Value::Area(None),
        Type::Obstacles => Value::Obstacles([].into()),
        Type::Optional(_) => Value::Optional(None),
        Type::List(_) => Value::List(Vec::new()),
        Type::Set(_) => Value::Set(Vec::new()),
        Type::Map(..) => Value::Map(Vec::new()),
        Type::Record(id) => {
            let fields = program[*id].fields.iter();
            Value::Record(fields.map(|field| default(program, &field.ty)).collect())
        }
        Type::Error | Type::Range | Type::Nothing => panic!("no value"),
    }
}

/// The value as others see it.
pub fn shown(program: &Program, ty: &Type, value: &Value) -> machine::Value {
    use machine::Value as Shown;
    let list = |of: &Type, values: &[Value]| -> Vec<Shown> {
        values
            .iter()
            .map(|value| shown(program, of, value))
            .collect()
    };
    match (value, ty) {
        (Value::Bool(value), _) => Shown::Bool(*value),
        (Value::Int(value), _) => Shown::Int(*value),
        (Value::Float(value), _) => Shown::Float(*value),
        (Value::Time(value), _) => Shown::Time(Time(*value)),
        (Value::Duration(value), _) => Shown::Duration(Duration(*value)),
        (Value::Robot(value), _) => Shown::Robot(RobotId(*value)),
        (Value::Point(value), _) => Shown::Point(*value),
        (Value::Text(value), _) => Shown::Text(value.clone()),
        (Value::Area(value), _) => Shown::Area(value.clone()),
        (Value::Obstacles(value), _) => Shown::Obstacles(value.clone()),
        (Value::Optional(None), _) => Shown::None,
        (Value::Variant(number), Type::Enum(id)) => {
            Shown::Variant(program[*id].variants[usize::from(*number)].name.clone())
        }
        (Value::Optional(Some(value)), Type::Optional(inner)) => {
            Shown::Some(Box::new(shown(program, inner, value)))
        }
        (Value::Record(values), Type::Record(id)) => {
            let fields = program[*id].fields.iter().zip(values);
            let shown =
                fields.map(|(field, value)| (field.name.clone(), shown(program, &field.ty, value)));
            Shown::Record(shown.collect())
        }
        (Value::List(values), Type::List(of)) => Shown::List(list(of, values)),
        (Value::Set(values), Type::Set(of)) => Shown::Set(list(of, values)),
        (Value::Map(entries), Type::Map(key, of)) => {
            let entries = entries.iter();
            let entries = entries.map(|(k, v)| (shown(program, key, k), shown(program, of, v)));
            Shown::Map(entries.collect())
        }
        _ => panic!("{value:?} is no {ty:?}"),
    }
}

/// The value that others gave.
pub fn read(program: &Program, ty: &Type, given: &machine::Value) -> Value {
    use machine::Value as Given;
    let list = |of: &Type, values: &[Given]| -> Vec<Value> {
        values
            .iter()
            .map(|value| read(program, of, value))
            .collect()
    };
    match (given, ty) {
        (Given::Bool(value), _) => Value::Bool(*value),
        (Given::Int(value), _) => Value::Int(*value),
        (Given::Float(value), _) => Value::Float(*value),
        (Given::Time(value), _) => Value::Time(value.0),
        (Given::Duration(value), _) => Value::Duration(value.0),
        (Given::Robot(value), _) => Value::Robot(value.0),
        (Given::Point(value), _) => Value::Point(*value),
        (Given::Text(value), _) => Value::Text(value.clone()),
        (Given::Area(value), _) => Value::Area(value.clone()),
        (Given::Obstacles(value), _) => Value::Obstacles(value.clone()),
        (Given::None, _) => Value::Optional(None),
        (Given::Variant(name), Type::Enum(id)) => {
            let mut variants = program[*id].variants.iter();
            let number = variants.position(|variant| variant.name == *name);
            Value::Variant(number.expect("a variant of the enum") as u16)
        }
        (Given::Some(value), Type::Optional(inner)) => {
            Value::Optional(Some(Box::new(read(program, inner, value))))
        }
        (Given::Record(values), Type::Record(id)) => {
            let fields = program[*id].fields.iter().zip(values);
            Value::Record(
                fields
                    .map(|(field, (_, value))| read(program, &field.ty, value))
                    .collect(),
            )
        }
        (Given::List(values), Type::List(of)) => Value::List(list(of, values)),
        // A property goes over all robots, in whatever form the host lists them.
        (Given::Set(values), Type::List(of)) => Value::List(list(of, values)),
        (Given::Set(values), Type::Set(of)) => Value::Set(set(list(of, values))),
        (Given::Map(entries), Type::Map(key, of)) => {
            let mut map = Vec::new();
            for (k, v) in entries {
                put(&mut map, read(program, key, k), read(program, of, v));
            }
            Value::Map(map)
        }
        _ => panic!("{given:?} is no {ty:?}"),
    }
}

/// The elements once each, in their order; of equal ones the first is kept.
pub fn set(elements: Vec<Value>) -> Vec<Value> {
    let mut set: Vec<Value> = Vec::new();
    for element in elements {
        add(&mut set, element);
    }
    set
}

/// Adds an element to a set if it is not there.
pub fn add(set: &mut Vec<Value>, element: Value) {
    if let Err(at) = set.binary_search_by(|other| order(other, &element)) {
        set.insert(at, element);
    }
}

/// Sets the value of a key.
pub fn put(map: &mut Vec<(Value, Value)>, key: Value, value: Value) {
    match map.binary_search_by(|(other, _)| order(other, &key)) {
        Ok(at) => map[at].1 = value,
        Err(at) => map.insert(at, (key, value)),
    }
}

/// Where a key is.
pub fn find(map: &[(Value, Value)], key: &Value) -> Option<usize> {
    map.binary_search_by(|(other, _)| order(other, key)).ok()
}

/// The text of a value: a text is itself, and an optional is the text of its value.
pub fn text(program: &Program, ty: &Type, value: &Value) -> String {
    match (value, ty) {
        (Value::Text(text), _) => text.clone(),
        (Value::Optional(Some(value)), Type::Optional(inner)) => text(program, inner, value),
        _ => shown(program, ty, value).to_string(),
    }
}
