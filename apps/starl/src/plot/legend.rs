//! The legend, to the right of the world, in as many columns as it takes.

use super::drawing::{Anchor, Drawing, Fill, Shape, Spot, Stroke};
use super::extent;
use super::frame::Frame;
use super::labels::{short_name, text_width};
use super::looks::{Looks, MOST_COLORS, body_look};
use super::palette::{INK, OBSTACLE, OBSTACLE_EDGE, WAY_POINT};
use super::{PlotData, ranges, signs, times};
use crate::console::grouped;

/// Height of a row.
const ROW: f64 = 20.0;
/// Height of its text.
const SIZE: f64 = 12.5;
/// Width of a sample.
const SAMPLE: f64 = 30.0;
/// Width between a sample and its text, and between columns.
const GAP: f64 = 8.0;
/// A column has at least so many rows.
const LEAST_ROWS: usize = 10;

/// The sample of a row, before its text.
enum Sample {
    Nothing,
    Path(Stroke),
    Disc(f64, Option<Fill>, Option<Stroke>),
    Obstacle,
    Thing { is_gone: bool },
    Collision,
    Crash,
    Beyond,
}

type Row = (Sample, String);

/// Draws the legend with its upper left corner at a spot, in columns that are about as high as the world's part of
/// the picture; gives the lower right corner of the room that it takes.
pub fn draw(
    drawing: &mut Drawing,
    data: &PlotData,
    frame: &Frame,
    looks: &Looks,
    (left, top): Spot,
) -> Spot {
    let mut rows = robots(data, looks);
    rows.extend(motion(data));
    rows.extend(world(data, frame));
    let (upper, lower) = frame.corners();
    let height = (((lower.1 - upper.1) / ROW) as usize).max(LEAST_ROWS);
    let mut x = left;
    for column in rows.chunks(height) {
        let mut y = top + ROW / 2.0;
        let mut width: f64 = 0.0;
        for (sample, label) in column {
            sample.draw(drawing, (x, y));
            let at = (x + SAMPLE + GAP, y + 4.5);
            drawing.text(at, Anchor::Start, label, SIZE, INK);
            width = width.max(text_width(label, SIZE));
            y += ROW;
        }
        x += SAMPLE + GAP + width + GAP * 2.0;
    }
    let longest = rows.len().min(height) as f64;
    (x, top + ROW * longest)
}

/// The robots, one by one or by model.
fn robots(data: &PlotData, looks: &Looks) -> Vec<Row> {
    let mut rows = Vec::new();
    if !looks.by_model {
        for (index, robot) in data.robots.iter().enumerate() {
            let name = short_name(&robot.name);
            let label = match robot.name.starts_with(&robot.model) || robot.model.is_empty() {
                true => name,
                false => format!("{name} ({})", robot.model),
            };
            rows.push((Sample::Path(looks.stroke(index, robot)), label));
        }
        return rows;
    }
    for model in looks.models.iter().take(MOST_COLORS) {
        let alike = || data.robots.iter().filter(|robot| robot.model == *model);
        if let Some(robot) = alike().next() {
            // As its paths look, but easy to see alone.
            let stroke = Stroke {
                width: 1.8,
                opacity: 1.0,
                ..looks.stroke(0, robot)
            };
            let label = format!("{model} \u{d7} {}", alike().count());
            rows.push((Sample::Path(stroke), label));
        }
    }
    if looks.models.len() > MOST_COLORS {
        let more = looks.models.len() - MOST_COLORS;
        rows.push((Sample::Nothing, format!("and {more} more models")));
    }
    rows
}

