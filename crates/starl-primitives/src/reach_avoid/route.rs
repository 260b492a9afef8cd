//! A path with the place on it that the robot has come to.
//!
//! Invariant: there is always a point to go to. Positions are taken as [`Body::reachable`] puts them,
//! so a robot on the floor is measured in the plane, and one that is still taking off as if it were at
//! its lowest height of travel.

use starl_core::Point;
use starl_core::motion::{Body, Path};

/// A path on the way.
#[derive(Clone, Debug)]
pub(super) struct Route {
    /// Where it starts, then the waypoints.
    points: Path,
    /// The point to go to now; at least 1.
    at: usize,
}

impl Route {
    /// The path from `start`; none if it has no points or one that is not finite.
    pub fn new(start: Point, path: Path, body: &Body) -> Option<Route> {
        if path.is_empty() || !path.iter().all(|point| point.is_finite()) {
            return None;
        }
        let points = core::iter::once(start).chain(path);
        Some(Route {
            points: points.map(|point| body.reachable(point)).collect(),
            at: 1,
        })
    }

    /// The point to go to now.
    pub fn current(&self) -> Point {
        self.points[self.at]
    }

    /// The point after it.
    pub fn next(&self) -> Option<Point> {
        self.points.get(self.at + 1).copied()
    }

    /// The last point.
    pub fn end(&self) -> Point {
        self.points[self.points.len() - 1]
    }

    /// Where it starts, then all waypoints.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Counts waypoints as passed that the robot at `position` has come to: within `wide` metres, or
    /// past it and within twice that, if one can go straight on to the next; in any case within `near`.
    /// `free` says whether one can go from a point to another. Says whether any were passed. The last
    /// never is.
    pub fn advance(
        &mut self,
        position: Point,
        near: f64,
        wide: f64,
        free: impl Fn(Point, Point) -> bool,
    ) -> bool {
        let before = self.at;
        while let Some(next) = self.next() {
            let (from, current) = (self.points[self.at - 1], self.current());
            let distance = position.distance(current);
            let past = (position - current).dot(current - from) >= 0.0;
            let reach = if past { 2.0 * wide } else { wide };
            let passed = distance <= near || distance <= reach && free(position, next);
            if !passed {
                break;
            }
            self.at += 1;
        }
        self.at != before
    }

    /// Distance from the part of the path that the robot is on, metres.
    pub fn cross_track(&self, position: Point) -> f64 {
        let (from, to) = (self.points[self.at - 1], self.current());
        let way = to - from;
        let squared = way.length_squared();
        if squared <= 0.0 {
            return position.distance(to);
        }
        let fraction = ((position - from).dot(way) / squared).clamp(0.0, 1.0);
        position.distance(from.lerp(to, fraction))
    }

    /// Metres still to go.
    pub fn remaining(&self, position: Point) -> f64 {
        self.ahead(position)
            .map(|(from, to)| from.distance(to))
            .sum()
    }

    /// The straight parts still to go.
    pub fn ahead(&self, position: Point) -> impl Iterator<Item = (Point, Point)> + '_ {
        let rest = &self.points[self.at..];
        core::iter::once((position, rest[0])).chain(rest.windows(2).map(|pair| (pair[0], pair[1])))
    }
}
