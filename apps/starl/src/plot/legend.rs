//! The legend, to the right of the world.

use super::PlotData;
use super::drawing::{Anchor, Drawing, Fill, Shape, Spot, Stroke};
use super::frame::Frame;
use super::palette::{BLACK, INK, OBSTACLE, OBSTACLE_EDGE, WAY_POINT};
use super::scene::{Looks, MOST_COLORS, body_look};

/// Height of a row.
const ROW: f64 = 20.0;
/// Height of its text.
const SIZE: f64 = 12.5;
/// Width of a sample.
const SAMPLE: f64 = 30.0;

/// About how wide a text is: exact widths depend on the viewer's font.
pub fn text_width(text: &str, size: f64) -> f64 {
    text.chars().count() as f64 * size * 0.6
}

/// Draws the legend with its upper left corner at a spot; gives the lower right corner of the room
/// that it takes.
pub fn draw(drawing: &mut Drawing, data: &PlotData, looks: &Looks, (left, top): Spot) -> Spot {
    let mut rows = Rows {
        left,
        y: top + ROW / 2.0,
        right: left,
    };
    if looks.by_model {
        for model in looks.models.iter().take(MOST_COLORS) {
            let alike = || data.robots.iter().filter(|robot| robot.model == *model);
            if let Some(robot) = alike().next() {
                // As its paths look, but easy to see alone.
                let stroke = Stroke {
                    width: 1.8,
                    opacity: 1.0,
                    ..looks.stroke(0, robot)
                };
                rows.path(
                    drawing,
                    stroke,
                    &format!("{model} \u{d7} {}", alike().count()),
                );
            }
        }
        if looks.models.len() > MOST_COLORS {
            let more = looks.models.len() - MOST_COLORS;
            rows.label(drawing, &format!("and {more} more models"));
        }
    } else {
        for (index, robot) in data.robots.iter().enumerate() {
            let label = if robot.name.starts_with(&robot.model) || robot.model.is_empty() {
                robot.name.clone()
            } else {
                format!("{} ({})", robot.name, robot.model)
            };
            rows.path(drawing, looks.stroke(index, robot), &label);
        }
    }
    if data
        .robots
        .iter()
        .any(|robot| robot.path.iter().any(Frame::shows))
    {
        rows.y += ROW / 2.0;
        let flying = data.robots.iter().filter(|robot| robot.flies).count();
        if flying > 0 && flying < data.robots.len() {
            rows.path(
                drawing,
                Stroke {
                    dashed: true,
                    ..Stroke::solid(INK, 1.8)
                },
                "flying",
            );
        }
        let (fill, outline) = body_look(Stroke::solid(INK, 1.5));
        rows.disc(drawing, None, outline, 6.0, "start");
        rows.disc(drawing, Some(fill), outline, 6.0, "end");
    }
    if !data.way_points.is_empty() {
        rows.disc(
            drawing,
            None,
            Stroke::solid(WAY_POINT, 2.2),
            6.0,
            "waypoint",
        );
    }
    if !data.obstacles.is_empty() {
        let (x, y) = (rows.left, rows.y);
        let points = vec![
            (x + 6.0, y - 6.0),
            (x + 24.0, y - 6.0),
            (x + 24.0, y + 6.0),
            (x + 6.0, y + 6.0),
        ];
        let (fill, stroke) = (
            Some(Fill::solid(OBSTACLE)),
            Some(Stroke::solid(OBSTACLE_EDGE, 1.0)),
        );
        drawing.push(Shape::Line {
            points,
            closed: true,
            fill,
            stroke,
        });
        rows.label(drawing, "obstacle");
    }
    if !data.collisions.is_empty() {
        drawing.cross(
            (rows.left + SAMPLE / 2.0, rows.y),
            5.0,
            Stroke::solid(BLACK, 2.0),
        );
        rows.label(
            drawing,
            &format!("collision \u{d7} {}", data.collisions.len()),
        );
    }
    (rows.right + 14.0, rows.y + ROW / 2.0)
}

struct Rows {
    left: f64,
    y: f64,
    right: f64,
}

impl Rows {
    fn path(&mut self, drawing: &mut Drawing, stroke: Stroke, label: &str) {
        drawing.line(
            vec![(self.left, self.y), (self.left + SAMPLE, self.y)],
            stroke,
        );
        self.label(drawing, label);
    }

    fn disc(
        &mut self,
        drawing: &mut Drawing,
        fill: Option<Fill>,
        stroke: Stroke,
        radius: f64,
        label: &str,
    ) {
        let center = (self.left + SAMPLE / 2.0, self.y);
        drawing.push(Shape::Circle {
            center,
            radius,
            fill,
            stroke: Some(stroke),
        });
        self.label(drawing, label);
    }

    fn label(&mut self, drawing: &mut Drawing, label: &str) {
        let x = self.left + SAMPLE + 8.0;
        drawing.text((x, self.y + 4.5), Anchor::Start, label, SIZE, INK);
        self.right = self.right.max(x + text_width(label, SIZE));
        self.y += ROW;
    }
}
