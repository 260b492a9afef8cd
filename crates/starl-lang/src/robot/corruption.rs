//! Transient faults: random values in place of a program's variables.
//!
//! Invariant: each is a value of its variable's type, so that the machine continues as after any assignment. Parameters
//! do not change: like the code, they belong to the program.

use crate::machine::{ObjectType, Parameter, Program, State, Type, Value};
use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;
use starl_core::{Area, Duration, Point, Random, RobotId, Time};

/// Collections get fewer elements than this.
const MOST_ELEMENTS: u32 = 5;

/// Gives every variable a random value of its type.
pub(super) fn corrupt(program: &Program, state: &mut State, random: &mut Random) {
    for variable in &program.bytecode().variables {
        if variable.parameter == Parameter::No || variable.name == "role" {
            let value = value(program, &variable.kind, random, 0);
            // A value of the type is taken; a map with a key twice is not, and leaves what was there.
            let _ = program.set(state, &variable.name, &value);
        }
    }
}

/// `depth` counts the collections that the value is in.
fn value(program: &Program, kind: &Type, random: &mut Random, depth: u32) -> Value {
    let bytecode = program.bytecode();
    match kind {
        Type::Bool => Value::Bool(random.chance(0.5)),
        Type::Int => {
            let magnitude = whole(random) as i64;
            Value::Int(if random.chance(0.5) {
                magnitude
            } else {
                !magnitude
            })
        }
        Type::Float => Value::Float(number(random)),
        Type::Time => Value::Time(Time(whole(random) >> 1)),
        Type::Duration => Value::Duration(Duration(whole(random) >> 1)),
        Type::Robot => Value::Robot(RobotId(random.bits() >> random.below(32))),
        Type::Enum(index) => {
            let declared = bytecode.enums.get(usize::from(*index));
            let variants = declared.map_or(&[][..], |declared| &declared.variants);
            let variant = variants.get(random.below(variants.len() as u32) as usize);
            Value::Variant(variant.cloned().unwrap_or_default())
        }
        Type::Point => Value::Point(point(random)),
        Type::Optional(value_kind) => match random.chance(0.5) {
            true => Value::Some(Box::new(value(program, value_kind, random, depth))),
            false => Value::None,
        },
        Type::Record(fields) => {
            let fields = fields.iter();
            Value::Record(
                fields
                    .map(|(name, kind)| (name.clone(), value(program, kind, random, depth)))
                    .collect(),
            )
        }
        Type::Object(index) => match bytecode.types.get(usize::from(*index)) {
            Some(object_kind) => object(program, object_kind, random, depth),
            None => Value::None,
        },
    }
}

fn object(program: &Program, kind: &ObjectType, random: &mut Random, depth: u32) -> Value {
    let elements = |kind: &Type, random: &mut Random| -> Vec<Value> {
        // Collections of collections would grow without end.
        let count = random.below(MOST_ELEMENTS.checked_shr(depth).unwrap_or(0));
        (0..count)
            .map(|_| value(program, kind, random, depth + 1))
            .collect()
    };
    match kind {
        ObjectType::Text => {
            let count = random.below(MOST_ELEMENTS);
            let letters = (0..count).map(|_| char::from(b'a' + random.below(26) as u8));
            Value::Text(letters.collect::<String>())
        }
        ObjectType::Area => Value::Area(Some(Area::Circle {
            center: point(random),
            radius: random.between(0.0, 10.0),
        })),
        ObjectType::Obstacles => Value::Obstacles([].into()),
        ObjectType::List(element) => Value::List(elements(element, random)),
        ObjectType::Set(element) => Value::Set(elements(element, random)),
        ObjectType::Map(key, entry) => {
            let mut entries: Vec<(Value, Value)> = Vec::new();
            for key in elements(key, random) {
                if entries.iter().all(|(known, _)| *known != key) {
                    entries.push((key, value(program, entry, random, depth + 1)));
                }
            }
            Value::Map(entries)
        }
    }
}

/// 64 random bits, small numbers as likely as great ones; the highest bit is 0.
fn whole(random: &mut Random) -> u64 {
    random.word() >> (1 + random.below(63))
}

/// A number of any magnitude that occurs in programs, from a millionth to a million.
fn number(random: &mut Random) -> f64 {
    let magnitude = starl_core::math::exp(random.between(-14.0, 14.0));
    if random.chance(0.5) {
        magnitude
    } else {
        -magnitude
    }
}

fn point(random: &mut Random) -> Point {
    let mut coordinate = || random.between(-100.0, 100.0);
    Point::new(coordinate(), coordinate(), coordinate())
}
