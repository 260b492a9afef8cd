//! Drawings of programs, in the colour of their robot and stronger than its path.

use super::RobotPath;
use super::drawing::{Anchor, Drawing, Fill, Shape, Spot, Stroke};
use super::extent;
use super::frame::Frame;
use super::labels::Labels;
use starl_core::event::MarkShape;

/// Draws all marks that a robot's program has left.
pub fn draw(
    drawing: &mut Drawing,
    frame: &Frame,
    robot: &RobotPath,
    stroke: Stroke,
    labels: &mut Labels,
) {
    let stroke = Stroke {
        width: stroke.width * 2.5,
        dashed: false,
        ..stroke
    };
    for (label, mark) in &robot.marks {
        match mark {
            MarkShape::Nothing => {}
            MarkShape::Dot(at) if extent::shows(at) => drawing.push(Shape::Circle {
                center: frame.spot(*at),
                radius: stroke.width,
                fill: Some(Fill::solid(stroke.color)),
                stroke: None,
            }),
            MarkShape::Circle { center, radius } if extent::shows(center) && *radius < 1e12 => {
                drawing.push(Shape::Circle {
                    center: frame.spot(*center),
                    radius: radius.max(0.0) * frame.scale,
                    fill: None,
                    stroke: Some(stroke),
                });
            }
            MarkShape::Line(points) if points.iter().all(extent::shows) => {
                let spots: Vec<Spot> = points.iter().map(|&point| frame.spot(point)).collect();
                if spots.len() > 1 {
                    drawing.line(spots, stroke);
                }
            }
            MarkShape::Text(at) if extent::shows(at) => {
                let (at, size) = (frame.spot(*at), 13.0);
                labels.keep_off_text(at, label, size);
                drawing.push(Shape::Text {
                    at,
                    anchor: Anchor::Start,
                    text: label.clone(),
                    size,
                    color: stroke.color,
                    rim: true,
                });
            }
            // Anything that is not in the world cannot be shown.
            _ => {}
        }
    }
}
