//! Segments in the floor plane and against boxes: the arithmetic the shapes share.
//!
//! Comparisons are written out instead of `f64::min` and `f64::max`, whose choice between the two
//! zeros is left open and could differ between targets. Tests that only ask on which side a point lies
//! use no division, so a segment along a face of a box is judged exactly.

use super::Point;
use crate::math;

/// The smaller number; the second if they cannot be compared.
#[inline]
pub(super) fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The greater number; the second if they cannot be compared.
#[inline]
pub(super) fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Twice the area of the triangle, positive if it is counter-clockwise, in square metres.
#[inline]
pub(super) fn turn(a: Point, b: Point, c: Point) -> f64 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

/// Squared planar distance between two points, square metres.
#[inline]
pub(super) fn planar_squared(a: Point, b: Point) -> f64 {
    let (x, y) = (b.x - a.x, b.y - a.y);
    x * x + y * y
}

/// The point of the segment from `a` to `b` nearest to `p` in the plane, at the height of `p`.
#[inline]
pub(super) fn nearest_on_segment(p: Point, a: Point, b: Point) -> Point {
    let (x, y) = (b.x - a.x, b.y - a.y);
    let along = (p.x - a.x) * x + (p.y - a.y) * y;
    let squared = x * x + y * y;
    if along <= 0.0 || squared <= 0.0 {
        return a.at_height(p.z);
    }
    if along >= squared {
        return b.at_height(p.z);
    }
    let fraction = along / squared;
    Point::new(a.x + x * fraction, a.y + y * fraction, p.z)
}

/// Squared planar distance from a point to a segment, square metres.
#[inline]
pub(super) fn squared_to_segment(p: Point, a: Point, b: Point) -> f64 {
    planar_squared(p, nearest_on_segment(p, a, b))
}

/// Length of the displacement with these two components at right angles, each counted only if
/// positive, metres.
#[inline]
pub(super) fn outside_both(planar: f64, vertical: f64) -> f64 {
    if vertical <= 0.0 {
        return greater(planar, 0.0);
    }
    if planar <= 0.0 {
        return vertical;
    }
    math::sqrt(planar * planar + vertical * vertical)
}

/// Planar distance to the boundary of a rectangle, metres: negative inside.
#[inline]
pub(super) fn rectangle_distance(p: Point, low: Point, high: Point) -> f64 {
    let x = greater(low.x - p.x, p.x - high.x);
    let y = greater(low.y - p.y, p.y - high.y);
    if x <= 0.0 && y <= 0.0 {
        greater(x, y)
    } else {
        outside_both(x, y)
    }
}

/// The part of the segment from `a` to `b` whose height lies in `[low, high]` metres.
pub(super) fn clip_height(a: Point, b: Point, low: f64, high: f64) -> Option<(Point, Point)> {
    if (a.z < low && b.z < low) || (a.z > high && b.z > high) {
        return None;
    }
    let at = |z: f64| a.lerp(b, (z - a.z) / (b.z - a.z)).at_height(z);
    let clip = |p: Point| match p.z {
        z if z < low => at(low),
        z if z > high => at(high),
        _ => p,
    };
    Some((clip(a), clip(b)))
}

/// Whether the line through the origin's side of a box is cut: `low` and `high` are the box relative
/// to the start of a segment in two axes, (`x`, `y`) the segment's direction in them.
#[inline]
fn line_meets(x: f64, y: f64, low: (f64, f64), high: (f64, f64)) -> bool {
    let (near_x, far_x) = if y > 0.0 {
        (low.0, high.0)
    } else {
        (high.0, low.0)
    };
    let (near_y, far_y) = if x > 0.0 {
        (high.1, low.1)
    } else {
        (low.1, high.1)
    };
    // The corners farthest to the left and to the right of the line.
    x * near_y - y * near_x >= 0.0 && x * far_y - y * far_x <= 0.0
}

/// Whether a segment and an interval of one axis share a value.
#[inline]
fn spans_meet(a: f64, b: f64, low: f64, high: f64) -> bool {
    (a >= low || b >= low) && (a <= high || b <= high)
}

/// Whether the segment from `a` to `b` and the rectangle share a point of the plane, boundary
/// included.
#[inline]
pub(super) fn meets_rectangle(a: Point, b: Point, low: Point, high: Point) -> bool {
    spans_meet(a.x, b.x, low.x, high.x)
        && spans_meet(a.y, b.y, low.y, high.y)
        && line_meets(
            b.x - a.x,
            b.y - a.y,
            (low.x - a.x, low.y - a.y),
            (high.x - a.x, high.y - a.y),
        )
}

/// Whether the segment from `a` to `b` and the box share a point of space, boundary included.
///
/// Separating axes (Ericson, Real-Time Collision Detection, 5.3.3): three of the box, and the cross
/// products of its edges with the segment, written with corners rather than centre and half extents
/// so that nothing is rounded for a segment parallel to an axis.
#[inline]
pub(super) fn meets_box(a: Point, b: Point, low: Point, high: Point) -> bool {
    if !(spans_meet(a.x, b.x, low.x, high.x)
        && spans_meet(a.y, b.y, low.y, high.y)
        && spans_meet(a.z, b.z, low.z, high.z))
    {
        return false;
    }
    let (way, low, high) = (b - a, low - a, high - a);
    line_meets(way.x, way.y, (low.x, low.y), (high.x, high.y))
        && line_meets(way.x, way.z, (low.x, low.z), (high.x, high.z))
        && line_meets(way.y, way.z, (low.y, low.z), (high.y, high.z))
}
