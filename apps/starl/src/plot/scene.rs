//! The content of a picture, from the back to the front: floor, obstacles, ranges, paths, marks, bodies, times,
//! signs, heading, legend.

use super::drawing::{Anchor, Drawing, Fill, Shape as Drawn, Spot, Stroke};
use super::frame::Frame;
use super::labels::{Labels, short_name, text_width};
use super::looks::{Looks, body_look};
use super::palette::{BLACK, INK, OBSTACLE, OBSTACLE_EDGE};
use super::{PlotData, RobotPath};
use super::{extent, legend, marks, ranges, signs, times};
use starl_core::{Obstacle, Point, Shape};

/// Points of a path nearer to each other than this are drawn as one.
const NEAREST: f64 = 0.4;

/// Draws all of it.
pub fn draw(data: &PlotData) -> Drawing {
    let frame = Frame::around(data);
    let looks = Looks::of(&data.robots);
    let mut drawing = Drawing::default();
    frame.draw_axes(&mut drawing);
    let (upper_left, lower_right) = frame.corners();
    drawing.push(Drawn::Clip(Some((upper_left, lower_right))));
    for obstacle in &data.obstacles {
        draw_obstacle(&mut drawing, &frame, obstacle);
    }
    let mut labels = Labels::new((upper_left, lower_right));
    ranges::draw(&mut drawing, &frame, data, &looks);
    for (index, robot) in data.robots.iter().enumerate() {
        draw_path(&mut drawing, &frame, robot, looks.stroke(index, robot));
    }
    for (index, robot) in data.robots.iter().enumerate() {
        marks::draw(
            &mut drawing,
            &frame,
            robot,
            looks.stroke(index, robot),
            &mut labels,
        );
    }
    for (index, robot) in data.robots.iter().enumerate() {
        draw_bodies(&mut drawing, &frame, robot, looks.stroke(index, robot));
    }
    // Signs lie over dots, but have the first choice of places for their labels.
    let mut over = Drawing::default();
    signs::draw(&mut over, &frame, data, &mut labels);
    times::draw(&mut drawing, &frame, data, &looks, &mut labels);
    drawing.shapes.append(&mut over.shapes);
    drawing.push(Drawn::Clip(None));
    frame.draw_edge(&mut drawing);
    let (left, top) = (14.0, upper_left.1);
    let title = short_name(&data.title);
    let after = (left + text_width(&title, 16.0) + 6.0, top - 40.0);
    drawing.text((left, top - 40.0), Anchor::Start, title, 16.0, BLACK);
    drawing.text(after, Anchor::Start, data.subtitle.as_str(), 13.0, INK);
    let corner = (lower_right.0 + 22.0, upper_left.1);
    let right = legend::draw(&mut drawing, data, &frame, &looks, corner);
    let heading = after.0 + text_width(&data.subtitle, 13.0) + 14.0;
    drawing.size = (right.0.max(heading), right.1.max(lower_right.1 + 48.0));
    drawing
}

fn draw_obstacle(drawing: &mut Drawing, frame: &Frame, obstacle: &Obstacle) {
    let look = (
        Some(Fill::solid(OBSTACLE)),
        Some(Stroke::solid(OBSTACLE_EDGE, 1.0)),
    );
    let points: Vec<Point> = match &obstacle.shape {
        Shape::Polygon { base, .. } => base.vertices().to_vec(),
        Shape::Cuboid { low, high } => {
            let corner = Point::planar;
            vec![*low, corner(high.x, low.y), *high, corner(low.x, high.y)]
        }
        Shape::Circle { center, radius, .. } => {
            if extent::shows(center) && radius.abs() < 1e12 {
                let (center, radius) = (frame.spot(*center), radius * frame.scale);
                drawing.push(Drawn::Circle {
                    center,
                    radius,
                    fill: look.0,
                    stroke: look.1,
                });
            }
            return;
        }
    };
    if points.iter().all(extent::shows) {
        let points: Vec<Spot> = points.into_iter().map(|point| frame.spot(point)).collect();
        if points.len() == 2 {
            return drawing.line(points, Stroke::solid(OBSTACLE_EDGE, 3.0));
        }
        drawing.push(Drawn::Line {
            points,
            closed: true,
            fill: look.0,
            stroke: look.1,
        });
    }
}

fn draw_path(drawing: &mut Drawing, frame: &Frame, robot: &RobotPath, stroke: Stroke) {
    let spots = thinned(
        robot
            .path
            .iter()
            .map(|place| place.position)
            .filter(extent::shows)
            .map(|position| frame.spot(position)),
    );
    if spots.len() > 1 {
        drawing.line(spots, stroke);
    }
}

/// Leaves out what cannot be seen; first and last point stay.
fn thinned(spots: impl Iterator<Item = Spot>) -> Vec<Spot> {
    let mut kept: Vec<Spot> = Vec::new();
    let mut left_out = None;
    for spot in spots {
        let near = kept.last().is_some_and(|last| {
            (spot.0 - last.0).abs() < NEAREST && (spot.1 - last.1).abs() < NEAREST
        });
        if near {
            left_out = Some(spot);
        } else {
            kept.push(spot);
            left_out = None;
        }
    }
    // A path that ends where it began to rest is longer than a point only if it moved.
    kept.extend(left_out.filter(|spot| kept.last() != Some(spot)));
    kept
}

/// The body at the start, hollow, and at the end, full, both to scale unless too small to see.
fn draw_bodies(drawing: &mut Drawing, frame: &Frame, robot: &RobotPath, stroke: Stroke) {
    let places = robot.path.iter().map(|place| place.position);
    let mut places = places.filter(extent::shows);
    let Some(first) = places.next() else { return };
    let last = places.next_back().unwrap_or(first);
    let smallest = if stroke.opacity < 1.0 { 1.0 } else { 4.0 };
    let radius = if robot.radius.abs() < 1e12 {
        robot.radius * frame.scale
    } else {
        0.0
    };
    let radius = radius.max(smallest);
    let (fill, outline) = body_look(stroke);
    drawing.push(Drawn::Circle {
        center: frame.spot(first),
        radius,
        fill: None,
        stroke: Some(outline),
    });
    drawing.push(Drawn::Circle {
        center: frame.spot(last),
        radius,
        fill: Some(fill),
        stroke: Some(outline),
    });
}
