//! The part of the world that is shown: where robots move, with all of the world if that is not much larger.

use super::{PlotData, RobotPath};
use starl_core::Point;
use starl_core::event::MarkShape;
use starl_core::geometry::Bounds;

/// The whole world is shown if it is at most so many times as long as the part in which robots move.
const MUCH: f64 = 2.5;

/// Room around the part in which robots move, as a share of its length.
const AROUND: f64 = 0.15;

/// At least so many radii of a body are shown.
const LEAST_RADII: f64 = 20.0;

/// A part of the world.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// The corner with the least coordinates, metres.
    pub low: (f64, f64),
    /// The corner with the greatest coordinates, metres.
    pub high: (f64, f64),
    /// The whole world, if it is larger.
    pub world: Option<((f64, f64), (f64, f64))>,
}

/// The part of a world that a picture shows.
pub fn of(data: &PlotData) -> Extent {
    let moving = moving(data);
    let mut whole = world(data);
    whole.include_box(&moving);
    if whole.is_empty() {
        whole.include(Point::ZERO, 1.0);
    }
    let has_moved = |robot: &RobotPath| {
        let mut shown = robot.path.iter().filter(|place| shows(&place.position));
        let first = shown.next();
        shown.any(|place| Some(place.position) != first.map(|first| first.position))
    };
    let is_small = whole.length() > MUCH * moving.length().max(moving.least);
    if !moving.is_empty() && is_small && data.robots.iter().any(has_moved) {
        let room = moving.length() * AROUND;
        let room = room.max((moving.least - moving.length()) / 2.0);
        let low = (moving.low.0 - room, moving.low.1 - room);
        let high = (moving.high.0 + room, moving.high.1 + room);
        return Extent {
            low: (low.0.max(whole.low.0), low.1.max(whole.low.1)),
            high: (high.0.min(whole.high.0), high.1.min(whole.high.1)),
            world: Some((whole.low, whole.high)),
        };
    }
    let room = match whole.length() {
        size if size > 0.0 => size * 0.04,
        _ => 1.0,
    };
    Extent {
        low: (whole.low.0 - room, whole.low.1 - room),
        high: (whole.high.0 + room, whole.high.1 + room),
        world: None,
    }
}

/// The smallest rectangle around places.
struct Around {
    low: (f64, f64),
    high: (f64, f64),
    /// The least length to show, metres.
    least: f64,
}

impl Around {
    fn nothing() -> Around {
        Around {
            low: (f64::INFINITY, f64::INFINITY),
            high: (f64::NEG_INFINITY, f64::NEG_INFINITY),
            least: 0.0,
        }
    }

    fn include(&mut self, point: Point, reach: f64) {
        if shows(&point) && reach.abs() < 1e12 {
            let (low, high) = (&mut self.low, &mut self.high);
            *low = (low.0.min(point.x - reach), low.1.min(point.y - reach));
            *high = (high.0.max(point.x + reach), high.1.max(point.y + reach));
        }
    }

    fn include_box(&mut self, other: &Around) {
        if !other.is_empty() {
            self.include(Point::planar(other.low.0, other.low.1), 0.0);
            self.include(Point::planar(other.high.0, other.high.1), 0.0);
        }
    }

    fn is_empty(&self) -> bool {
        self.low.0 > self.high.0
    }

    fn length(&self) -> f64 {
        (self.high.0 - self.low.0).max(self.high.1 - self.low.1)
    }
}

/// Where robots have been, and what they drew.
fn moving(data: &PlotData) -> Around {
    let mut around = Around::nothing();
    for robot in &data.robots {
        for place in &robot.path {
            around.include(place.position, robot.radius);
        }
        if robot.radius < 1e9 {
            around.least = around.least.max(robot.radius * LEAST_RADII);
        }
        for mark in robot.marks.values() {
            match mark {
                MarkShape::Dot(at) | MarkShape::Text(at) => around.include(*at, 0.0),
                MarkShape::Circle { center, radius } => around.include(*center, *radius),
                MarkShape::Line(points) => {
                    points.iter().for_each(|&point| around.include(point, 0.0));
                }
                MarkShape::Nothing => {}
            }
        }
    }
    let crashes = data.crashes.iter().map(|crash| &crash.place);
    for place in data.collisions.iter().chain(crashes) {
        around.include(place.position, 0.0);
    }
    around
}

/// All else that the world holds.
fn world(data: &PlotData) -> Around {
    let mut around = Around::nothing();
    if let Some((a, b)) = data.arena {
        around.include(a, 0.0);
        around.include(b, 0.0);
    }
    for obstacle in &data.obstacles {
        let Bounds { low, high } = obstacle.bounds();
        around.include(low, 0.0);
        around.include(high, 0.0);
    }
    for way_point in &data.way_points {
        around.include(way_point.position, 0.0);
    }
    for thing in &data.things {
        around.include(thing.position, 0.0);
    }
    around
}

/// Whether a point can be shown: beyond this, differences of coordinates mean nothing any more.
pub fn shows(point: &Point) -> bool {
    point.x.abs() < 1e12 && point.y.abs() < 1e12
}
