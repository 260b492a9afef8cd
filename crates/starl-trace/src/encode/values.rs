//! Values, areas, obstacles and waypoints as JSON. [`crate::wire`] reads them.

use crate::json::Json;
use starl_core::event::ValueRef;
use starl_core::geometry::HeightSpan;
use starl_core::{Area, Obstacle, Shape, WayPoint};

/// Writes the details of an event as the member `fields`.
pub(super) fn fields(json: &mut Json, fields: &[(&str, ValueRef<'_>)]) {
    json.key("fields").mark(b'[');
    for (name, detail) in fields {
        json.item().mark(b'{').key("name").string(name);
        value(json, *detail);
        json.mark(b'}');
    }
    json.mark(b']');
}

fn value(json: &mut Json, value: ValueRef<'_>) {
    match value {
        ValueRef::Bool(value) => json.key("bool").boolean(value),
        ValueRef::Int(value) => json.key("int").integer(value),
        ValueRef::Float(value) if value.is_nan() => json.key("not_finite").string("nan"),
        ValueRef::Float(f64::INFINITY) => json.key("not_finite").string("inf"),
        ValueRef::Float(f64::NEG_INFINITY) => json.key("not_finite").string("-inf"),
        ValueRef::Float(value) => json.key("float").number(value),
        ValueRef::Text(text) => json.key("text").string(text),
        ValueRef::Time(at) => json.key("time_ns").integer(at.0),
        ValueRef::Point(at) => json.key("point").point(at),
        ValueRef::Path(points) => json.key("path").points(points),
        ValueRef::Robot(id) => json.key("robot").integer(id.0),
        ValueRef::Robots(ids) => {
            json.key("robots").mark(b'[');
            for id in ids {
                json.item().integer(id.0);
            }
            json.mark(b']')
        }
        ValueRef::Obstacles(list) => {
            json.key("obstacles");
            obstacles(json, list);
            json
        }
        ValueRef::Area(region) => {
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

/// Writes an obstacle as an object.
pub(super) fn obstacle(json: &mut Json, obstacle: &Obstacle) {
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

/// Writes waypoints as an array.
pub(crate) fn way_points(json: &mut Json, list: &[WayPoint]) {
    json.mark(b'[');
    for way_point in list {
        json.item().mark(b'{').key("name").string(&way_point.name);
        json.key("position").point(way_point.position);
        json.key("group").integer(way_point.group).mark(b'}');
    }
    json.mark(b']');
}
