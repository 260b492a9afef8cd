//! Entities of `foxglove.SceneUpdate` and their parts.

use crate::json::Json;
use starl_core::{Point, Time};
use std::borrow::Cow;

/// Red, green, blue and opacity, each from 0 to 1.
pub type Color = [f64; 4];

pub const GREY: Color = [0.6, 0.6, 0.6, 0.8];
pub const RED: Color = [0.84, 0.08, 0.08, 1.0];
pub const DARK: Color = [0.1, 0.1, 0.1, 1.0];

/// The colour of the robot at this place in the fleet: Okabe and Ito (2008), without black and red.
pub fn palette(index: usize) -> Color {
    const COLORS: [[u8; 3]; 6] = [
        [0, 114, 178],
        [230, 159, 0],
        [0, 158, 115],
        [204, 121, 167],
        [86, 180, 233],
        [240, 228, 66],
    ];
    let [red, green, blue] = COLORS[index % COLORS.len()].map(|part| f64::from(part) / 255.0);
    [red, green, blue, 1.0]
}

/// A part of an entity. All positions are in the entity's frame, metres.
pub enum Primitive {
    /// A box with sides along the axes.
    Cube {
        center: Point,
        size: Point,
        color: Color,
    },
    /// An upright cylinder.
    Cylinder {
        center: Point,
        size: Point,
        color: Color,
    },
    /// Lines from each point to the next.
    Line {
        points: Vec<Point>,
        closed: bool,
        thickness: f64,
        color: Color,
    },
    /// Triangles, three points each.
    Triangles { points: Vec<Point>, color: Color },
    /// A text that always faces the viewer.
    Text {
        at: Point,
        size: f64,
        text: String,
        color: Color,
    },
}

/// An entity as a whole.
pub struct Entity<'a> {
    pub frame: &'a str,
    pub id: Cow<'a, str>,
    /// Whether it moves with its frame.
    pub locked: bool,
    pub parts: Vec<Primitive>,
}

/// Writes an update that adds or replaces entities.
pub fn update(json: &mut Json, at: Time, entities: &[Entity<'_>]) {
    json.clear();
    json.raw("{\"deletions\":[],\"entities\":[");
    for one in entities {
        json.item();
        entity(json, at, one);
    }
    json.raw("]}");
}

/// Writes an update that takes one entity away.
pub fn deletion(json: &mut Json, at: Time, id: &str) {
    json.clear();
    json.raw("{\"deletions\":[{\"timestamp\":").time(at);
    json.raw(",\"type\":0,\"id\":").string(id);
    json.raw("}],\"entities\":[]}");
}

fn entity(json: &mut Json, at: Time, entity: &Entity<'_>) {
    json.raw("{\"timestamp\":").time(at);
    json.key("frame_id").string(entity.frame);
    json.key("id").string(&entity.id);
    json.raw(",\"lifetime\":{\"sec\":0,\"nsec\":0}");
    json.key("frame_locked").boolean(entity.locked);
    json.raw(",\"metadata\":[],\"arrows\":[],\"spheres\":[],\"models\":[]");
    type Kind = fn(&Primitive) -> bool;
    let lists: [(&'static str, Kind); 5] = [
        ("cubes", |part| matches!(part, Primitive::Cube { .. })),
        ("cylinders", |part| {
            matches!(part, Primitive::Cylinder { .. })
        }),
        ("lines", |part| matches!(part, Primitive::Line { .. })),
        ("triangles", |part| {
            matches!(part, Primitive::Triangles { .. })
        }),
        ("texts", |part| matches!(part, Primitive::Text { .. })),
    ];
    for (name, belongs) in lists {
        json.key(name).mark(b'[');
        for part in entity.parts.iter().filter(|part| belongs(part)) {
            json.item().mark(b'{');
            primitive(json, part);
            json.mark(b'}');
        }
        json.mark(b']');
    }
    json.mark(b'}');
}

fn primitive(json: &mut Json, part: &Primitive) {
    match part {
        Primitive::Cube {
            center,
            size,
            color,
        } => {
            pose(json, *center);
            json.key("size").rounded_point(*size);
            paint(json, *color);
        }
        Primitive::Cylinder {
            center,
            size,
            color,
        } => {
            pose(json, *center);
            json.key("size").rounded_point(*size);
            json.raw(",\"bottom_scale\":1,\"top_scale\":1");
            paint(json, *color);
        }
        Primitive::Line {
            points,
            closed,
            thickness,
            color,
        } => {
            pose(json, Point::ZERO);
            json.key("type").integer(u8::from(*closed));
            json.key("thickness").rounded(*thickness);
            json.raw(",\"scale_invariant\":false");
            vertices(json, points);
            paint(json, *color);
            json.raw(",\"colors\":[],\"indices\":[]");
        }
        Primitive::Triangles { points, color } => {
            pose(json, Point::ZERO);
            vertices(json, points);
            paint(json, *color);
            json.raw(",\"colors\":[],\"indices\":[]");
        }
        Primitive::Text {
            at,
            size,
            text,
            color,
        } => {
            pose(json, *at);
            json.raw(",\"billboard\":true,\"scale_invariant\":false");
            json.key("font_size").rounded(*size);
            json.key("text").string(text);
            paint(json, *color);
        }
    }
}

fn pose(json: &mut Json, position: Point) {
    json.raw("\"pose\":{\"position\":").rounded_point(position);
    json.raw(",\"orientation\":{\"x\":0,\"y\":0,\"z\":0,\"w\":1}}");
}

fn vertices(json: &mut Json, points: &[Point]) {
    json.key("points").mark(b'[');
    for &point in points {
        json.item().rounded_point(point);
    }
    json.mark(b']');
}

fn paint(json: &mut Json, [red, green, blue, opacity]: Color) {
    json.raw(",\"color\":{\"r\":").rounded(red);
    json.raw(",\"g\":").rounded(green);
    json.raw(",\"b\":").rounded(blue);
    json.raw(",\"a\":").rounded(opacity).mark(b'}');
}
