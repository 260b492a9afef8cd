//! Pure built-in functions, and methods.

use super::operator::settled;
use super::value::{Value, equal, find, order, set};
use super::{Outcome, Stop};
use starl_core::{Area, ConvexPolygon, Point, math};
use starl_lang::check::{Builtin, Method};
use starl_lang::machine::Fault;
use std::cmp::Ordering;

/// The result of a pure function. Omitted arguments are none.
pub fn pure(builtin: Builtin, arguments: Vec<Option<Value>>) -> Outcome<Value> {
    use Value::{Float, Int};
    let mut given = arguments.into_iter();
    let (first, second, third) = (
        given.next().flatten(),
        given.next().flatten(),
        given.next().flatten(),
    );
    let value = match (builtin, first, second, third) {
        (Builtin::Pi, ..) => Float(std::f64::consts::PI),
        (Builtin::Abs, Some(Int(value)), ..) => {
            Int(value.checked_abs().ok_or(Stop::Fault(Fault::Overflow))?)
        }
        (Builtin::Abs, Some(Float(value)), ..) => Float(value.abs()),
        (Builtin::Min, Some(left), Some(right), _) => lesser(left, right)?,
        (Builtin::Max, Some(left), Some(right), _) => greater(left, right)?,
        (Builtin::Clamp, Some(value), Some(low), Some(high)) => lesser(greater(value, low)?, high)?,
        (Builtin::ToFloat, Some(Int(value)), ..) => Float(value as f64),
        (Builtin::ToInt, Some(Float(value)), ..) => whole(value)?,
        (Builtin::ToInt, Some(Value::Robot(number)), ..) => Int(i64::from(number)),
        (Builtin::Round, Some(Float(value)), ..) => whole(math::round(value))?,
        (Builtin::Floor, Some(Float(value)), ..) => whole(math::floor(value))?,
        (Builtin::Ceil, Some(Float(value)), ..) => whole(math::ceil(value))?,
        (Builtin::Sqrt, Some(Float(value)), ..) => Float(math::sqrt(value)),
        (Builtin::Sin, Some(Float(value)), ..) => Float(math::sin(value)),
        (Builtin::Cos, Some(Float(value)), ..) => Float(math::cos(value)),
        (Builtin::Tan, Some(Float(value)), ..) => Float(math::tan(value)),
        (Builtin::Exp, Some(Float(value)), ..) => Float(math::exp(value)),
        (Builtin::LogE, Some(Float(value)), ..) => Float(math::log(value)),
        (Builtin::Atan2, Some(Float(y)), Some(Float(x)), _) => Float(math::atan2(y, x)),
        (Builtin::Pow, Some(Float(base)), Some(Float(by)), _) => Float(math::pow(base, by)),
        (Builtin::MakePoint, Some(Float(x)), Some(Float(y)), z) => {
            let z = match z {
                Some(Float(z)) => z,
                _ => 0.0,
            };
            Value::Point(Point::new(x, y, z))
        }
        (Builtin::Distance, Some(Value::Point(a)), Some(Value::Point(b)), _) => {
            Float(a.distance(b))
        }
        (Builtin::Bearing, Some(Value::Point(a)), Some(Value::Point(b)), _) => {
            Float(math::atan2(b.y - a.y, b.x - a.x))
        }
        (Builtin::Circle, Some(Value::Point(center)), Some(Float(radius)), _) => {
            let area = Area::Circle { center, radius };
            if !area.is_valid() {
                return Err(Stop::Fault(Fault::ConversionOutOfRange));
            }
            Value::Area(Some(area))
        }
        (Builtin::Polygon, Some(Value::List(corners)), ..) => {
            let corners: Vec<Point> = (corners.iter())
                .map(|corner| match corner {
                    Value::Point(point) => *point,
                    _ => panic!("a corner is a point"),
                })
                .collect();
            let polygon = ConvexPolygon::new(&corners);
            let polygon = polygon.map_err(|_| Stop::Fault(Fault::ConversionOutOfRange))?;
            Value::Area(Some(Area::Polygon(polygon)))
        }
        (builtin, first, second, _) => panic!("{builtin:?} of {first:?} and {second:?}"),
    };
    Ok(match value {
        Float(number) => Float(settled(number)),
        value => value,
    })
}

/// If one is NaN, the other; if both are zero, either.
fn chosen(left: Value, right: Value, wanted: Ordering) -> Outcome<Value> {
    if let (Value::Float(l), Value::Float(r)) = (&left, &right) {
        if l.is_nan() || r.is_nan() {
            return Ok(if l.is_nan() { right } else { left });
        }
        if *l == 0.0 && *r == 0.0 && l.is_sign_negative() != r.is_sign_negative() {
            // The lesser is the one with its sign.
            let is_left = l.is_sign_negative() == (wanted == Ordering::Less);
            return Ok(if is_left { left } else { right });
        }
    }
    Ok(if order(&left, &right) == wanted {
        left
    } else {
        right
    })
}

fn lesser(left: Value, right: Value) -> Outcome<Value> {
    chosen(left, right, Ordering::Less)
}

fn greater(left: Value, right: Value) -> Outcome<Value> {
    chosen(left, right, Ordering::Greater)
}

fn whole(value: f64) -> Outcome<Value> {
    let fits = (-9_223_372_036_854_775_808.0..9_223_372_036_854_775_808.0).contains(&value);
    match fits {
        true => Ok(Value::Int(value as i64)),
        false => Err(Stop::Fault(Fault::ConversionOutOfRange)),
    }
}

