//! A convex polygon in the floor plane; with two vertices, a wall without thickness.
//!
//! Invariant: the vertices are distinct, finite, at height zero and in counter-clockwise order, and
//! every one of them is a corner. Only [`ConvexPolygon::new`] makes one, deserialization included.

use super::Point;
use super::segment::{
    greater, lesser, nearest_on_segment, planar_squared, squared_to_segment, turn,
};
use crate::math;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Coordinates beyond this would overflow when squared, metres.
const FARTHEST: f64 = 1e150;

/// A convex polygon in the floor plane, metres; serialized as the list of its vertices.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<Point>", into = "Vec<Point>")]
pub struct ConvexPolygon {
    vertices: Vec<Point>,
}

/// Why a list of points is not a [`ConvexPolygon`]. Indices count from zero in the list as given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum PolygonError {
    /// Fewer than two points.
    #[error("a polygon needs at least three corners, a wall its two ends")]
    TooFew,
    /// A coordinate is infinite, not a number, or too large to compute with.
    #[error(
        "point {index} of the polygon has a coordinate that is not a usable number: give finite metres"
    )]
    NotFinite {
        /// The point.
        index: usize,
    },
    /// Two points are at the same place.
    #[error(
        "points {first} and {second} of the polygon are the same: leave one out (the last need not repeat the first)"
    )]
    Repeated {
        /// The earlier one.
        first: usize,
        /// The later one.
        second: usize,
    },
    /// More than two points, all on one line.
    #[error("the points of the polygon lie on one line: give only the two ends for a wall")]
    Degenerate,
    /// The outline turns the other way here.
    #[error(
        "the polygon is not convex at point {index}: list the corners in order along the outline, and split a hollow shape into convex parts"
    )]
    NotConvex {
        /// The corner.
        index: usize,
    },
    /// The outline goes round more than once, like a star.
    #[error("the outline of the polygon crosses itself: list the corners in order, once round")]
    SelfCrossing,
}

impl ConvexPolygon {
    /// The polygon with these corners, in either orientation; heights are dropped. Two points make a
    /// wall. Points between two corners, on the straight edge up to the rounding of their
    /// coordinates, are left out.
    pub fn new(points: &[Point]) -> Result<ConvexPolygon, PolygonError> {
        if points.len() < 2 {
            return Err(PolygonError::TooFew);
        }
        let usable = |p: &Point| p.x.abs() <= FARTHEST && p.y.abs() <= FARTHEST && p.z.is_finite();
        if let Some(index) = points.iter().position(|p| !usable(p)) {
            return Err(PolygonError::NotFinite { index });
        }
        if let Some((first, second)) = repeated(points) {
            return Err(PolygonError::Repeated { first, second });
        }
        let mut vertices: Vec<Point> = match points.len() {
            2 => points.to_vec(),
            _ => corners(points)?,
        };
        for vertex in &mut vertices {
            vertex.z = 0.0;
        }
        Ok(ConvexPolygon { vertices })
    }

    /// The rectangle with these opposite corners, sides along the axes; a wall if it has no width.
    pub fn rectangle(low: Point, high: Point) -> Result<ConvexPolygon, PolygonError> {
        if low.x == high.x || low.y == high.y {
            return ConvexPolygon::new(&[low, high]);
        }
        let corner = Point::planar;
        ConvexPolygon::new(&[low, corner(high.x, low.y), high, corner(low.x, high.y)])
    }

    /// The corners, counter-clockwise, at height zero; two for a wall.
    pub fn vertices(&self) -> &[Point] {
        &self.vertices
    }

    /// Whether this is a wall: two ends and no inside.
    pub fn is_wall(&self) -> bool {
        self.vertices.len() == 2
    }

