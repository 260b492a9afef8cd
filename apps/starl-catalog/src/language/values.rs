//! The parameters of a scenario, as values of the types that a program declares.

use crate::parameters::{complaint, describe};
use starl_core::{Point, Time};
use starl_lang::machine::{self, Bytecode, ObjectType, Type, Value, is_tuple};
use starl_lang::robot::{Code, RobotProgram};
use starl_sim::engine::Complaint;
use starl_sim::read::suggest;
use starl_sim::scenario::{Fleet, Group, Parameter};

/// The program of a group's robots, with the parameters that the scenario gives.
///
/// # Errors
/// If they are not those that the program declares.
pub fn program(code: &Code, group: &Group, fleet: &Fleet) -> Result<RobotProgram, Complaint> {
    let bytecode = code.program().bytecode();
    let reader = Reader { bytecode, fleet };
    let declared = bytecode.variables.iter();
    let declared: Vec<&machine::Variable> = declared
        .filter(|variable| variable.parameter != machine::Parameter::No)
        .collect();
    let names: Vec<&str> = declared.iter().map(|variable| &*variable.name).collect();
    if let Some(name) = group
        .parameters
        .keys()
        .find(|name| !names.contains(&&***name))
    {
        let message = "the program has no such parameter";
        let help = suggest::help(name, &names, "it takes");
        let help = help.unwrap_or_else(|| "it takes none".to_string());
        return Err(complaint(name, message, help));
    }
    let mut values = Vec::new();
    for variable in declared {
        let (name, kind) = (&*variable.name, &variable.kind);
        match group.parameters.get(name) {
            Some(given) => {
                let value = reader.value(given, kind, name)?;
                if let Some(range) = variable.range_text().filter(|_| !variable.accepts(&value)) {
                    let message = format!("{} is out of range", describe(given));
                    let help = format!("give {}, {range}", reader.expected(kind));
                    return Err(complaint(name, &message, help));
                }
                values.push((name, value));
            }
            None if variable.parameter == machine::Parameter::Required => {
                let message = "is missing; the program has no value of its own for it";
                let help = format!("give {}", reader.expected(kind));
                return Err(complaint(name, message, help));
            }
            None => {}
        }
    }
    RobotProgram::new(code, &values)
        .map_err(|error| complaint("", &error.to_string(), String::new()))
}

/// Reads parameters of one program.
struct Reader<'a> {
    bytecode: &'a Bytecode,
    fleet: &'a Fleet,
}

impl Reader<'_> {
    /// The value of a parameter, or of a part of one, which is called `name`.
    fn value(&self, given: &Parameter, kind: &Type, name: &str) -> Result<Value, Complaint> {
        let unfit = || {
            let message = format!("{} does not fit", describe(given));
            complaint(name, &message, format!("give {}", self.expected(kind)))
        };
        Ok(match (kind, given) {
            (Type::Bool, &Parameter::Bool(flag)) => Value::Bool(flag),
            (Type::Int, &Parameter::Int(number)) => Value::Int(number),
            (Type::Float, &Parameter::Float(number)) => Value::Float(number),
            (Type::Float, &Parameter::Int(number)) => Value::Float(number as f64),
            (Type::Duration, &Parameter::Duration(span)) => Value::Duration(span),
            (Type::Time, &Parameter::Duration(span)) => Value::Time(Time::ZERO + span),
            (Type::Robot, Parameter::Text(robot)) => {
                Value::Robot(self.fleet.find(robot).ok_or_else(unfit)?)
            }
            (Type::Enum(number), Parameter::Text(variant)) => {
                // Scenarios write `rrt-connect` where a program has to write `rrt_connect`.
                let same = |known: &&String| **known == variant.replace('-', "_");
                let known = self.variants(*number).iter().find(same);
                Value::Variant(known.ok_or_else(unfit)?.clone())
            }
            (Type::Point, Parameter::List(parts)) => Value::Point(point(parts).ok_or_else(unfit)?),
            (Type::Record(parts), Parameter::List(list))
                if is_tuple(parts) && parts.len() == list.len() =>
            {
                let parts = parts.iter().zip(list);
                let part = |((part, kind), given): (&(String, Type), &Parameter)| {
                    let value = self.value(given, kind, &format!("{name}.{part}"))?;
                    Ok((part.clone(), value))
                };
                Value::Record(parts.map(part).collect::<Result<_, _>>()?)
            }
            (Type::Optional(kind), given) => Value::Some(Box::new(self.value(given, kind, name)?)),
            (Type::Object(number), given) => match (self.object(*number), given) {
                (Some(ObjectType::Text), Parameter::Text(text)) => Value::Text(text.clone()),
                (Some(ObjectType::List(element)), Parameter::List(list)) => {
                    Value::List(self.values(list, element, name)?)
                }
                (Some(ObjectType::Set(element)), Parameter::List(list)) => {
                    Value::Set(self.values(list, element, name)?)
                }
                _ => return Err(unfit()),
            },
            _ => return Err(unfit()),
        })
    }

    fn values(&self, list: &[Parameter], kind: &Type, name: &str) -> Result<Vec<Value>, Complaint> {
        let elements = list.iter().enumerate();
        elements
            .map(|(index, given)| self.value(given, kind, &format!("{name}.{index}")))
            .collect()
    }

    fn variants(&self, number: u16) -> &[String] {
        let declared = self.bytecode.enums.get(usize::from(number));
        declared.map_or(&[], |declared| &declared.variants)
    }

    fn object(&self, number: u16) -> Option<&ObjectType> {
        self.bytecode.types.get(usize::from(number))
    }

    /// The form of a value of this type in scenarios.
    fn expected(&self, kind: &Type) -> String {
        match kind {
            Type::Bool => "true or false".into(),
            Type::Int => "a whole number, without unit or point".into(),
            Type::Float => "a number, or a quantity such as \"75mm\"".into(),
            Type::Duration => "a time, such as \"250ms\"".into(),
            Type::Time => "a time since the start, such as \"10s\"".into(),
            Type::Robot => "the name of a robot".into(),
            Type::Point => "a point [x, y] or [x, y, z], metres".into(),
            Type::Enum(number) => format!("one of {}", self.variants(*number).join(", ")),
            Type::Optional(kind) => self.expected(kind),
            Type::Record(parts) if is_tuple(parts) => {
                let parts = parts.iter().map(|(_, kind)| self.expected(kind));
                format!("a list [{}]", parts.collect::<Vec<_>>().join("; "))
            }
            Type::Record(_) => "nothing: a scenario cannot set records".into(),
            Type::Object(number) => match self.object(*number) {
                Some(ObjectType::Text) => "a text that is not a quantity".into(),
                Some(ObjectType::List(element) | ObjectType::Set(element)) => {
                    format!("a list, each element {}", self.expected(element))
                }
                _ => "nothing: a scenario cannot set maps, areas and obstacles".into(),
            },
        }
    }
}

fn point(parts: &[Parameter]) -> Option<Point> {
    let number = |part: &Parameter| match *part {
        Parameter::Float(number) => Some(number),
        Parameter::Int(number) => Some(number as f64),
        _ => None,
    };
    let parts: Option<Vec<f64>> = parts.iter().map(number).collect();
    match parts?[..] {
        [x, y] => Some(Point::planar(x, y)),
        [x, y, z] => Some(Point::new(x, y, z)),
        _ => None,
    }
}