/// An optional of what may be one already.
fn maybe(value: Option<Value>) -> Value {
    match value {
        Some(Value::Optional(inner)) => Value::Optional(inner),
        value => Value::Optional(value.map(Box::new)),
    }
}

/// The index of the first element that is equal.
pub fn position(list: &[Value], element: &Value) -> Outcome<Option<usize>> {
    for (index, other) in list.iter().enumerate() {
        if equal(other, element, true).ok_or(Stop::Unknown)? {
            return Ok(Some(index));
        }
    }
    Ok(None)
}

/// An index of a list with this number of elements.
pub fn index(at: i64, length: usize) -> Outcome<usize> {
    match usize::try_from(at) {
        Ok(index) if index < length => Ok(index),
        _ => Err(Stop::Fault(Fault::IndexOutOfRange {
            index: at,
            length: length as u32,
        })),
    }
}

fn keys(map: Vec<(Value, Value)>) -> Vec<Value> {
    map.into_iter().map(|(key, _)| key).collect()
}

/// The result of a method that changes nothing.
pub fn method(method: Method, receiver: Value, arguments: Vec<Value>) -> Outcome<Value> {
    use Value::{Bool, Int, List, Map, Set, Text};
    let mut arguments = arguments.into_iter();
    let (first, second) = (arguments.next(), arguments.next());
    let size = |length: usize| Int(length as i64);
    Ok(match (method.name(), receiver, first, second) {
        ("size", List(list) | Set(list), ..) => size(list.len()),
        ("size", Map(map), ..) => size(map.len()),
        ("size", Text(text), ..) => size(text.chars().count()),
        ("contains", List(list), Some(element), _) => Bool(position(&list, &element)?.is_some()),
        ("contains", Set(set), Some(element), _) => Bool(
            set.iter()
                .any(|other| order(other, &element) == Ordering::Equal),
        ),
        ("contains", Map(map), Some(key), _) => Bool(find(&map, &key).is_some()),
        ("contains", Text(text), Some(Text(part)), _) => Bool(text.contains(&part)),
        ("starts_with", Text(text), Some(Text(part)), _) => Bool(text.starts_with(&part)),
        ("ends_with", Text(text), Some(Text(part)), _) => Bool(text.ends_with(&part)),
        ("lower", Text(text), ..) => Text(text.to_lowercase()),
        ("upper", Text(text), ..) => Text(text.to_uppercase()),
        ("trim", Text(text), ..) => Text(text.trim().into()),
        ("replace", Text(text), Some(Text(part)), Some(Text(by))) => Text(match &part[..] {
            "" => text,
            part => text.replace(part, &by),
        }),
        ("join", List(list), Some(Text(separator)), _) => {
            let texts = list.into_iter().map(|text| match text {
                Text(text) => text,
                other => panic!("join of {other:?}"),
            });
            Text(texts.collect::<Vec<_>>().join(&separator))
        }
        ("contains", Value::Area(area), Some(Value::Point(point)), _) => {
            Bool(area.is_some_and(|area| area.contains(point)))
        }
        ("first", List(list), ..) => maybe(list.into_iter().next()),
        ("last", List(list), ..) => maybe(list.into_iter().next_back()),
        ("index_of", List(list), Some(element), _) => {
            maybe(position(&list, &element)?.map(|at| Int(at as i64)))
        }
        ("reversed", List(list), ..) => List(list.into_iter().rev().collect()),
        ("sorted", List(mut list), ..) => {
            list.sort_by(order);
            List(list)
        }
        ("slice", List(list), Some(Int(start)), Some(Int(end))) => slice(list, start, end)?,
        ("union", Set(a), Some(Set(b)), _) => Set(set([a, b].concat())),
        ("intersection", Set(mut a), Some(Set(b)), _) => {
            a.retain(|one| b.iter().any(|other| order(one, other) == Ordering::Equal));
            Set(a)
        }
        ("difference", Set(mut a), Some(Set(b)), _) => {
            a.retain(|one| b.iter().all(|other| order(one, other) != Ordering::Equal));
            Set(a)
        }
        ("min", Set(set), ..) => maybe(set.into_iter().next()),
        ("max", Set(set), ..) => maybe(set.into_iter().next_back()),
        ("get", Map(mut map), Some(key), _) => {
            maybe(find(&map, &key).map(|at| map.swap_remove(at).1))
        }
        ("keys", Map(map), ..) => Set(keys(map)),
        ("values", Map(map), ..) => List(map.into_iter().map(|(_, value)| value).collect()),
        ("split", Text(text), Some(Text(separator)), _) => List(match &separator[..] {
            "" => vec![Text(text)],
            _ => text
                .split(&separator)
                .map(|part| Text(part.into()))
                .collect(),
        }),
        (name, receiver, ..) => panic!("{name} of {receiver:?}"),
    })
}

fn slice(list: Vec<Value>, start: i64, end: i64) -> Outcome<Value> {
    let length = list.len() as i64;
    let out_of_range = |index| {
        Stop::Fault(Fault::IndexOutOfRange {
            index,
            length: length as u32,
        })
    };
    if start < 0 || start > length {
        return Err(out_of_range(start));
    }
    if end < start || end > length {
        return Err(out_of_range(end));
    }
    Ok(Value::List(list[start as usize..end as usize].to_vec()))
}

/// The sum of Ints or Floats, from the first on.
pub fn sum(list: Vec<Value>, zero: Value) -> Outcome<Value> {
    let add = |sum, value| super::operator::apply(starl_lang::ir::Operator::Add, sum, value);
    list.into_iter().try_fold(zero, add)
}
