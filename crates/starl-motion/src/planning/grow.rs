//! From the obstacles and robots of the world to the space of a planner.

use super::free_space::FreeSpace;
use super::grown::GrownList;
use super::vector::Vector;
use crate::Neighbour;
use starl_core::geometry::{HeightSpan, Obstacle, Point, Shape};
use starl_core::motion::{Body, Workspace};

/// A robot's body and the margin between it and obstacles.
#[derive(Clone, Copy, Debug)]
pub struct Mover {
    /// The body.
    pub body: Body,
    /// Metres; in the air also above and below.
    pub margin: f64,
    /// The rest of the margin near an end with this clearance, metres.
    pub least: f64,
    /// Where it yields to an end that has less than the least.
    pub yields: Yields,
}

/// How far the margin yields to the ends of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Yields {
    /// Near the end only.
    NearEnds,
    /// Along everything that leaves the end less than the least margin: the robot is in, or drives to, a passage too
    /// narrow for it.
    Along,
}

/// The share of the gap that remains at an end with less than the least margin. Below one, so that a
/// robot can leave a passage that it just fits into.
const KEPT: f64 = 0.9;

impl Mover {
    /// The planner's point for a place in the world.
    pub fn to_space<const D: usize>(point: Point) -> Vector<D> {
        let all = [point.x, point.y, point.z];
        core::array::from_fn(|axis| all[axis])
    }

    /// The place in the world of a planner's point; on the floor if that has no height.
    pub fn to_world<const D: usize>(point: &Vector<D>) -> Point {
        Point::new(point[0], point[1], if D > 2 { point[2] } else { 0.0 })
    }

    /// The heights at which the body's base would touch something in this span; none if it cannot.
    fn blocked_heights(&self, span: Option<HeightSpan>) -> Option<(f64, f64)> {
        let Some(span) = span else {
            return Some((f64::NEG_INFINITY, f64::INFINITY));
        };
        match self.body.workspace {
            // Standing on top of an obstacle is allowed, unless its thickness is 0.
            Workspace::Ground => {
                let met = self.body.height >= span.low && (0.0 < span.high || 0.0 <= span.low);
                met.then_some((f64::NEG_INFINITY, f64::INFINITY))
            }
            Workspace::Air { lowest } => {
                let low = span.low - self.body.height - self.margin;
                let high = span.high + self.margin;
                (high >= lowest).then_some((low, high))
            }
        }
    }

    /// Adds what the body's base must keep out of because of an obstacle, dented where one of the
    /// ends is in the margin.
    fn push_obstacle<const D: usize>(
        &self,
        obstacle: &Obstacle,
        ends: &[Point],
        list: &mut GrownList<D>,
    ) {
        let Some(span) = self.blocked_heights(obstacle.height()) else {
            return;
        };
        let reach = self.body.radius + self.margin;
        match &obstacle.shape {
            Shape::Polygon { base, .. } => {
                list.push_round(base.vertices().iter().map(|p| [p.x, p.y]), reach, span);
            }
            Shape::Circle { center, radius, .. } => {
                list.push_round(core::iter::once([center.x, center.y]), radius + reach, span);
            }
            Shape::Cuboid { low, high } => {
                let corners = [
                    [low.x, low.y],
                    [high.x, low.y],
                    [high.x, high.y],
                    [low.x, high.y],
                ];
                list.push_round(corners.into_iter(), reach, span);
            }
        }
        for &end in ends {
            let room = self.room_beside(obstacle, end);
            if 0.0 < room && room < self.margin {
                let kept = (0.5 * room).max(self.least.min(KEPT * room));
                let is_narrow = self.yields == Yields::Along && room < self.least;
                let reach = match is_narrow {
                    true => f64::INFINITY,
                    false => 2.0 * (self.margin - room),
                };
                list.dent_last(Mover::to_space(end), reach, self.margin - kept);
            }
        }
    }

