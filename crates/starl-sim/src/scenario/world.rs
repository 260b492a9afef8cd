//! The world that robots move in.

use starl_core::{ConvexPolygon, Obstacle, Point, Time, WayPoint};

/// Obstacles, waypoints and things.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct World {
    /// Walls around everything; none by default.
    pub bounds: Option<Bounds>,
    /// The obstacles.
    pub obstacles: Vec<WorldObstacle>,
    /// The waypoints of every program.
    pub way_points: Vec<WayPoint>,
    /// Things to be found by detectors.
    pub things: Vec<Thing>,
}

impl World {
    /// The walls around the world, which all robots know; none in a world without bounds.
    pub fn walls(&self) -> Vec<Obstacle> {
        self.bounds.map_or(Vec::new(), |bounds| bounds.walls())
    }

    /// Calls `raise` with the index, the shape and the visibility of each wall around the world.
    pub(crate) fn raise_walls(&self, raise: &mut impl FnMut(usize, &Obstacle, bool)) {
        for (side, wall) in self.walls().iter().enumerate() {
            raise(self.obstacles.len() + side, wall, false);
        }
    }
}

/// A rectangle in the floor plane that no body leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lowest x and y, metres.
    pub low: Point,
    /// Highest x and y, metres.
    pub high: Point,
}

impl Bounds {
    /// The square around a point whose sides are this far away, metres.
    pub(crate) fn around(point: Point, distance: f64) -> Bounds {
        let corner = Point::planar(distance, distance);
        Bounds {
            low: point - corner,
            high: point + corner,
        }
    }

    /// The least rectangle around both.
    pub(crate) fn joined(self, other: Bounds) -> Bounds {
        let (a, b) = (self, other);
        Bounds {
            low: Point::planar(a.low.x.min(b.low.x), a.low.y.min(b.low.y)),
            high: Point::planar(a.high.x.max(b.high.x), a.high.y.max(b.high.y)),
        }
    }

    /// The four walls, from the lowest y on, counter-clockwise.
    pub fn walls(&self) -> Vec<Obstacle> {
        let Bounds { low, high } = *self;
        let corners = [
            low,
            Point::planar(high.x, low.y),
            high,
            Point::planar(low.x, high.y),
            low,
        ];
        let sides = corners
            .windows(2)
            .filter_map(|ends| ConvexPolygon::new(ends).ok());
        sides.map(Obstacle::polygon).collect()
    }
}

/// An obstacle with the simulator's data about it.
#[derive(Clone, Debug, PartialEq)]
pub struct WorldObstacle {
    /// Its shape and place.
    pub obstacle: Obstacle,
    /// Robots do not know it until they meet it; default false.
    pub hidden: bool,
    /// It vanishes at this time; default never.
    pub expires: Time,
}

/// Something to find.
#[derive(Clone, Debug, PartialEq)]
pub struct Thing {
    /// Its name.
    pub name: String,
    /// Where it is, metres.
    pub position: Point,
}