    /// The edges as (from, to), the inside on their left. A wall has two, there and back.
    #[inline]
    pub fn edges(&self) -> impl Iterator<Item = (Point, Point)> + '_ {
        let last = self.vertices[self.vertices.len() - 1];
        self.vertices.iter().scan(last, |from, &to| {
            let edge = (*from, to);
            *from = to;
            Some(edge)
        })
    }

    /// Whether the point lies in the polygon or on its boundary, heights left out.
    pub fn contains(&self, p: Point) -> bool {
        if !self.edges().all(|(a, b)| turn(a, b, p) >= 0.0) {
            return false;
        }
        // On the line of a wall, but perhaps beyond its ends.
        !self.is_wall() || {
            let (a, b) = (self.vertices[0], self.vertices[1]);
            let within = |p: f64, a: f64, b: f64| lesser(a, b) <= p && p <= greater(a, b);
            within(p.x, a.x, b.x) && within(p.y, a.y, b.y)
        }
    }

    /// Planar distance to the boundary, metres: negative inside, never negative for a wall.
    pub fn signed_distance(&self, p: Point) -> f64 {
        let inside = self.contains(p);
        let squared = self.edges().fold(f64::INFINITY, |least, (a, b)| {
            lesser(squared_to_segment(p, a, b), least)
        });
        let distance = math::sqrt(squared);
        if inside { 0.0 - distance } else { distance }
    }

    /// The nearest point of the boundary, at the height of `p`.
    pub fn nearest_boundary_point(&self, p: Point) -> Point {
        let mut least = f64::INFINITY;
        let mut nearest = self.vertices[0].at_height(p.z);
        for (a, b) in self.edges() {
            let point = nearest_on_segment(p, a, b);
            let squared = planar_squared(p, point);
            if squared < least {
                (least, nearest) = (squared, point);
            }
        }
        nearest
    }
}

impl TryFrom<Vec<Point>> for ConvexPolygon {
    type Error = PolygonError;
    fn try_from(points: Vec<Point>) -> Result<ConvexPolygon, PolygonError> {
        ConvexPolygon::new(&points)
    }
}

impl From<ConvexPolygon> for Vec<Point> {
    fn from(polygon: ConvexPolygon) -> Vec<Point> {
        polygon.vertices
    }
}

/// The first point that is where an earlier one is, after that one.
fn repeated(points: &[Point]) -> Option<(usize, usize)> {
    // Zeros of either sign are one place.
    let place = |&at: &usize| (points[at].x + 0.0, points[at].y + 0.0);
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|a, b| {
        let ((ax, ay), (bx, by)) = (place(a), place(b));
        ax.total_cmp(&bx).then(ay.total_cmp(&by)).then(a.cmp(b))
    });
    let runs = order.chunk_by(|a, b| place(a) == place(b));
    let pairs = runs.filter(|run| run.len() > 1).map(|run| (run[0], run[1]));
    pairs.min_by_key(|&(_, second)| second)
}

/// The corners among three or more distinct points, counter-clockwise, the first kept first.
fn corners(points: &[Point]) -> Result<Vec<Point>, PolygonError> {
    let largest = points
        .iter()
        .fold(0.0, |most, p| greater(greater(p.x.abs(), p.y.abs()), most));
    let neighbours = |list: &[usize], at: usize| {
        let count = list.len();
        let point = |at: usize| points[list[at % count]];
        (point(at + count - 1), point(at), point(at + 1))
    };
    // The turn at a corner, zero if the rounding of the coordinates alone could explain it.
    let bend = |(a, b, c): (Point, Point, Point)| {
        let reach = (b.x - a.x).abs() + (b.y - a.y).abs() + (c.x - b.x).abs() + (c.y - b.y).abs();
        let twice_area = turn(a, b, c);
        if twice_area.abs() <= 4.0 * f64::EPSILON * largest * reach {
            0.0
        } else {
            twice_area
        }
    };

    let all: Vec<usize> = (0..points.len()).collect();
    let straight_on = |&at: &usize| {
        let (a, b, c) = neighbours(&all, at);
        bend((a, b, c)) == 0.0 && (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y) > 0.0
    };
    if all.iter().all(|&at| bend(neighbours(&all, at)) == 0.0) {
        return Err(PolygonError::Degenerate);
    }
    let mut kept: Vec<usize> = all.iter().copied().filter(|at| !straight_on(at)).collect();
    let origin = points[0];
    let twice_area: f64 = (2..points.len())
        .map(|at| turn(origin, points[at - 1], points[at]))
        .sum();
    if twice_area < 0.0 {
        kept[1..].reverse();
    }
    for at in 0..kept.len() {
        if kept.len() < 3 || bend(neighbours(&kept, at)) <= 0.0 {
            return Err(PolygonError::NotConvex { index: kept[at] });
        }
    }
    // All turns are to the left: the outline goes round as often as its direction passes east.
    let upward = |at: usize| {
        let (_, from, to) = neighbours(&kept, at);
        to.y > from.y || (to.y == from.y && to.x > from.x)
    };
    let rounds = (0..kept.len())
        .filter(|&at| !upward(at) && upward((at + 1) % kept.len()))
        .count();
    if rounds != 1 {
        return Err(PolygonError::SelfCrossing);
    }
    Ok(kept.into_iter().map(|at| points[at]).collect())
}