/// How motion, detectors and radio are drawn.
fn motion(data: &PlotData) -> Vec<Row> {
    let mut rows = Vec::new();
    let shows = |path: &[super::Place]| path.iter().any(|place| extent::shows(&place.position));
    if !data.robots.iter().any(|robot| shows(&robot.path)) {
        return rows;
    }
    let flying = data.robots.iter().filter(|robot| robot.flies).count();
    if flying > 0 && flying < data.robots.len() {
        let dashed = Stroke {
            dashed: true,
            ..Stroke::solid(INK, 1.8)
        };
        rows.push((Sample::Path(dashed), "flying".into()));
    }
    let (fill, outline) = body_look(Stroke::solid(INK, 1.5));
    rows.push((Sample::Disc(6.0, None, Some(outline)), "start".into()));
    rows.push((Sample::Disc(6.0, Some(fill), Some(outline)), "end".into()));
    if let Some(step) = times::step(data) {
        let dot = Sample::Disc(times::RADIUS, Some(Fill::solid(INK)), None);
        rows.push((dot, format!("every {}", times::seconds_text(step))));
    }
    let not_drawn = match ranges::are_drawn(data) {
        true => "",
        false => " (not drawn)",
    };
    let mut detectors: Vec<f64> = data
        .robots
        .iter()
        .filter_map(|robot| robot.detector)
        .filter(|range| ranges::is_length(*range))
        .collect();
    detectors.sort_by(f64::total_cmp);
    detectors.dedup();
    if let [least, .., most] | [least @ most] = detectors[..] {
        let length = match least == most {
            true => metres(least),
            false => format!("{} to {}", metres(least), metres(most)),
        };
        let thin = Stroke::solid(INK, 0.8);
        let sample = Sample::Disc(7.0, Some(ranges::seen(INK)), Some(thin));
        rows.push((sample, format!("detector, {length}{not_drawn}")));
    }
    if let Some(range) = data.radio_range.filter(|range| ranges::is_length(*range)) {
        let sample = Sample::Disc(8.0, None, Some(ranges::radio(INK)));
        rows.push((sample, format!("radio, {}{not_drawn}", metres(range))));
    }
    rows
}

/// The signs for the world and for events.
fn world(data: &PlotData, frame: &Frame) -> Vec<Row> {
    let mut rows = Vec::new();
    if !data.way_points.is_empty() {
        let shown = data.way_points.iter();
        let shown = shown
            .filter(|way_point| frame.has(&way_point.position))
            .count();
        let all = data.way_points.len();
        let label = match shown == all {
            true => "waypoint".into(),
            false => format!("waypoint, {shown} of {all} shown"),
        };
        let sample = Sample::Disc(6.0, None, Some(Stroke::solid(WAY_POINT, 2.2)));
        rows.push((sample, label));
    }
    if !data.obstacles.is_empty() {
        rows.push((Sample::Obstacle, "obstacle".into()));
    }
    for (is_gone, label) in [(false, "thing"), (true, "thing was here")] {
        if data.things.iter().any(|thing| thing.is_gone == is_gone) {
            rows.push((Sample::Thing { is_gone }, label.into()));
        }
    }
    let events = [
        (Sample::Collision, "collision", data.collisions.len()),
        (Sample::Crash, "crash", data.crashes.len()),
    ];
    for (sample, label, count) in events {
        if count > 0 {
            rows.push((sample, format!("{label} \u{d7} {}", grouped(count as u64))));
        }
    }
    if let Some((width, height)) = frame.world {
        let size = format!("{} by {}", metres(width), metres(height));
        rows.push((Sample::Beyond, format!("more world: {size}")));
    }
    rows
}

/// A length with as many digits as matter.
fn metres(length: f64) -> String {
    match length {
        length if length < 10.0 => format!("{} m", (length * 100.0).round() / 100.0),
        length if length < 1e4 => format!("{} m", (length * 10.0).round() / 10.0),
        length => format!("{} km", (length / 100.0).round() / 10.0),
    }
}

impl Sample {
    fn draw(&self, drawing: &mut Drawing, (x, y): Spot) {
        let center = (x + SAMPLE / 2.0, y);
        match *self {
            Sample::Nothing => {}
            Sample::Path(stroke) => drawing.line(vec![(x, y), (x + SAMPLE, y)], stroke),
            Sample::Disc(radius, fill, stroke) => drawing.push(Shape::Circle {
                center,
                radius,
                fill,
                stroke,
            }),
            Sample::Obstacle => drawing.push(Shape::Line {
                points: vec![
                    (x + 6.0, y - 6.0),
                    (x + 24.0, y - 6.0),
                    (x + 24.0, y + 6.0),
                    (x + 6.0, y + 6.0),
                ],
                closed: true,
                fill: Some(Fill::solid(OBSTACLE)),
                stroke: Some(Stroke::solid(OBSTACLE_EDGE, 1.0)),
            }),
            Sample::Thing { is_gone } => signs::thing(drawing, center, is_gone),
            Sample::Collision => signs::collision(drawing, center),
            Sample::Crash => signs::crash(drawing, center),
            Sample::Beyond => super::frame::arrow(drawing, (center.0 + 5.0, y), (1.0, 0.0)),
        }
    }
}
