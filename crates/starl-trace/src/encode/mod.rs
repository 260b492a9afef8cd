//! Events as JSON. [`crate::decode`] reads it back exactly.

mod values;

pub(crate) use values::{obstacles, way_points};

use crate::json::Json;
use starl_core::event::{DropReason, Hit, Level, Mark, MarkShape, borrowed};
use starl_core::{Destination, Event, Pose, RobotId};
use values::{fields, obstacle};

/// Writes the message for an event.
pub(crate) fn event(json: &mut Json, robot: Option<RobotId>, event: &Event) {
    json.mark(b'{');
    if let Some(RobotId(id)) = robot {
        json.raw("\"robot\":").integer(id);
    }
    match event {
        Event::Moved(at) | Event::Estimated(at) => pose(json, at),
        Event::Sent {
            sequence,
            destination,
            port,
            payload,
        } => {
            json.key("sequence").integer(*sequence);
            if let Destination::Robot(RobotId(id)) = destination {
                json.key("to").integer(*id);
            }
            json.key("port").integer(port.0);
            json.key("payload").base64(payload);
        }
        Event::Delivered { from, sequence } => datagram(json, *from, *sequence),
        Event::Dropped {
            from,
            to,
            sequence,
            reason,
        } => {
            datagram(json, *from, *sequence);
            if let Some(RobotId(id)) = to {
                json.key("to").integer(*id);
            }
            json.key("reason").string(drop_reason(*reason));
        }
        Event::Collided {
            with: Hit::Robot(RobotId(id)),
        } => {
            json.key("with_robot").integer(*id);
        }
        Event::Collided {
            with: Hit::Obstacle(index),
        } => {
            json.key("with_obstacle").integer(*index);
        }
        Event::Action(name) => {
            json.key("name").string(name);
        }
        Event::Program {
            name,
            fields: details,
        } => {
            json.key("name").string(name);
            fields(json, &borrowed(details));
        }
        Event::Primitive { port, event } => {
            json.key("primitive").string(event.primitive());
            json.key("port").integer(port.0);
            json.key("name").string(event.name());
            fields(json, &event.fields());
        }
        Event::Log {
            level: weight,
            text,
        } => {
            json.key("level").string(level(*weight));
            json.key("text").string(text);
        }
        Event::Draw(drawn) => mark(json, drawn),
        Event::Fault(fault) => {
            json.key("text").string(fault.name());
        }
        Event::Discovered(found) => {
            json.key("obstacle");
            obstacle(json, found);
        }
        Event::Finished => {
            json.key("status").string("finished");
        }
        Event::Failed(reason) => {
            json.key("status").string("failed");
            json.key("reason").string(reason);
        }
        Event::Took(thing) => {
            json.key("thing").integer(*thing);
        }
        Event::PutDown { thing, position } => {
            json.key("thing").integer(*thing);
            json.key("put_down").point(*position);
        }
        Event::Intervention(what) => {
            // Interventions are rare, so that their JSON need not be made in place.
            let text = serde_json::to_string(what);
            let text = text.unwrap_or_else(|error| unreachable!("plain data: {error}"));
            json.key("intervention").string(&text);
        }
        Event::Violated { property, text } => {
            json.key("property").string(property);
            json.key("text").string(text);
        }
    }
    json.mark(b'}');
}

#[inline]
fn pose(json: &mut Json, pose: &Pose) {
    json.key("x").number(pose.position.x);
    json.raw(",\"y\":").number(pose.position.y);
    json.raw(",\"z\":").number(pose.position.z);
    json.raw(",\"yaw\":").number(pose.yaw);
    json.raw(",\"pitch\":").number(pose.pitch);
    json.raw(",\"roll\":").number(pose.roll);
}

fn datagram(json: &mut Json, from: RobotId, sequence: u32) {
    json.key("from").integer(from.0);
    json.key("sequence").integer(sequence);
}

/// The word for a reason in a trace.
pub(crate) fn drop_reason(reason: DropReason) -> &'static str {
    match reason {
        DropReason::Loss => "loss",
        DropReason::Range => "range",
        DropReason::Partition => "partition",
        DropReason::Down => "down",
        DropReason::Bandwidth => "bandwidth",
        DropReason::Size => "size",
    }
}

/// The word for a level in a trace.
pub(crate) fn level(level: Level) -> &'static str {
    match level {
        Level::Debug => "debug",
        Level::Info => "info",
        Level::Warning => "warning",
        Level::Error => "error",
    }
}

fn mark(json: &mut Json, mark: &Mark) {
    json.key("label").string(&mark.label);
    match &mark.shape {
        MarkShape::Nothing => json.key("shape").string("nothing"),
        MarkShape::Dot(at) => json.key("shape").string("dot").key("points").points(&[*at]),
        MarkShape::Circle { center, radius } => {
            json.key("shape")
                .string("circle")
                .key("points")
                .points(&[*center]);
            json.key("radius").number(*radius)
        }
        MarkShape::Line(points) => json
            .key("shape")
            .string("line")
            .key("points")
            .points(points),
        MarkShape::Text(at) => json
            .key("shape")
            .string("text")
            .key("points")
            .points(&[*at]),
    };
}
