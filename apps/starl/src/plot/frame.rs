//! The part of the world that is shown, where it lies in the picture, and its axes.

use super::PlotData;
use super::drawing::{Anchor, Drawing, Shape, Spot, Stroke};
use super::palette::{GRID, INK};
use starl_core::Point;
use starl_core::geometry::Bounds;

/// The largest width and height of the world's part of the picture.
const LARGEST: f64 = 600.0;
/// Worlds are not shown narrower than this part of their length.
const NARROWEST: f64 = 0.3;
/// Room to the left of and above the world's part, for text.
const MARGIN: (f64, f64) = (58.0, 62.0);

/// Maps the world to the picture with one scale for both axes.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// The corner with the least coordinates, metres.
    low: (f64, f64),
    /// The corner with the greatest coordinates, metres.
    high: (f64, f64),
    /// Units of the picture in a metre.
    pub scale: f64,
}

impl Frame {
    /// A frame around all that is to be shown.
    pub fn around(data: &PlotData) -> Frame {
        let (low, high) = extent(data);
        let (width, height) = (high.0 - low.0, high.1 - low.1);
        let longest = width.max(height);
        let widen = |low: f64, high: f64| {
            let missing = (longest * NARROWEST - (high - low)).max(0.0) / 2.0;
            (low - missing, high + missing)
        };
        let (x, y) = (widen(low.0, high.0), widen(low.1, high.1));
        Frame {
            low: (x.0, y.0),
            high: (x.1, y.1),
            scale: LARGEST / longest,
        }
    }

    /// Whether a point can be shown: beyond this, differences of coordinates mean nothing any more.
    pub fn shows(point: &Point) -> bool {
        point.x.abs() < 1e12 && point.y.abs() < 1e12
    }

    /// Where a point of the world is in the picture.
    pub fn spot(&self, point: Point) -> Spot {
        let x = MARGIN.0 + (point.x - self.low.0) * self.scale;
        let y = MARGIN.1 + (self.high.1 - point.y) * self.scale;
        (x, y)
    }

    /// The upper left and the lower right corner of the world's part of the picture.
    pub fn corners(&self) -> (Spot, Spot) {
        let (low, high) = (
            Point::planar(self.low.0, self.high.1),
            Point::planar(self.high.0, self.low.1),
        );
        (self.spot(low), self.spot(high))
    }

    /// Lines and numbers every so many metres, and the edge.
    pub fn draw_axes(&self, drawing: &mut Drawing) {
        let ((left, top), (right, bottom)) = self.corners();
        let step = step_for((self.high.0 - self.low.0).max(self.high.1 - self.low.1));
        let thin = Stroke::solid(GRID, 1.0);
        for x in ticks(self.low.0, self.high.0, step) {
            let at = self.spot(Point::planar(x, 0.0)).0;
            drawing.line(vec![(at, top), (at, bottom)], thin);
            drawing.line(
                vec![(at, bottom), (at, bottom + 4.0)],
                Stroke::solid(INK, 1.0),
            );
            drawing.text(
                (at, bottom + 17.0),
                Anchor::Middle,
                label(x, step),
                12.0,
                INK,
            );
        }
        for y in ticks(self.low.1, self.high.1, step) {
            let at = self.spot(Point::planar(0.0, y)).1;
            drawing.line(vec![(left, at), (right, at)], thin);
            drawing.line(vec![(left - 4.0, at), (left, at)], Stroke::solid(INK, 1.0));
            drawing.text(
                (left - 8.0, at + 4.0),
                Anchor::End,
                label(y, step),
                12.0,
                INK,
            );
        }
        drawing.text(
            ((left + right) / 2.0, bottom + 36.0),
            Anchor::Middle,
            "x in metres",
            12.0,
            INK,
        );
        drawing.text(
            (left - 44.0, top - 10.0),
            Anchor::Start,
            "y in metres",
            12.0,
            INK,
        );
    }

    /// The edge, over all that reaches beyond it.
    pub fn draw_edge(&self, drawing: &mut Drawing) {
        let ((left, top), (right, bottom)) = self.corners();
        drawing.push(Shape::Line {
            points: vec![(left, top), (right, top), (right, bottom), (left, bottom)],
            closed: true,
            fill: None,
            stroke: Some(Stroke::solid(INK, 1.0)),
        });
    }
}

/// The smallest rectangle around all that is to be shown, with room at the edges.
fn extent(data: &PlotData) -> ((f64, f64), (f64, f64)) {
    let mut low = (f64::INFINITY, f64::INFINITY);
    let mut high = (f64::NEG_INFINITY, f64::NEG_INFINITY);
    let mut include = |point: Point, reach: f64| {
        if Frame::shows(&point) && reach.abs() < 1e12 {
            low = (low.0.min(point.x - reach), low.1.min(point.y - reach));
            high = (high.0.max(point.x + reach), high.1.max(point.y + reach));
        }
    };
    if let Some((a, b)) = data.arena {
        include(a, 0.0);
        include(b, 0.0);
    }
    for obstacle in &data.obstacles {
        let Bounds { low, high } = obstacle.bounds();
        include(low, 0.0);
        include(high, 0.0);
    }
    for way_point in &data.way_points {
        include(way_point.position, 0.0);
    }
    for robot in &data.robots {
        for &point in &robot.path {
            include(point, robot.radius);
        }
    }
    for &point in &data.collisions {
        include(point, 0.0);
    }
    if low.0 > high.0 {
        return ((-1.0, -1.0), (1.0, 1.0));
    }
    let room = match (high.0 - low.0).max(high.1 - low.1) {
        size if size > 0.0 => size * 0.04,
        _ => 1.0,
    };
    ((low.0 - room, low.1 - room), (high.0 + room, high.1 + room))
}

/// A step of 1, 2 or 5 times a power of ten that gives four to eleven ticks over a length.
pub fn step_for(length: f64) -> f64 {
    let rough = length / 10.0;
    let power = 10f64.powf(rough.log10().floor());
    let factor = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .find(|factor| factor * power >= rough);
    factor.unwrap_or(10.0) * power
}

/// The multiples of `step` from `low` to `high`.
pub fn ticks(low: f64, high: f64, step: f64) -> impl Iterator<Item = f64> {
    let (first, last) = ((low / step).ceil(), (high / step).floor());
    let count = if last >= first {
        (last - first).min(100.0) as u32 + 1
    } else {
        0
    };
    (0..count).map(move |number| (first + f64::from(number)) * step)
}

/// A tick's number, with as many decimals as its step has.
pub fn label(value: f64, step: f64) -> String {
    let decimals = (-step.log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    if text
        .trim_start_matches('-')
        .chars()
        .all(|digit| digit == '0' || digit == '.')
    {
        return text.trim_start_matches('-').into();
    }
    text.replace('-', "\u{2212}")
}
