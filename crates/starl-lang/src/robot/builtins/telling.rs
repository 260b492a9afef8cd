//! Output to observers: logs, events and drawings.

use crate::machine::{HostCall, Value};
use crate::robot::arguments::{Arguments, Called};
use crate::robot::failure::Failure;
use crate::robot::host::RobotHost;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use starl_core::event::{Fields, Level, MarkShape};
use starl_core::{self as core, Point, RobotId};

pub fn emit(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    let program = host.context.code.program();
    let kinds = call.import.arguments.iter();
    let Some(values) = Value::read_all(program, kinds, call.scalars, call.objects) else {
        return Err("an event's field has no value of its type".into());
    };
    let mut values = values.into_iter();
    let Some(Value::Text(name)) = values.next() else {
        return Err("an event has no name".into());
    };
    let labels = call.import.labels.iter();
    let fields: Fields = labels
        .zip(values)
        .map(|(label, value)| (label.clone().into(), detail(value)))
        .collect();
    let cost = 10 * (1 + fields.len() as u64);
    host.context.robot.emit_fields(name, fields);
    Ok(cost)
}

/// A value as a detail of an event. Values of other types become text.
fn detail(value: Value) -> core::Value {
    match value {
        Value::Bool(value) => value.into(),
        Value::Int(value) => value.into(),
        Value::Float(value) => value.into(),
        Value::Time(value) => value.into(),
        Value::Duration(value) => value.seconds().into(),
        Value::Robot(value) => value.into(),
        Value::Point(value) => value.into(),
        Value::Text(value) | Value::Variant(value) => core::Value::Text(value.into()),
        Value::Some(value) => detail(*value),
        Value::Area(Some(value)) => value.into(),
        Value::Obstacles(value) => value.into(),
        Value::List(values) | Value::Set(values) if !values.is_empty() => several(values),
        other => core::Value::Text(other.to_string().into()),
    }
}

/// Points or robots, or else words.
fn several(values: Vec<Value>) -> core::Value {
    let points = values.iter().map(|value| match value {
        Value::Point(point) => Some(*point),
        _ => None,
    });
    if let Some(points) = points.collect::<Option<Vec<Point>>>() {
        return points.into();
    }
    let robots = values.iter().map(|value| match value {
        Value::Robot(robot) => Some(*robot),
        _ => None,
    });
    match robots.collect::<Option<Vec<RobotId>>>() {
        Some(robots) => robots.into(),
        None => core::Value::Text(Value::List(values).to_string().into()),
    }
}

pub fn log(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    let text = String::from(Arguments::of(call).text());
    host.context.robot.log(Level::Info, text);
    Ok(10)
}

/// Draws the shape under the label, which is the first argument.
fn draw(
    host: &mut RobotHost<'_, '_>,
    call: &HostCall<'_>,
    shape: impl FnOnce(&mut Arguments<'_>) -> MarkShape,
) -> Called {
    let mut arguments = Arguments::of(call);
    let label = String::from(arguments.text());
    let shape = shape(&mut arguments);
    host.context.robot.draw(label, shape);
    Ok(10)
}

pub fn draw_point(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    draw(host, call, |arguments| MarkShape::Dot(arguments.point()))
}

pub fn draw_line(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    draw(host, call, |arguments| MarkShape::Line(arguments.points()))
}

pub fn draw_circle(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    draw(host, call, |arguments| MarkShape::Circle {
        center: arguments.point(),
        radius: arguments.float(),
    })
}

pub fn draw_text(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    draw(host, call, |arguments| MarkShape::Text(arguments.point()))
}

pub fn draw_nothing(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    draw(host, call, |_| MarkShape::Nothing)
}

/// The program ends here, without the following statements.
pub fn fail(host: &mut RobotHost<'_, '_>, call: &mut HostCall<'_>) -> Called {
    host.failure = Some(Failure::Told(Arguments::of(call).text().into()));
    Err("the program cannot continue".into())
}
