//! A robot's cell: the velocities with which its stopping point stays on its own side of every border.
//!
//! Invariant: the zero velocity is in the cell unless the robot is already too near to a neighbour; then a velocity
//! away from it is. Every border is a half-plane; the velocity nearest to the desired one is found by the incremental
//! method for convex programs in the plane (Seidel 1991, "Small-dimensional linear programming and convex hulls made
//! easy"; used for the velocities of robots by van den Berg, Guy, Lin and Manocha 2011), in the order given instead of
//! a random one: borders are few, and the answer must not depend on chance.

use super::plane::{larger, smaller};
use smallvec::SmallVec;
use starl_core::Point;

/// The border towards one neighbour or obstacle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Border {
    /// Unit vector in the plane, from the robot towards the neighbour.
    pub normal: Point,
    /// Metres per second the robot may have that way; negative if it must move away.
    pub speed: f64,
    /// Distance of the neighbour from the robot's target, metres; infinite for an obstacle.
    pub from_target: f64,
}

/// Borders relative to the robot's centre.
#[derive(Clone, Debug, Default)]
pub(super) struct Cell {
    borders: SmallVec<[Border; 12]>,
}

/// The borders that may ask the robot to stand still at most, not to move away.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Floor {
    None,
    Obstacles,
    All,
}

impl Floor {
    fn speed(self, border: &Border) -> f64 {
        let obstacle = border.from_target == f64::INFINITY;
        match self == Floor::All || self == Floor::Obstacles && obstacle {
            true => larger(border.speed, 0.0),
            false => border.speed,
        }
    }
}

/// Borders closer to parallel than this are taken as parallel (sine of the angle).
const PARALLEL: f64 = 1e-9;

impl Cell {
    /// Adds a border.
    pub fn push(&mut self, border: Border) {
        self.borders.push(border);
    }

    /// The borders.
    pub fn borders(&self) -> &[Border] {
        &self.borders
    }

    /// Whether nothing bounds the cell.
    pub fn is_empty(&self) -> bool {
        self.borders.is_empty()
    }

    /// The velocity nearest to `wish` that all borders allow. If the robot is too near to satisfy all of them, it does
    /// not have to move away from obstacles; if that is not enough, it moves away from bodies that are too near as far
    /// as the other borders allow.
    pub fn velocity(&self, wish: Point) -> Point {
        let found = self.solve(wish, Floor::None);
        if let Some(found) = found.or_else(|| self.solve(wish, Floor::Obstacles)) {
            return found;
        }
        let away = self
            .borders
            .iter()
            .filter(|border| border.speed < 0.0)
            .fold(Point::ZERO, |sum, border| {
                sum + border.normal * border.speed
            });
        // Where no border asks for moving away, standing still is always allowed.
        self.solve(away, Floor::All).unwrap_or(Point::ZERO)
    }

    /// The velocity nearest to `wish` behind every border.
    fn solve(&self, wish: Point, floor: Floor) -> Option<Point> {
        let mut best = wish.at_height(0.0);
        for (index, border) in self.borders.iter().enumerate() {
            let speed = floor.speed(border);
            if best.dot(border.normal) > speed {
                best = self.nearest_on_border(index, speed, wish, floor)?;
            }
        }
        Some(best)
    }

    /// The velocity nearest to `wish` on one border that is behind all earlier ones.
    fn nearest_on_border(
        &self,
        index: usize,
        speed: f64,
        wish: Point,
        floor: Floor,
    ) -> Option<Point> {
        let normal = self.borders[index].normal;
        let along = Point::planar(-normal.y, normal.x);
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for other in &self.borders[..index] {
            let slope = along.dot(other.normal);
            let left = floor.speed(other) - speed * normal.dot(other.normal);
            if slope > PARALLEL {
                high = smaller(high, left / slope);
            } else if slope < -PARALLEL {
                low = larger(low, left / slope);
            } else if left < -PARALLEL {
                return None;
            }
        }
        if low > high {
            return None;
        }
        let at = smaller(larger(wish.dot(along), low), high);
        Some(normal * speed + along * at)
    }

    /// The greatest speed of the robot in a direction of length one, metres per second; not negative, infinite if the
    /// direction is free. Borders that it meets at an angle whose sine is `grazing` or less do not count.
    pub fn speed(&self, direction: Point, grazing: f64) -> f64 {
        let mut least = f64::INFINITY;
        for border in &self.borders {
            let slope = direction.dot(border.normal);
            if slope > larger(grazing, PARALLEL) {
                least = smaller(least, border.speed / slope);
            }
        }
        larger(least, 0.0)
    }
}
