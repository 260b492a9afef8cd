//! The JSON forms of values, marks, areas and obstacles, and their conversion.
//!
//! Each is an object in which exactly one member names its kind. They are written by hand and not derived on the core
//! types, so that the format changes only on purpose.

use crate::error::Malformed;
use serde::Deserialize;
use starl_core::event::MarkShape;
use starl_core::geometry::HeightSpan;
use starl_core::{Area, ConvexPolygon, Fields, Point, RobotId, Shape, Time, Value};

/// One detail of an event.
#[derive(Deserialize)]
pub(crate) struct Field {
    name: String,
    bool: Option<bool>,
    int: Option<i64>,
    float: Option<f64>,
    not_finite: Option<String>,
    text: Option<String>,
    time_ns: Option<u64>,
    point: Option<Point>,
    path: Option<Vec<Point>>,
    robot: Option<RobotId>,
    robots: Option<Vec<RobotId>>,
    obstacles: Option<Vec<Obstacle>>,
    area: Option<Region>,
}

/// The details of an event, in order.
pub(crate) fn fields(list: Vec<Field>) -> Result<Fields, Malformed> {
    list.into_iter()
        .map(|field| Ok((field.name.clone().into(), value(field)?)))
        .collect()
}

fn value(field: Field) -> Result<Value, Malformed> {
    let name = field.name;
    let special = match field.not_finite.as_deref() {
        None => None,
        Some("nan") => Some(f64::NAN),
        Some("inf") => Some(f64::INFINITY),
        Some("-inf") => Some(f64::NEG_INFINITY),
        Some(_) => {
            let what = format!("`not_finite` of `{name}` is not nan, inf or -inf");
            return Err(Malformed(what));
        }
    };
    let candidates = [
        field.bool.map(Value::Bool),
        field.int.map(Value::Int),
        field.float.or(special).map(Value::Float),
        field.text.map(|text| Value::Text(text.into())),
        field.time_ns.map(|at| Value::Time(Time(at))),
        field.point.map(Value::Point),
        field.path.map(Value::Path),
        field.robot.map(Value::Robot),
        field.robots.map(Value::Robots),
        field
            .obstacles
            .map(obstacles)
            .transpose()?
            .map(|list| Value::Obstacles(list.into())),
        field.area.map(Area::try_from).transpose()?.map(Value::from),
    ];
    let mut present = candidates.into_iter().flatten();
    match (present.next(), present.next()) {
        (Some(value), None) => Ok(value),
        _ => Err(Malformed(format!("`{name}` needs exactly one value"))),
    }
}

/// A drawn mark.
#[derive(Deserialize)]
pub(crate) struct Mark {
    shape: String,
    #[serde(default)]
    points: Vec<Point>,
    radius: Option<f64>,
}

impl TryFrom<Mark> for MarkShape {
    type Error = Malformed;
    fn try_from(mark: Mark) -> Result<MarkShape, Malformed> {
        match (mark.shape.as_str(), mark.points.as_slice(), mark.radius) {
            ("nothing", [], None) => Ok(MarkShape::Nothing),
            ("dot", &[at], None) => Ok(MarkShape::Dot(at)),
            ("circle", &[center], Some(radius)) => Ok(MarkShape::Circle { center, radius }),
            ("line", _, None) => Ok(MarkShape::Line(mark.points)),
            ("text", &[at], None) => Ok(MarkShape::Text(at)),
            (shape, ..) => Err(Malformed(format!(
                "`{shape}` is not a shape with these points and radius"
            ))),
        }
    }
}

#[derive(Deserialize)]
struct Circle {
    center: Point,
    radius: f64,
}

#[derive(Deserialize)]
struct Corners {
    low: Point,
    high: Point,
}

/// An area, or the base of an obstacle.
#[derive(Deserialize)]
struct Region {
    circle: Option<Circle>,
    polygon: Option<Vec<Point>>,
    #[serde(rename = "box")]
    corners: Option<Corners>,
}

impl TryFrom<Region> for Area {
    type Error = Malformed;
    fn try_from(region: Region) -> Result<Area, Malformed> {
        match region {
            Region {
                circle: Some(Circle { center, radius }),
                polygon: None,
                corners: None,
            } => Ok(Area::Circle { center, radius }),
            Region {
                circle: None,
                polygon: Some(points),
                corners: None,
            } => Ok(Area::Polygon(polygon(&points)?)),
            Region {
                circle: None,
                polygon: None,
                corners: Some(Corners { low, high }),
            } => Ok(Area::Box { low, high }),
            _ => Err("an area needs exactly one of `circle`, `polygon` and `box`".into()),
        }
    }
}

/// An obstacle.
#[derive(Deserialize)]
pub(crate) struct Obstacle {
    #[serde(flatten)]
    base: Region,
    height: Option<HeightSpan>,
}

impl TryFrom<Obstacle> for starl_core::Obstacle {
    type Error = Malformed;
    fn try_from(Obstacle { base, height }: Obstacle) -> Result<starl_core::Obstacle, Malformed> {
        let shape = match (Area::try_from(base)?, height) {
            (Area::Circle { center, radius }, height) => Shape::Circle {
                center,
                radius,
                height,
            },
            (Area::Polygon(base), height) => Shape::Polygon { base, height },
            (Area::Box { low, high }, None) => Shape::Cuboid { low, high },
            (Area::Box { .. }, Some(_)) => return Err("a box has its height already".into()),
        };
        Ok(starl_core::Obstacle { shape })
    }
}

/// Obstacles in order.
pub(crate) fn obstacles(list: Vec<Obstacle>) -> Result<Vec<starl_core::Obstacle>, Malformed> {
    list.into_iter().map(TryInto::try_into).collect()
}

fn polygon(points: &[Point]) -> Result<ConvexPolygon, Malformed> {
    ConvexPolygon::new(points).map_err(|error| Malformed(error.to_string()))
}
