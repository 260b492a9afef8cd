//! Events in words.

use starl_core::event::{ValueRef, borrowed};
use starl_core::{Event, Record};

/// One line for a record; none for irrelevant ones.
pub fn line(record: &Record) -> Option<String> {
    let robot = record.robot?;
    let what = match &record.event {
        Event::Sent {
            destination,
            payload,
            ..
        } => {
            let bytes = payload.len();
            match destination {
                starl_core::Destination::Robot(to) => format!("sends {bytes} bytes to robot {to}"),
                starl_core::Destination::All => format!("sends {bytes} bytes to all"),
            }
        }
        Event::Action(name) => format!("action {name}"),
        Event::Program { name, fields } => format!("{name}{}", details(&borrowed(fields))),
        Event::Primitive { event, .. } => {
            let (primitive, name) = (event.primitive(), event.name());
            format!("{primitive} {name}{}", details(&event.fields()))
        }
        Event::Log { text, .. } => format!("log: {text}"),
        Event::Finished => "has finished".to_string(),
        Event::Failed(reason) => format!("failed: {reason}"),
        _ => return None,
    };
    Some(format!("robot {robot}: {what}"))
}

fn details(fields: &[(&str, ValueRef<'_>)]) -> String {
    let shown = fields
        .iter()
        .map(|(name, value)| format!(" {name}={}", words(*value)));
    shown.collect()
}

fn words(value: ValueRef<'_>) -> String {
    match value {
        ValueRef::Bool(flag) => flag.to_string(),
        ValueRef::Int(number) => number.to_string(),
        ValueRef::Float(number) => number.to_string(),
        ValueRef::Text(text) => text.to_string(),
        ValueRef::Time(time) => time.to_string(),
        ValueRef::Robot(robot) => robot.to_string(),
        ValueRef::Robots(robots) => {
            let names: Vec<String> = robots.iter().map(ToString::to_string).collect();
            format!("[{}]", names.join(", "))
        }
        other => format!("{other:?}"),
    }
}
