//! The borders that neighbours and obstacles put around a robot.
//!
//! The border between two robots splits the gap between their stopping segments: from a robot's position to where it
//! stops if it brakes now. Both robots use the same two segments, so both find the same line between them, and as long
//! as each keeps its segment behind that line they stay apart. It is the gap between the bodies that is split, so
//! robots of unequal size get equal room. An obstacle's border lies at the obstacle: all the room before it is the
//! robot's own.

use super::cell::{Border, Cell};
use super::pace::Pace;
use super::plane::{between_segments, least_on_segment};
use crate::Neighbour;
use starl_core::motion::{Body, Estimate};
use starl_core::{Obstacle, Point};

/// Room kept to obstacles, metres: paths are planned farther away, but inertia, or room made for
/// neighbours, takes robots off them.
pub(crate) const OBSTACLE_MARGIN: f64 = 0.02;

/// A target that is nearer to an obstacle than that leaves so much room to get there, metres.
const PLAY: f64 = 0.003;

/// Towards obstacles robots are assumed to coast by this factor farther than they do, and for an
/// additional period: overshooting is worse there, because an obstacle does not make room. Measured with
/// the AR.Drone.
const OBSTACLE_COAST: f64 = 1.25;

/// More than what rounding adds to a gap, metres.
const ROUNDING: f64 = 1e-6;

/// A robot among others.
pub(super) struct Surroundings<'a> {
    pub body: &'a Body,
    pub pace: &'a Pace,
    pub estimate: &'a Estimate,
    /// Robots at the same height.
    pub neighbours: &'a [Neighbour],
    pub obstacles: &'a [Obstacle],
    /// Where the robot wants to go in the end.
    pub target: Point,
    /// See [`super::Options::margin`].
    pub margin: f64,
    /// See [`crate::Model::braking_way`].
    pub braking_way: Point,
    /// The greatest age of the knowledge of neighbours, seconds.
    pub period: f64,
}

impl Surroundings<'_> {
    /// The cell, without borders that do not matter at cruise speed.
    pub fn cell(&self) -> Cell {
        let mut cell = Cell::default();
        let own_way = self.estimate.twist.linear.at_height(0.0) * self.pace.braking_time;
        for neighbour in self.neighbours {
            if let Some(border) = self.border(neighbour, own_way) {
                cell.push(border);
            }
        }
        let unnoticed = self.estimate.twist.linear.at_height(0.0) * self.period;
        let own_way = self.braking_way * OBSTACLE_COAST + unnoticed;
        for obstacle in self.obstacles {
            if let Some(border) = self.obstacle_border(obstacle, own_way) {
                cell.push(border);
            }
        }
        cell
    }

    fn border(&self, neighbour: &Neighbour, own_way: Point) -> Option<Border> {
        let Surroundings { pace, .. } = self;
        let offset = (neighbour.position - self.estimate.pose.position).at_height(0.0);
        let velocity = neighbour.velocity.at_height(0.0);
        let radii = self.body.radius + neighbour.radius;
        let late = velocity.planar_length() * self.period;
        let near = radii + 2.0 * (pace.room_needed + self.margin) + late;
        if offset.length_squared() > near * near {
            return None;
        }
        // The knowledge of the neighbour may be a period old.
        let its_way = velocity * (pace.braking_time + self.period);
        let apart = between_segments(own_way, offset, its_way);
        let normal = match (apart.normalized(), offset.normalized()) {
            (Some(normal), _) | (None, Some(normal)) => normal,
            // At the very same place: any direction will do.
            (None, None) => Point::planar(1.0, 0.0),
        };
        let room = 0.5 * (apart.planar_length() - radii) - self.margin;
        let speed = room / pace.horizon;
        (speed < pace.cruise_speed).then(|| Border {
            normal,
            speed,
            from_target: neighbour.position.planar_distance(self.target),
        })
    }

    /// The border towards an obstacle, on the robot's side only; none if it does not matter at cruise
    /// speed. A target nearer to the obstacle than the usual margin stays within reach.
    fn obstacle_border(&self, obstacle: &Obstacle, own_way: Point) -> Option<Border> {
        let Body { radius, height, .. } = *self.body;
        let position = self.estimate.pose.position;
        let beside = obstacle
            .height()
            .is_none_or(|span| span.low < position.z + height && position.z < span.high);
        if !beside || self.is_far(obstacle, own_way) {
            return None;
        }
        // A body that is half inside an obstacle is not the business of avoidance.
        if obstacle.contains(position) {
            return None;
        }
        let (least_gap, at) = least_on_segment(position, own_way, |point| {
            obstacle.body_gap(point, radius, height)
        });
        let at_target = obstacle.body_gap(self.target.at_height(position.z), radius, height);
        let room = least_gap - (at_target - PLAY).clamp(0.0, OBSTACLE_MARGIN);
        let speed = room / self.pace.horizon;
        if speed >= self.pace.cruise_speed {
            return None;
        }
        // Where the stopping segment ends inside the obstacle, the side it comes from counts.
        let towards = |from: Point| (obstacle.nearest_point(from) - from).at_height(0.0);
        let normal = towards(at).normalized();
        let normal = normal.or_else(|| towards(position).normalized())?;
        Some(Border {
            normal,
            speed,
            from_target: f64::INFINITY,
        })
    }

    /// Whether an obstacle is too far away to matter anywhere on the robot's own way: the gap cannot shrink by
    /// more than the way is long. Most obstacles of a large world are.
    fn is_far(&self, obstacle: &Obstacle, own_way: Point) -> bool {
        let Body { radius, height, .. } = *self.body;
        let gap = obstacle.body_gap(self.estimate.pose.position, radius, height);
        let least = gap - own_way.length() - OBSTACLE_MARGIN - ROUNDING;
        least >= self.pace.cruise_speed * self.pace.horizon
    }
}
