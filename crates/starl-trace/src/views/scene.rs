//! The content of the world, as entities: obstacles, robots and drawings.

use super::primitive::{self, DARK, Entity, GREY, Primitive, RED};
use super::{RobotView, WORLD};
use crate::json::Json;
use crate::{Header, RobotEntry};
use starl_core::event::{Mark, MarkShape};
use starl_core::geometry::HeightSpan;
use starl_core::{Obstacle, Point, Shape, Time};

/// How high an obstacle that reaches to the sky is drawn, metres.
const SKY: f64 = 1.0;
/// Thickness of lines, metres.
const THIN: f64 = 0.02;
/// Height of letters, metres.
const LETTERS: f64 = 0.15;

/// Writes the obstacles and waypoints.
pub fn world(json: &mut Json, header: &Header) {
    let obstacles = header.obstacles.iter().enumerate();
    let obstacles =
        obstacles.map(|(index, obstacle)| (format!("obstacle {index}"), solid(obstacle)));
    let way_points = header
        .way_points
        .iter()
        .enumerate()
        .map(|(index, way_point)| {
            let at = way_point.position;
            let size = Point::new(0.2, 0.2, 0.02);
            let parts = vec![
                Primitive::Cylinder {
                    center: at,
                    size,
                    color: RED,
                },
                Primitive::Text {
                    at: at + Point::new(0.0, 0.0, 0.2),
                    size: LETTERS,
                    text: way_point.name.clone(),
                    color: RED,
                },
            ];
            (format!("way-point {index}"), parts)
        });
    let entities: Vec<Entity<'_>> = (obstacles.chain(way_points))
        .map(|(id, parts)| Entity {
            frame: WORLD,
            id: id.into(),
            locked: true,
            parts,
        })
        .collect();
    primitive::update(json, Time::ZERO, &entities);
}

/// Writes each robot's body, in its own frame.
pub fn bodies(json: &mut Json, robots: &[RobotEntry], views: &[RobotView]) {
    let entities: Vec<Entity<'_>> = (robots.iter().zip(views))
        .map(|(robot, view)| {
            let (width, height) = (2.0 * robot.radius, robot.height);
            let top = Point::new(0.0, 0.0, height + THIN);
            let parts = vec![
                Primitive::Cylinder {
                    center: Point::new(0.0, 0.0, height / 2.0),
                    size: Point::new(width, width, height),
                    color: view.color,
                },
                // Shows where the front is.
                Primitive::Line {
                    points: vec![top, top + Point::planar(robot.radius, 0.0)],
                    closed: false,
                    thickness: THIN,
                    color: DARK,
                },
                Primitive::Text {
                    at: top + Point::new(0.0, 0.0, LETTERS),
                    size: LETTERS,
                    text: view.name.clone(),
                    color: DARK,
                },
            ];
            Entity {
                frame: &view.name,
                id: view.name.as_str().into(),
                locked: true,
                parts,
            }
        })
        .collect();
    primitive::update(json, Time::ZERO, &entities);
}

/// Writes the path of a robot so far.
pub fn path(json: &mut Json, at: Time, robot: &RobotView) {
    let line = Primitive::Line {
        points: robot.trail.points().collect(),
        closed: false,
        thickness: THIN,
        color: robot.color,
    };
    let parts = vec![line];
    primitive::update(
        json,
        at,
        &[Entity {
            frame: WORLD,
            id: "path".into(),
            locked: true,
            parts,
        }],
    );
}

/// Writes a mark, or takes it away.
pub fn mark(json: &mut Json, at: Time, robot: &RobotView, mark: &Mark) {
    let id = format!("{}/{}", robot.name, mark.label);
    let color = robot.color;
    let part = match &mark.shape {
        MarkShape::Nothing => return primitive::deletion(json, at, &id),
        MarkShape::Dot(at) => disc(*at, 0.03, color),
        MarkShape::Circle { center, radius } => {
            disc(*center, *radius, [color[0], color[1], color[2], 0.4])
        }
        MarkShape::Line(points) => {
            let points = points.clone();
            Primitive::Line {
                points,
                closed: false,
                thickness: THIN,
                color,
            }
        }
        MarkShape::Text(at) => {
            let text = mark.label.to_string();
            Primitive::Text {
                at: *at,
                size: LETTERS,
                text,
                color,
            }
        }
    };
    let parts = vec![part];
    primitive::update(
        json,
        at,
        &[Entity {
            frame: WORLD,
            id: id.into(),
            locked: true,
            parts,
        }],
    );
}

fn disc(center: Point, radius: f64, color: primitive::Color) -> Primitive {
    Primitive::Cylinder {
        center,
        size: Point::new(2.0 * radius, 2.0 * radius, THIN),
        color,
    }
}

/// An obstacle as it stands in the world.
fn solid(obstacle: &Obstacle) -> Vec<Primitive> {
    let HeightSpan { low, high } = obstacle.height().unwrap_or(HeightSpan::new(0.0, SKY));
    let middle = (low + high) / 2.0;
    vec![match &obstacle.shape {
        Shape::Polygon { base, .. } => Primitive::Triangles {
            points: prism(base.vertices(), low, high),
            color: GREY,
        },
        Shape::Circle { center, radius, .. } => Primitive::Cylinder {
            center: center.at_height(middle),
            size: Point::new(2.0 * radius, 2.0 * radius, high - low),
            color: GREY,
        },
        Shape::Cuboid { low, high } => Primitive::Cube {
            center: low.lerp(*high, 0.5),
            size: *high - *low,
            color: GREY,
        },
    }]
}

/// The triangles of an upright prism over a convex base; of a wall, its two sides.
fn prism(base: &[Point], low: f64, high: f64) -> Vec<Point> {
    let mut triangles = Vec::new();
    for (index, &from) in base.iter().enumerate() {
        let to = base[(index + 1) % base.len()];
        let [a, b, c, d] = [
            from.at_height(low),
            to.at_height(low),
            to.at_height(high),
            from.at_height(high),
        ];
        triangles.extend([a, b, c, a, c, d]);
        if index > 0 && index + 1 < base.len() {
            let first = base[0];
            triangles.extend([
                first.at_height(high),
                from.at_height(high),
                to.at_height(high),
            ]);
            triangles.extend([first.at_height(low), to.at_height(low), from.at_height(low)]);
        }
    }
    triangles
}
