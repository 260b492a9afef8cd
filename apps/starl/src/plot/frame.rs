//! The part of the world that is shown, where it lies in the picture, and its axes.

use super::drawing::{Anchor, Drawing, Fill, Shape, Spot, Stroke};
use super::labels::text_width;
use super::palette::{GRID, INK, WHITE};
use super::{PlotData, extent};
use starl_core::Point;

/// The largest width and height of the world's part of the picture.
const LARGEST: f64 = 600.0;
/// Worlds are not shown narrower than this part of their length.
const NARROWEST: f64 = 0.3;
/// Room to the left of the world's part, at least, and above it, for text.
const MARGIN: (f64, f64) = (58.0, 62.0);
/// Height of the numbers at the axes.
const SIZE: f64 = 12.0;

/// Maps the world to the picture with one scale for both axes.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// The corner with the least coordinates, metres.
    low: (f64, f64),
    /// The corner with the greatest coordinates, metres.
    high: (f64, f64),
    /// Units of the picture in a metre.
    pub scale: f64,
    /// Width and height of the whole world, if more of it lies beyond the edge.
    pub world: Option<(f64, f64)>,
    /// Whether there is more world to the left, to the right, above and below.
    beyond: [bool; 4],
    /// Where the world's part begins in the picture.
    left: f64,
}

impl Frame {
    /// A frame around everything shown.
    pub fn around(data: &PlotData) -> Frame {
        let extent::Extent { low, high, world } = extent::of(data);
        let longest = (high.0 - low.0).max(high.1 - low.1);
        let widen = |low: f64, high: f64| {
            let missing = (longest * NARROWEST - (high - low)).max(0.0) / 2.0;
            (low - missing, high + missing)
        };
        let (x, y) = (widen(low.0, high.0), widen(low.1, high.1));
        let beyond = world.map_or([false; 4], |(least, most)| {
            [least.0 < x.0, most.0 > x.1, most.1 > y.1, least.1 < y.0]
        });
        let mut frame = Frame {
            low: (x.0, y.0),
            high: (x.1, y.1),
            scale: LARGEST / longest,
            world: world.map(|(low, high)| (high.0 - low.0, high.1 - low.1)),
            beyond,
            left: MARGIN.0,
        };
        let numbers = frame.numbers(y).map(|(_, label)| text_width(&label, SIZE));
        frame.left = numbers.fold(MARGIN.0, |most, width| most.max(width + 14.0));
        frame
    }

    /// Whether a point is in the shown part of the world.
    pub fn has(&self, point: &Point) -> bool {
        let within = |low: f64, at: f64, high: f64| low <= at && at <= high;
        within(self.low.0, point.x, self.high.0) && within(self.low.1, point.y, self.high.1)
    }

    /// Where a point of the world is in the picture.
    pub fn spot(&self, point: Point) -> Spot {
        let x = self.left + (point.x - self.low.0) * self.scale;
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

    /// The coordinates that have a number at the axis, from the first to the second.
    fn numbers(&self, (low, high): (f64, f64)) -> impl Iterator<Item = (f64, String)> + use<> {
        let step = step_for((self.high.0 - self.low.0).max(self.high.1 - self.low.1));
        ticks(low, high, step).map(move |at| (at, label(at, step)))
    }

    /// Lines and numbers at regular distances, and the edge.
    pub fn draw_axes(&self, drawing: &mut Drawing) {
        let ((left, top), (right, bottom)) = self.corners();
        let (thin, ink) = (Stroke::solid(GRID, 1.0), Stroke::solid(INK, 1.0));
        let mut free = f64::NEG_INFINITY;
        for (x, number) in self.numbers((self.low.0, self.high.0)) {
            let at = self.spot(Point::planar(x, 0.0)).0;
            drawing.line(vec![(at, top), (at, bottom)], thin);
            drawing.line(vec![(at, bottom), (at, bottom + 4.0)], ink);
            let half = text_width(&number, SIZE) / 2.0;
            if at - half > free {
                free = at + half + 4.0;
                drawing.text((at, bottom + 17.0), Anchor::Middle, number, SIZE, INK);
            }
        }
        for (y, number) in self.numbers((self.low.1, self.high.1)) {
            let at = self.spot(Point::planar(0.0, y)).1;
            drawing.line(vec![(left, at), (right, at)], thin);
            drawing.line(vec![(left - 4.0, at), (left, at)], ink);
            drawing.text((left - 8.0, at + 4.0), Anchor::End, number, SIZE, INK);
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

    /// The edge, above everything that extends beyond it.
    pub fn draw_edge(&self, drawing: &mut Drawing) {
        let ((left, top), (right, bottom)) = self.corners();
        drawing.push(Shape::Line {
            points: vec![(left, top), (right, top), (right, bottom), (left, bottom)],
            closed: true,
            fill: None,
            stroke: Some(Stroke::solid(INK, 1.0)),
        });
        let [to_left, to_right, above, below] = self.beyond;
        let sides = [
            (to_left, (-1.0, 0.0)),
            (to_right, (1.0, 0.0)),
            (above, (0.0, -1.0)),
            (below, (0.0, 1.0)),
        ];
        for (_, direction) in sides.into_iter().filter(|(is_more, _)| *is_more) {
            for share in [0.25, 0.75] {
                let along = |low: f64, high: f64, to: f64| match to {
                    0.0 => low + (high - low) * share,
                    to if to < 0.0 => low + 3.0,
                    _ => high - 3.0,
                };
                let tip = (
                    along(left, right, direction.0),
                    along(top, bottom, direction.1),
                );
                arrow(drawing, tip, direction);
            }
        }
    }
}

/// An arrow head with its tip at a spot: there is more world in this direction.
pub fn arrow(drawing: &mut Drawing, tip: Spot, (dx, dy): (f64, f64)) {
    let (length, half) = (10.0, 6.0);
    let corner = |side: f64| {
        let (back, across) = (-length, side * half);
        (
            tip.0 + back * dx - across * dy,
            tip.1 + back * dy + across * dx,
        )
    };
    drawing.push(Shape::Line {
        points: vec![tip, corner(1.0), corner(-1.0)],
        closed: true,
        fill: Some(Fill::solid(INK)),
        stroke: Some(Stroke::solid(WHITE, 1.0)),
    });
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
