//! Reads the lines of an SVG drawing as waypoints: each line is a stroke, a group of its own.
//!
//! One unit of the drawing is a millimetre, as in the other world files. Its lower left corner is the
//! origin, and y points up. Curves become straight lines no longer than about [`STEP`].

use super::super::Placed;
use super::super::contents::Contents;
use super::super::report::{Origin, Report};
use roxmltree::{Document, Node};
use starl_core::{Point, WayPoint, math};
use std::f64::consts::TAU;
use std::str::FromStr;
use svgtypes::{PointsParser, SimplePathSegment, SimplifyingPathParser, Transform, ViewBox};
use thiserror::Error;

/// How long the straight lines are that curves are made of, millimetres.
const STEP: f64 = 50.0;

/// No curve becomes more lines than this.
const MOST: f64 = 256.0;

/// Elements that draw, but not lines.
const NOT_LINES: [&str; 3] = ["image", "text", "use"];

/// Why the lines of an element cannot be read.
#[derive(Debug, Error)]
enum DrawingError {
    #[error("`{0}` has no lines that robots could follow; make it a path")]
    NoLines(String),
    #[error("{name}={text:?} is not a number; give millimetres, without a unit")]
    NotNumber { name: &'static str, text: String },
    #[error("the path cannot be read: {0}")]
    Path(#[from] svgtypes::Error),
    #[error("transform={text:?} cannot be read: {error}")]
    Transform {
        text: String,
        error: svgtypes::Error,
    },
}

/// A stroke's points in units of the drawing.
type Stroke = Vec<(f64, f64)>;

/// Adds the strokes of a drawing to the waypoints. They are numbered on from the groups that there are.
pub(super) fn read(text: &str, start: Origin, contents: &mut Contents, report: &Report) {
    let at = |offset: usize| Origin {
        offset: offset as u32,
        ..start
    };
    let text = text.trim_start_matches('\u{feff}');
    let document = match Document::parse(text) {
        Ok(document) => document,
        Err(error) => {
            let message = format!("this is not a drawing in SVG: {error}");
            return report.problem(start, "", message);
        }
    };
    let root = document.root_element();
    let Some((left, bottom)) = lower_left(root) else {
        let help =
            r#"give the element `svg` a viewBox such as viewBox="0 0 4000 3000", millimetres"#;
        return report.problem_with_help(
            at(root.range().start),
            "",
            "the drawing has no size",
            help,
        );
    };
    for node in root.descendants().filter(Node::is_element) {
        let origin = at(node.range().start);
        let read = strokes(node).and_then(|strokes| Ok((strokes, transform_of(node)?)));
        let (strokes, transform) = match read {
            Ok(read) => read,
            Err(error) => {
                report.problem(origin, "", error.to_string());
                continue;
            }
        };
        for stroke in strokes.into_iter().filter(|stroke| !stroke.is_empty()) {
            let placed = stroke.into_iter().map(|(x, y)| {
                let (x, y) = applied(transform, x, y);
                Point::planar((x - left) / 1000.0, (bottom - y) / 1000.0)
            });
            add(placed, origin, contents);
        }
    }
}

/// The group after the greatest so far.
pub(super) fn next_group(contents: &Contents) -> u32 {
    let groups = contents.way_points.iter().map(|placed| placed.value.group);
    groups.max().unwrap_or(0).saturating_add(1)
}

fn add(points: impl Iterator<Item = Point>, origin: Origin, contents: &mut Contents) {
    let group = next_group(contents);
    for (index, position) in points.enumerate() {
        let way_point = WayPoint {
            name: format!("stroke{group}.{index}"),
            position,
            group,
        };
        contents.way_points.push(Placed::in_file(origin, way_point));
    }
}

/// The left and the lower edge, in units of the drawing.
fn lower_left(svg: Node<'_, '_>) -> Option<(f64, f64)> {
    if let Some(shown) = svg.attribute("viewBox") {
        let shown = ViewBox::from_str(shown).ok()?;
        return Some((shown.x, shown.y + shown.h));
    }
    svg.attribute("height")?;
    Some((0.0, number(svg, "height").ok()?))
}

/// The strokes of an element.
fn strokes(node: Node<'_, '_>) -> Result<Vec<Stroke>, DrawingError> {
    let get = |name| number(node, name);
    let name = node.tag_name().name();
    Ok(match name {
        "path" => path(node.attribute("d").unwrap_or_default())?,
        "polyline" => vec![points(node)],
        "polygon" => vec![closed(points(node))],
        "line" => vec![vec![(get("x1")?, get("y1")?), (get("x2")?, get("y2")?)]],
        "rect" => {
            let (x, y, width, height) = (get("x")?, get("y")?, get("width")?, get("height")?);
            let (right, low) = (x + width, y + height);
            vec![closed(vec![(x, y), (right, y), (right, low), (x, low)])]
        }
        "circle" => vec![ellipse(get("cx")?, get("cy")?, get("r")?, get("r")?)],
        "ellipse" => vec![ellipse(get("cx")?, get("cy")?, get("rx")?, get("ry")?)],
        _ if NOT_LINES.contains(&name) => return Err(DrawingError::NoLines(name.into())),
        _ => Vec::new(),
    })
}

/// A number without a unit; 0 if it is left out.
fn number(node: Node<'_, '_>, name: &'static str) -> Result<f64, DrawingError> {
    let Some(text) = node.attribute(name) else {
        return Ok(0.0);
    };
    match text.trim().parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => {
            let text = text.into();
            Err(DrawingError::NotNumber { name, text })
        }
    }
}

fn points(node: Node<'_, '_>) -> Stroke {
    PointsParser::from(node.attribute("points").unwrap_or_default()).collect()
}

fn closed(mut stroke: Stroke) -> Stroke {
    stroke.extend(stroke.first().copied());
    stroke
}

fn ellipse(x: f64, y: f64, across: f64, down: f64) -> Stroke {
    let count = pieces(TAU * across.abs().max(down.abs())).max(8.0);
    let corner = |index: u32| {
        let angle = TAU * f64::from(index) / count;
        (x + across * math::cos(angle), y + down * math::sin(angle))
    };
    closed((0..count as u32).map(corner).collect())
}

/// How many straight lines stand for a curve of this length.
fn pieces(length: f64) -> f64 {
    (length / STEP).ceil().clamp(1.0, MOST)
}

/// The strokes of a path: one for each time that the pen is put down.
fn path(data: &str) -> Result<Vec<Stroke>, DrawingError> {
    let mut strokes: Vec<Stroke> = Vec::new();
    for segment in SimplifyingPathParser::from(data) {
        let segment = segment?;
        if let SimplePathSegment::MoveTo { x, y } = segment {
            strokes.push(vec![(x, y)]);
            continue;
        }
        let Some(stroke) = strokes.last_mut() else {
            continue;
        };
        let (Some(&first), Some(&from)) = (stroke.first(), stroke.last()) else {
            continue;
        };
        match segment {
            SimplePathSegment::MoveTo { .. } => {}
            SimplePathSegment::LineTo { x, y } => stroke.push((x, y)),
            SimplePathSegment::ClosePath => stroke.push(first),
            SimplePathSegment::Quadratic { x1, y1, x, y } => {
                curve(stroke, &[from, (x1, y1), (x, y)])
            }
            SimplePathSegment::CurveTo {
                x1,
                y1,
                x2,
                y2,
                x,
                y,
            } => {
                curve(stroke, &[from, (x1, y1), (x2, y2), (x, y)]);
            }
        }
    }
    Ok(strokes)
}

/// Adds a Bézier curve, without its first point.
fn curve(stroke: &mut Stroke, controls: &[(f64, f64)]) {
    let length = |pair: &[(f64, f64)]| {
        let (x, y) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        (x * x + y * y).sqrt()
    };
    let count = pieces(controls.windows(2).map(length).sum());
    for piece in 1..=count as u32 {
        stroke.push(on_curve(controls, f64::from(piece) / count));
    }
}

/// De Casteljau's construction.
fn on_curve(controls: &[(f64, f64)], share: f64) -> (f64, f64) {
    let mut points = controls.to_vec();
    while points.len() > 1 {
        for index in 1..points.len() {
            let ((x0, y0), (x1, y1)) = (points[index - 1], points[index]);
            points[index - 1] = (x0 + (x1 - x0) * share, y0 + (y1 - y0) * share);
        }
        points.pop();
    }
    points[0]
}

/// The transforms of an element and all around it.
fn transform_of(node: Node<'_, '_>) -> Result<Transform, DrawingError> {
    let mut whole = Transform::default();
    for outer in node.ancestors() {
        if let Some(text) = outer.attribute("transform") {
            let own = Transform::from_str(text).map_err(|error| {
                let text = text.into();
                DrawingError::Transform { text, error }
            })?;
            whole = joined(own, whole);
        }
    }
    Ok(whole)
}

/// The transform that applies `inner` first, then `outer`.
fn joined(outer: Transform, inner: Transform) -> Transform {
    let Transform { a, b, c, d, e, f } = inner;
    let turned = |x: f64, y: f64| (outer.a * x + outer.c * y, outer.b * x + outer.d * y);
    let ((a, b), (c, d), (x, y)) = (turned(a, b), turned(c, d), turned(e, f));
    Transform::new(a, b, c, d, x + outer.e, y + outer.f)
}

fn applied(t: Transform, x: f64, y: f64) -> (f64, f64) {
    (t.a * x + t.c * y + t.e, t.b * x + t.d * y + t.f)
}
