//! Plane geometry that avoidance needs: segments and turns.

use starl_core::{Point, math};

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
