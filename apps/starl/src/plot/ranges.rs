//! Circles around where each robot is at the end: how far its detector sees, and how far its radio reaches.

use super::PlotData;
use super::drawing::{Drawing, Fill, Shape, Stroke};
use super::extent;
use super::frame::Frame;
use super::looks::{Looks, MOST_COLORS};

/// Line of a circle of radio range; `color` is that of the robot.
pub fn radio(color: [u8; 3]) -> Stroke {
    Stroke {
        width: 1.0,
        opacity: 0.7,
        dashed: true,
        ..Stroke::solid(color, 1.0)
    }
}

/// Inside of the disc that a detector sees.
pub fn seen(color: [u8; 3]) -> Fill {
    Fill {
        color,
        opacity: 0.08,
    }
}

/// Whether a range has a length that can be drawn.
pub fn is_length(range: f64) -> bool {
    (0.0..1e12).contains(&range)
}

/// Whether the ranges of this fleet are drawn: those of a large fleet would hide all else.
pub fn are_drawn(data: &PlotData) -> bool {
    data.robots.len() <= MOST_COLORS
}

/// Draws the ranges.
pub fn draw(drawing: &mut Drawing, frame: &Frame, data: &PlotData, looks: &Looks) {
    if !are_drawn(data) {
        return;
    }
    for (index, robot) in data.robots.iter().enumerate() {
        let mut shown = robot.path.iter().rev();
        let Some(last) = shown.find(|place| extent::shows(&place.position)) else {
            continue;
        };
        let color = looks.stroke(index, robot).color;
        let mut circle = |range: Option<f64>, fill, stroke| {
            let Some(range) = range.filter(|range| is_length(*range)) else {
                return;
            };
            drawing.push(Shape::Circle {
                center: frame.spot(last.position),
                radius: range * frame.scale,
                fill,
                stroke: Some(stroke),
            });
        };
        let thin = Stroke {
            opacity: 0.5,
            ..Stroke::solid(color, 0.8)
        };
        circle(robot.detector, Some(seen(color)), thin);
        circle(data.radio_range, None, radio(color));
    }
}