    /// The greatest margin, metres, with which the body at a place would just touch the grown
    /// obstacle; not above zero where the body itself does, infinite where nothing could make it.
    fn room_beside(&self, obstacle: &Obstacle, at: Point) -> f64 {
        let planar = obstacle.planar_distance(at) - self.body.radius;
        let Some(span) = obstacle.height() else {
            return planar;
        };
        match self.body.workspace {
            Workspace::Ground if self.blocked_heights(Some(span)).is_none() => f64::INFINITY,
            Workspace::Ground => planar,
            Workspace::Air { .. } => {
                let above = at.z - span.high;
                let below = span.low - (at.z + self.body.height);
                planar.max(above).max(below)
            }
        }
    }

    /// The least [`Mover::room_beside`] anything.
    pub fn room(&self, at: Point, obstacles: &[Obstacle], robots: &[Neighbour]) -> f64 {
        let mut least = f64::INFINITY;
        self.for_each(obstacles, robots, |obstacle| {
            let room = self.room_beside(obstacle, at);
            least = if room < least { room } else { least };
        });
        least
    }

    /// The obstacles for the robot's base centre on a path between these ends.
    pub fn grow<const D: usize>(
        &self,
        obstacles: &[Obstacle],
        robots: &[Neighbour],
        ends: &[Point],
    ) -> GrownList<D> {
        let mut list = GrownList::new();
        self.for_each(obstacles, robots, |obstacle| {
            self.push_obstacle(obstacle, ends, &mut list);
        });
        list
    }

    /// Everything that is in the way and usable.
    fn for_each(
        &self,
        obstacles: &[Obstacle],
        robots: &[Neighbour],
        mut visit: impl FnMut(&Obstacle),
    ) {
        for obstacle in obstacles.iter().filter(|obstacle| obstacle.is_valid()) {
            visit(obstacle);
        }
        for robot in robots.iter().map(as_obstacle).filter(Obstacle::is_valid) {
            visit(&robot);
        }
    }

    /// The space in which the robot's base centre can move from `start` to `target`.
    ///
    /// It ends half the longest side of the box around start, target and obstacles beyond that box,
    /// and no less than eight radii. In height it reaches from the lowest height of travel to two
    /// bodies above start, target and whatever can be flown over.
    pub fn space<const D: usize>(
        &self,
        start: Point,
        target: Point,
        grown: GrownList<D>,
    ) -> FreeSpace<D> {
        let (low, high) = self.bounds(start, target, &grown);
        FreeSpace::new(low, high, grown)
    }

    fn bounds<const D: usize>(
        &self,
        start: Point,
        target: Point,
        list: &GrownList<D>,
    ) -> (Vector<D>, Vector<D>) {
        let (start, target): (Vector<D>, Vector<D>) =
            (Mover::to_space(start), Mover::to_space(target));
        let lesser = |a: f64, b: f64| if a < b { a } else { b };
        let greater = |a: f64, b: f64| if a > b { a } else { b };
        let mut low: Vector<D> = core::array::from_fn(|axis| lesser(start[axis], target[axis]));
        let mut high: Vector<D> = core::array::from_fn(|axis| greater(start[axis], target[axis]));
        for grown in list.all() {
            for axis in 0..D {
                // A thing without a top cannot be flown over.
                if axis < 2 || grown.high[axis] < f64::INFINITY {
                    high[axis] = greater(high[axis], grown.high[axis]);
                }
                if axis < 2 {
                    low[axis] = lesser(low[axis], grown.low[axis]);
                }
            }
        }
        let longest = greater(high[0] - low[0], high[1] - low[1]);
        let beyond = greater(0.5 * longest, 8.0 * self.body.radius);
        for axis in 0..2 {
            low[axis] -= beyond;
            high[axis] += beyond;
        }
        if let (Workspace::Air { lowest }, 3) = (self.body.workspace, D) {
            low[D - 1] = lesser(low[D - 1], lowest);
            high[D - 1] += 2.0 * self.body.height;
        }
        (low, high)
    }
}

/// Another robot as the upright cylinder that it is.
fn as_obstacle(robot: &Neighbour) -> Obstacle {
    let span = HeightSpan::new(robot.position.z, robot.position.z + robot.height);
    Obstacle::circle(robot.position, robot.radius).with_height(span)
}
