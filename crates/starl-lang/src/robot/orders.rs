//! Orders of operators, and the inputs by which programs handle them.
//!
//! Orders are untrusted: if a field is missing or has another type the order is not handled, and the text gives the
//! reason. Fields that the program does not name are ignored.

use super::messages::Arrival;
use super::words::type_name;
use crate::machine::{Bytecode, ObjectType, Origin, Program, Type, Value};
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use starl_core::{self as core, Order};
use thiserror::Error;

/// An input that the program handles.
#[derive(Clone, Debug)]
struct Incoming {
    name: String,
    fields: Vec<(String, Type)>,
    /// Its handlers, in the order of the text.
    handlers: Vec<u32>,
}

/// The inputs that a program handles.
#[derive(Clone, Debug, Default)]
pub struct Orders(Vec<Incoming>);

/// A field of an order that does not fit the input that handles it.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("order `{order}` ignored: its field `{field}` {}", self.need())]
pub struct WrongField {
    /// The name of the order.
    pub order: String,
    /// The name of the field.
    pub field: String,
    /// Its type, as the language writes it.
    pub expected: String,
    /// The type that it has; none if it is missing.
    pub found: Option<&'static str>,
}

impl WrongField {
    /// The type that the field must have, and the one that it has.
    pub fn need(&self) -> String {
        let found = self.found.unwrap_or("missing");
        format!("must be {}, but it is {found}", self.expected)
    }
}

impl Orders {
    /// Those of a program; none if handlers of one input have different fields.
    pub fn of(bytecode: &Bytecode) -> Option<Orders> {
        let mut orders = Orders::default();
        for (index, handler) in bytecode.handlers.iter().enumerate() {
            let Origin::Input(names) = &handler.origin else {
                continue;
            };
            let function = bytecode.functions.get(handler.function as usize)?;
            let types = function.arguments.iter().cloned();
            let fields: Vec<(String, Type)> = names.iter().cloned().zip(types).collect();
            let mut known = orders.0.iter_mut();
            match known.find(|known| known.name == handler.event) {
                Some(known) if known.fields == fields => known.handlers.push(index as u32),
                Some(_) => return None,
                None => orders.0.push(Incoming {
                    name: handler.event.clone(),
                    fields,
                    handlers: Vec::from([index as u32]),
                }),
            }
        }
        Some(orders)
    }

    /// The names of the inputs.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|known| known.name.as_str())
    }

    /// The arguments of the order's handlers; `None` if it has no handler.
    ///
    /// # Errors
    /// The first field that does not fit.
    pub fn decode(
        &self,
        program: &Program,
        order: &Order,
    ) -> Result<Option<Arrival<'_>>, WrongField> {
        let Some(incoming) = self.0.iter().find(|known| known.name == order.name) else {
            return Ok(None);
        };
        let (mut scalars, mut objects) = (Vec::new(), Vec::new());
        for (name, kind) in &incoming.fields {
            let wrong = |found| WrongField {
                order: order.name.clone().into(),
                field: name.clone(),
                expected: type_name(program.bytecode(), kind),
                found,
            };
            let mut given = order.fields.iter();
            let Some((_, given)) = given.find(|(field, _)| field == name) else {
                return Err(wrong(None));
            };
            let value = value(given, program.bytecode(), kind);
            let fits =
                value.is_some_and(|value| value.write(program, kind, &mut scalars, &mut objects));
            if !fits {
                return Err(wrong(Some(type_of(given))));
            }
        }
        Ok(Some(Arrival {
            handlers: &incoming.handlers,
            scalars,
            objects,
        }))
    }
}

/// A field of an order as a value of this type; `None` if it is of another. An empty list is a list of anything.
fn value(given: &core::Value, bytecode: &Bytecode, kind: &Type) -> Option<Value> {
    let element = match kind {
        Type::Object(index) => match bytecode.types.get(usize::from(*index)) {
            Some(ObjectType::List(element)) => Some(element),
            _ => None,
        },
        _ => None,
    };
    Some(match (given, element) {
        (core::Value::Bool(value), _) => Value::Bool(*value),
        (core::Value::Int(value), _) if *kind == Type::Float => Value::Float(*value as f64),
        (core::Value::Int(value), _) => Value::Int(*value),
        (core::Value::Float(value), _) => Value::Float(*value),
        (core::Value::Text(value), _) => Value::Text(value.clone().into_owned()),
        (core::Value::Point(value), _) => Value::Point(*value),
        (core::Value::Robot(value), _) => Value::Robot(*value),
        (core::Value::Path(values), Some(_)) => {
            Value::List(values.iter().copied().map(Value::Point).collect())
        }
        (core::Value::Robots(values), Some(_)) => {
            Value::List(values.iter().copied().map(Value::Robot).collect())
        }
        _ => return None,
    })
}

/// The type of an order's field, as the language writes it.
fn type_of(value: &core::Value) -> &'static str {
    match value {
        core::Value::Bool(_) => "Bool",
        core::Value::Int(_) => "Int",
        core::Value::Float(_) => "Float",
        core::Value::Text(_) => "String",
        core::Value::Time(_) => "Time",
        core::Value::Point(_) => "Point",
        core::Value::Path(_) => "List[Point]",
        core::Value::Robot(_) => "RobotId",
        core::Value::Robots(_) => "List[RobotId]",
        core::Value::Obstacles(_) => "Obstacles",
        core::Value::Area(_) => "Area",
    }
}
