//! Obstacles against straight paths, swept bodies and rays: exact, nothing is sampled.
//!
//! The boundary belongs to the obstacle, so with a clearance of zero a path that touches is blocked;
//! with a clearance above zero a path at exactly that distance is free.

use super::obstacle::overlaps_in_height;
use super::segment::{
    clip_height, greater, lesser, meets_box, meets_rectangle, planar_squared, rectangle_distance,
    squared_to_segment, turn,
};
use super::{Bounds, ConvexPolygon, Obstacle, Point, Shape};
use crate::math;

impl Obstacle {
    /// Whether any point of the segment from `a` to `b` touches the obstacle or comes nearer to it
    /// than `clearance` metres, measured as by [`Obstacle::distance`].
    #[inline]
    pub fn blocks_segment(&self, a: Point, b: Point, clearance: f64) -> bool {
        let clearance = greater(clearance, 0.0);
        if let Shape::Cuboid { low, high } = &self.shape {
            // Decides alone without a clearance; otherwise it rules out most.
            let grown = Bounds {
                low: *low,
                high: *high,
            }
            .inflated(clearance);
            let meets = meets_box(a, b, grown.low, grown.high);
            if !meets || clearance == 0.0 {
                return meets;
            }
        }
        self.comes_within(a, b, clearance)
    }

    /// Whether an upright cylinder whose base centre moves straight from `a` to `b`, radius and
    /// height in metres, touches with its axis or reaches into the obstacle on the way: whether
    /// [`Obstacle::body_gap`] falls below zero somewhere.
    pub fn blocks_body(&self, a: Point, b: Point, radius: f64, body_height: f64) -> bool {
        let Some(span) = self.height() else {
            return self.comes_within_planar(a, b, greater(radius, 0.0));
        };
        if !overlaps_in_height(span, lesser(a.z, b.z), greater(a.z, b.z) + body_height) {
            return false;
        }
        clip_height(a, b, span.low - body_height, span.high)
            .is_some_and(|(a, b)| self.comes_within_planar(a, b, greater(radius, 0.0)))
    }

    /// Distance in metres along a horizontal ray to where it first meets the obstacle, zero if it
    /// starts inside; none if that is beyond `range` metres or at another height. `direction` is of
    /// length one in the plane; its height is ignored.
    pub fn ray(&self, origin: Point, direction: Point, range: f64) -> Option<f64> {
        if self.height().is_some_and(|span| !span.contains(origin.z)) {
            return None;
        }
        if self.planar_contains(origin) {
            return Some(0.0);
        }
        let entry = match &self.shape {
            Shape::Polygon { base, .. } if base.is_wall() => {
                ray_to_wall(base.vertices()[0], base.vertices()[1], origin, direction)
            }
            Shape::Polygon { base, .. } => ray_to_edges(base.edges(), origin, direction),
            Shape::Circle { center, radius, .. } => {
                ray_to_circle(*center, *radius, origin, direction)
            }
            Shape::Cuboid { low, high } => {
                let (right, left) = (Point::planar(high.x, low.y), Point::planar(low.x, high.y));
                let edges = [(*low, right), (right, *high), (*high, left), (left, *low)];
                ray_to_edges(edges.into_iter(), origin, direction)
            }
        };
        entry.filter(|&distance| distance <= range)
    }

    /// Whether the segment touches the obstacle or comes nearer than `clearance` metres, not negative.
    fn comes_within(&self, a: Point, b: Point, clearance: f64) -> bool {
        let Some(span) = self.height() else {
            return self.comes_within_planar(a, b, clearance);
        };
        let Some((a, b)) = clip_height(a, b, span.low - clearance, span.high + clearance) else {
            return false;
        };
        if !self.comes_within_planar(a, b, clearance) {
            return false;
        }
        if let Some((a, b)) = clip_height(a, b, span.low, span.high)
            && self.comes_within_planar(a, b, clearance)
        {
            return true;
        }
        clearance > 0.0 && self.comes_within_rim(a, b, clearance)
    }

    /// The same for a segment whose nearest point is above or below the obstacle. The squared distance
    /// from a convex body along a segment is convex with a known slope, so bisection finds its least
    /// value; the tangents bound it from below and usually end the search at once.
    fn comes_within_rim(&self, a: Point, b: Point, clearance: f64) -> bool {
        let Some(span) = self.height() else {
            return false;
        };
        let limit = clearance * clearance;
        let way = b - a;
        let (mut start, mut end) = (0.0, 1.0);
        for _ in 0..64 {
            let middle = 0.5 * (start + end);
            let p = a + way * middle;
            let nearest = self.planar_nearest(p);
            let z = lesser(greater(p.z, span.low), span.high);
            let offset = p - nearest.at_height(z);
            let squared = offset.length_squared();
            if squared < limit {
                return true;
            }
            let slope = 2.0 * offset.dot(way);
            let other_end = if slope > 0.0 { start } else { end };
            if squared + slope * (other_end - middle) >= limit {
                return false;
            }
            if slope > 0.0 {
                end = middle;
            } else {
                start = middle;
            }
        }
        false
    }

