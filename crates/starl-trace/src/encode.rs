//! Events as JSON. [`crate::decode`] reads what is written here, bit for bit.

use crate::json::Json;
use starl_core::event::{DropReason, Hit, Level, Mark, MarkShape};
use starl_core::geometry::HeightSpan;
use starl_core::{
    Area, Destination, Event, Fields, Obstacle, Pose, RobotId, Shape, Value, WayPoint,
};

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
            fields(json, details);
        }
        Event::Primitive {
            primitive,
            port,
            name,
            fields: details,
        } => {
            json.key("primitive").string(primitive);
            json.key("port").integer(port.0);
            json.key("name").string(name);
            fields(json, details);
        }
        Event::Log {
            level: weight,
            text,
        } => {
            json.key("level").string(level(*weight));
            json.key("text").string(text);
        }
        Event::Draw(drawn) => mark(json, drawn),
        Event::Fault(text) => {
            json.key("text").string(text);
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

fn fields(json: &mut Json, fields: &Fields) {
    json.key("fields").mark(b'[');
    for (name, detail) in fields {
        json.item().mark(b'{').key("name").string(name);
        value(json, detail);
        json.mark(b'}');
    }
    json.mark(b']');
}

fn value(json: &mut Json, value: &Value) {
    match value {
        Value::Bool(value) => json.key("bool").boolean(*value),
        Value::Int(value) => json.key("int").integer(*value),
        Value::Float(value) if value.is_nan() => json.key("not_finite").string("nan"),
        Value::Float(f64::INFINITY) => json.key("not_finite").string("inf"),
        Value::Float(f64::NEG_INFINITY) => json.key("not_finite").string("-inf"),
        Value::Float(value) => json.key("float").number(*value),
        Value::Text(text) => json.key("text").string(text),
        Value::Time(at) => json.key("time_ns").integer(at.0),
        Value::Point(at) => json.key("point").point(*at),
        Value::Path(points) => json.key("path").points(points),
        Value::Robot(id) => json.key("robot").integer(id.0),
        Value::Robots(ids) => {
            json.key("robots").mark(b'[');
            for id in ids {
                json.item().integer(id.0);
            }
            json.mark(b']')
        }
        Value::Obstacles(list) => {
            json.key("obstacles");
            obstacles(json, list);
            json
        }
        Value::Area(region) => {
            json.key("area");
            area(json, region);
            json
        }
    };
}

/// Writes obstacles as an array.
pub(crate) fn obstacles(json: &mut Json, list: &[Obstacle]) {
    json.mark(b'[');
    for one in list {
        json.item();
        obstacle(json, one);
    }
    json.mark(b']');
}

fn obstacle(json: &mut Json, obstacle: &Obstacle) {
    json.mark(b'{');
    match &obstacle.shape {
        Shape::Polygon { base, height } => {
            json.key("polygon").points(base.vertices());
            height_span(json, *height);
        }
        Shape::Circle {
            center,
            radius,
            height,
        } => {
            json.key("circle").mark(b'{').key("center").point(*center);
            json.key("radius").number(*radius).mark(b'}');
            height_span(json, *height);
        }
        Shape::Cuboid { low, high } => {
            json.key("box")
                .mark(b'{')
                .key("low")
                .point(*low)
                .key("high")
                .point(*high)
                .mark(b'}');
        }
    }
    json.mark(b'}');
}

fn height_span(json: &mut Json, height: Option<HeightSpan>) {
    if let Some(HeightSpan { low, high }) = height {
        json.key("height")
            .mark(b'{')
            .key("low")
            .number(low)
            .key("high")
            .number(high)
            .mark(b'}');
    }
}

fn area(json: &mut Json, area: &Area) {
    json.mark(b'{');
    match area {
        Area::Circle { center, radius } => {
            json.key("circle").mark(b'{').key("center").point(*center);
            json.key("radius").number(*radius).mark(b'}');
        }
        Area::Polygon(polygon) => {
            json.key("polygon").points(polygon.vertices());
        }
        Area::Box { low, high } => {
            json.key("box")
                .mark(b'{')
                .key("low")
                .point(*low)
                .key("high")
                .point(*high)
                .mark(b'}');
        }
    }
    json.mark(b'}');
}

/// Writes way-points as an array.
pub(crate) fn way_points(json: &mut Json, list: &[WayPoint]) {
    json.mark(b'[');
    for way_point in list {
        json.item().mark(b'{').key("name").string(&way_point.name);
        json.key("position").point(way_point.position);
        json.key("group").integer(way_point.group).mark(b'}');
    }
    json.mark(b']');
}
