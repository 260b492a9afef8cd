//! The borders that neighbours and obstacles put around a robot.
//!
//! The border between two robots splits the gap between their stopping segments: from where a robot is
//! to where it stops if it brakes now. Both robots judge the same two segments, so both find the same
//! line between them, and as long as each keeps its segment behind that line they stay apart. It is
//! the gap between the bodies that is split, so robots of unequal size get equal room.

use super::cell::{Border, Cell};
use super::pace::Pace;
use super::plane::{between_segments, larger};
use crate::pilot::Neighbour;
use starl_core::motion::{Body, Estimate};
use starl_core::{Obstacle, Point};

/// Room kept to obstacles by a robot that is off its planned path, metres.
const OBSTACLE_MARGIN: f64 = 0.02;

/// A robot among others.
pub(super) struct Surroundings<'a> {
    pub body: &'a Body,
    pub pace: &'a Pace,
    pub estimate: &'a Estimate,
    /// Robots at the same height.
    pub neighbours: &'a [Neighbour],
    /// Where the robot wants to go in the end.
    pub target: Point,
    /// See [`super::Options::margin`].
    pub margin: f64,
    /// How old what is known of neighbours may be, seconds.
    pub period: f64,
}

impl Surroundings<'_> {
    /// The cell among the neighbours, without borders that do not matter at cruise speed.
    pub fn cell(&self) -> Cell {
        let mut cell = Cell::default();
        let own_way = self.estimate.twist.linear.at_height(0.0) * self.pace.braking_time;
        for neighbour in self.neighbours {
            if let Some(border) = self.border(neighbour, own_way) {
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
        // What is known of the neighbour may be a period old.
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

    /// Adds the borders of nearby obstacles, which nobody shares: they keep a robot that is off its
    /// planned path from sliding into a wall. A target nearer to an obstacle than the usual margin
    /// stays within reach.
    pub fn add_obstacles(&self, cell: &mut Cell, obstacles: &[Obstacle]) {
        let Body { radius, height, .. } = *self.body;
        let position = self.estimate.pose.position;
        for obstacle in obstacles {
            let beside = obstacle
                .height()
                .is_none_or(|span| span.low < position.z + height && position.z < span.high);
            let gap = obstacle.body_gap(position, radius, height);
            // A body that is half inside an obstacle is not the business of avoidance.
            let far = gap >= self.pace.room_needed + OBSTACLE_MARGIN;
            if !beside || far || obstacle.contains(position) {
                continue;
            }
            let at_target = obstacle.body_gap(self.target.at_height(position.z), radius, height);
            let margin = at_target.clamp(0.0, OBSTACLE_MARGIN);
            let towards = (obstacle.nearest_point(position) - position).at_height(0.0);
            if let Some(normal) = towards.normalized() {
                let room = larger(gap - margin, 0.0);
                cell.push(Border {
                    normal,
                    speed: self.pace.speed_towards(normal, room, self.estimate),
                    from_target: f64::INFINITY,
                });
            }
        }
    }
}
