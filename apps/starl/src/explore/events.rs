//! Events in words.

use starl_core::event::Fields;
use starl_core::{Event, Record, Value};

/// One line about what happened; none of what matters to nobody here.
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
        Event::Program { name, fields } => format!("{name}{}", details(fields)),
        Event::Primitive {
            primitive,
            name,
            fields,
            ..
        } => format!("{primitive} {name}{}", details(fields)),
        Event::Log { text, .. } => format!("log: {text}"),
        Event::Finished => "has finished".to_string(),
        Event::Failed(reason) => format!("failed: {reason}"),
        _ => return None,
    };
    Some(format!("robot {robot}: {what}"))
}

fn details(fields: &Fields) -> String {
    let shown = fields
        .iter()
        .map(|(name, value)| format!(" {name}={}", words(value)));
    shown.collect()
}

fn words(value: &Value) -> String {
    match value {
        Value::Bool(flag) => flag.to_string(),
        Value::Int(number) => number.to_string(),
        Value::Float(number) => number.to_string(),
        Value::Text(text) => text.to_string(),
        Value::Time(time) => time.to_string(),
        Value::Robot(robot) => robot.to_string(),
        Value::Robots(robots) => {
            let names: Vec<String> = robots.iter().map(ToString::to_string).collect();
            format!("[{}]", names.join(", "))
        }
        other => format!("{other:?}"),
    }
}
