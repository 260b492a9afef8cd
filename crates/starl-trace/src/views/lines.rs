//! Lines of Foxglove's log: what programs write, and what else a person should not miss.

use crate::json::Json;
use starl_core::event::{Hit, Level};
use starl_core::{Event, Time};
use std::borrow::Cow;

/// The line of the log for an event; none for events that are only data.
pub fn line(event: &Event) -> Option<(Level, Cow<'_, str>)> {
    Some(match event {
        Event::Log { level, text } => (*level, text.as_ref().into()),
        Event::Fault(text) => (Level::Warning, format!("fault: {text}").into()),
        Event::Collided { with } => (
            Level::Warning,
            match with {
                Hit::Robot(robot) => format!("collided with robot {robot}").into(),
                Hit::Obstacle(index) => format!("collided with obstacle {index}").into(),
            },
        ),
        Event::Finished => (Level::Info, "finished".into()),
        Event::Failed(reason) => (Level::Error, format!("failed: {reason}").into()),
        Event::Violated { property, text } => {
            (Level::Error, format!("violated: {property}: {text}").into())
        }
        _ => return None,
    })
}

/// Writes a `foxglove.Log`.
pub fn encode(json: &mut Json, at: Time, level: Level, name: &str, text: &str) {
    let level = match level {
        Level::Debug => 1,
        Level::Info => 2,
        Level::Warning => 3,
        Level::Error => 4,
    };
    json.clear();
    json.raw("{\"timestamp\":").time(at);
    json.key("level").integer(level);
    json.key("message").string(text);
    json.key("name").string(name);
    json.raw(",\"file\":\"\",\"line\":0}");
}
