//! Plane geometry that avoidance needs: segments and turns.

use starl_core::{Point, math};

/// How closely the least value on a segment is found: each step leaves three quarters of it.
const NARROWINGS: u32 = 6;

/// The displacement in the plane turned to the left by an angle in radians.
pub(super) fn turned(vector: Point, angle: f64) -> Point {
    let (sine, cosine) = math::sincos(angle);
    Point::planar(
        vector.x * cosine - vector.y * sine,
        vector.x * sine + vector.y * cosine,
    )
}

/// The smaller number.
pub(super) fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The larger number.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The shortest displacement in the plane from the segment between the origin and `tip` to the one
/// between `start` and `start + way`; zero where they cross.
pub(super) fn between_segments(tip: Point, start: Point, way: Point) -> Point {
    let turn = tip.cross_planar(way);
    if turn != 0.0 {
        // Where the lines cross, as parts of both segments.
        let (here, there) = (
            start.cross_planar(way) / turn,
            start.cross_planar(tip) / turn,
        );
        if (0.0..=1.0).contains(&here) && (0.0..=1.0).contains(&there) {
            return Point::ZERO;
        }
    }
    let end = start + way;
    let candidates = [
        start - on_segment(start, Point::ZERO, tip),
        end - on_segment(end, Point::ZERO, tip),
        on_segment(Point::ZERO, start, way),
        on_segment(tip, start, way) - tip,
    ];
    let mut best = candidates[0];
    for &other in &candidates[1..] {
        if other.length_squared() < best.length_squared() {
            best = other;
        }
    }
    best
}

/// The point of the segment from `start` to `start + way` nearest to `p`.
fn on_segment(p: Point, start: Point, way: Point) -> Point {
    let squared = way.length_squared();
    let along = (p - start).dot(way);
    if along <= 0.0 || squared <= 0.0 {
        start
    } else if along >= squared {
        start + way
    } else {
        start + way * (along / squared)
    }
}

/// The approximate minimum of a convex function on the segment from `start` to `start + way`: its position and value.
pub(super) fn least_on_segment(
    start: Point,
    way: Point,
    value: impl Fn(Point) -> f64,
) -> (f64, Point) {
    let at = |part: f64| {
        let point = start + way * part;
        (value(point), point)
    };
    let least = |a: (f64, Point), b: (f64, Point)| if b.0 < a.0 { b } else { a };
    if way == Point::ZERO {
        return at(0.0);
    }
    let (mut low, mut high) = (0.0, 1.0);
    let mut best = least(at(low), at(high));
    for _ in 0..NARROWINGS {
        let middle = 0.5 * (low + high);
        let quarter = 0.25 * (high - low);
        let (left, right) = (at(middle - quarter), at(middle + quarter));
        best = least(best, least(left, right));
        if left.0 < right.0 {
            high = middle + quarter;
        } else {
            low = middle - quarter;
        }
    }
    best
}