    /// Whether the segment touches the base or comes nearer than `clearance` metres, heights left out.
    fn comes_within_planar(&self, a: Point, b: Point, clearance: f64) -> bool {
        let near = |squared: f64, reach: f64| {
            if clearance > 0.0 {
                squared < reach * reach
            } else {
                squared <= reach * reach
            }
        };
        match &self.shape {
            Shape::Polygon { base, .. } => polygon_near(base, a, b, clearance),
            Shape::Circle { center, radius, .. } => {
                near(squared_to_segment(*center, a, b), radius + clearance)
            }
            Shape::Cuboid { low, high } => rectangle_near(*low, *high, a, b, clearance),
        }
    }
}

/// Whether the segment touches the rectangle or comes nearer than `clearance` metres.
fn rectangle_near(low: Point, high: Point, a: Point, b: Point, clearance: f64) -> bool {
    if clearance == 0.0 {
        return meets_rectangle(a, b, low, high);
    }
    let grown = Bounds { low, high }.inflated(clearance);
    if !meets_rectangle(a, b, grown.low, grown.high) {
        return false;
    }
    if meets_rectangle(a, b, low, high) {
        return true;
    }
    // Apart, so an end of the segment or a corner of the rectangle is nearest.
    let limit = clearance * clearance;
    let corners = [
        low,
        high,
        Point::planar(low.x, high.y),
        Point::planar(high.x, low.y),
    ];
    let end_near = |p: Point| rectangle_distance(p, low, high) < clearance;
    end_near(a) || end_near(b) || corners.iter().any(|&p| squared_to_segment(p, a, b) < limit)
}

/// Whether the segment touches the polygon or comes nearer than `clearance` metres.
fn polygon_near(base: &ConvexPolygon, a: Point, b: Point, clearance: f64) -> bool {
    let limit = clearance * clearance;
    // Separating lines: the edges of the polygon, and the segment itself.
    let (mut apart, mut left, mut right) = (false, false, false);
    for (from, to) in base.edges() {
        let outside = lesser(-turn(from, to, a), -turn(from, to, b));
        if outside > 0.0 {
            if outside * outside >= limit * planar_squared(from, to) {
                return false;
            }
            apart = true;
        }
        let side = turn(a, b, to);
        left |= side >= 0.0;
        right |= side <= 0.0;
    }
    apart |= !(left && right);
    if base.is_wall() {
        // A segment on the line of the wall may still lie beyond its ends.
        let (from, to) = (base.vertices()[0], base.vertices()[1]);
        let way = to - from;
        let along = |p: Point| (p.x - from.x) * way.x + (p.y - from.y) * way.y;
        let (low, high) = (lesser(along(a), along(b)), greater(along(a), along(b)));
        apart |= high < 0.0 || low > along(to);
    }
    if !apart {
        return true;
    }
    // Apart, so an end of the segment or a corner of the polygon is nearest.
    let near = |p: Point, a: Point, b: Point| squared_to_segment(p, a, b) < limit;
    base.edges()
        .any(|(from, to)| near(a, from, to) || near(b, from, to) || near(to, a, b))
}

/// Distance along a ray to a convex outline given counter-clockwise (Cyrus and Beck, 1978).
fn ray_to_edges(
    edges: impl Iterator<Item = (Point, Point)>,
    origin: Point,
    direction: Point,
) -> Option<f64> {
    let (mut entry, mut exit) = (0.0, f64::INFINITY);
    for (from, to) in edges {
        let inside = turn(from, to, origin);
        let rate = (to - from).cross_planar(direction);
        if rate == 0.0 {
            if inside < 0.0 {
                return None;
            }
        } else if rate > 0.0 {
            entry = greater(-inside / rate, entry);
        } else {
            exit = lesser(-inside / rate, exit);
        }
    }
    (entry <= exit).then_some(entry)
}

fn ray_to_wall(from: Point, to: Point, origin: Point, direction: Point) -> Option<f64> {
    let (way, start) = (to - from, from - origin);
    let rate = direction.cross_planar(way);
    if rate == 0.0 {
        // Along the wall's own line it meets the nearer end.
        let planar_dot = |p: Point| p.x * direction.x + p.y * direction.y;
        let nearer = lesser(planar_dot(start), planar_dot(to - origin));
        return (start.cross_planar(direction) == 0.0 && nearer >= 0.0).then_some(nearer);
    }
    let distance = start.cross_planar(way) / rate;
    let along = start.cross_planar(direction) / rate;
    (distance >= 0.0 && (0.0..=1.0).contains(&along)).then_some(distance)
}

fn ray_to_circle(center: Point, radius: f64, origin: Point, direction: Point) -> Option<f64> {
    let way = center - origin;
    let along = way.x * direction.x + way.y * direction.y;
    let aside = direction.cross_planar(way);
    let squared = radius * radius - aside * aside;
    (along >= 0.0 && squared >= 0.0).then(|| greater(along - math::sqrt(squared), 0.0))
}
