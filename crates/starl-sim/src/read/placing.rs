//! Finds out whether a body can stand somewhere, and draws places where it can.
//!
//! Random places are drawn uniformly and thrown away until one is free (rejection sampling), each
//! robot from a stream of its own, so that its place does not depend on draws for others, only on
//! where they stand.

use super::Placed;
use super::contents::Contents;
use super::fleet::Draft;
use super::grid::{Body, Grid};
use super::names::Names;
use super::report::{Origin, Report};
use crate::scenario::Bounds;
use starl_core::geometry::{Bounds as Box, ObstacleIndex};
use starl_core::{Obstacle, Point, Pose, Random, RobotId, math};
use std::ops::ControlFlow;

/// Names the draws of start places among all draws from the seed.
const PURPOSE: u64 = 0x706c_6163_655f_7374; // "place_st"

/// After so many places that are not free, there is no room.
const ATTEMPTS: u32 = 20_000;

/// The bodies that have a place, and what keeps others from having the same.
pub(super) struct Placing<'a> {
    obstacles: ObstacleIndex,
    bounds: Option<Bounds>,
    bodies: Grid,
    robots: Vec<RobotId>,
    /// Where robots go whose group has no area of its own.
    fallback: Bounds,
    report: &'a Report,
}

impl<'a> Placing<'a> {
    /// No robot has a place yet.
    pub fn new(
        drafts: &[Draft],
        contents: &Contents,
        fallback: Bounds,
        report: &'a Report,
    ) -> Placing<'a> {
        let obstacles: Vec<Obstacle> = contents
            .obstacles
            .iter()
            .map(|obstacle| obstacle.obstacle.clone())
            .collect();
        let manned = || drafts.iter().filter(|draft| draft.count > 0);
        let radius = manned()
            .map(|draft| draft.model.body().radius)
            .fold(0.0, f64::max);
        let spacing = manned().map(|draft| draft.spacing).fold(0.0, f64::max);
        let count: usize = drafts.iter().map(|draft| draft.count).sum();
        let areas = manned().filter_map(|draft| draft.area.as_ref().map(|area| area.value));
        let whole = areas.fold(fallback, Bounds::joined);
        Placing {
            obstacles: ObstacleIndex::new(&obstacles),
            bounds: contents.bounds.as_ref().map(|bounds| bounds.value),
            bodies: Grid::new(whole.low, whole.high, 2.0 * radius + spacing, count),
            robots: Vec::with_capacity(count),
            fallback,
            report,
        }
    }

    fn insert(&mut self, body: Body, robot: RobotId) {
        self.bodies.insert(body);
        self.robots.push(robot);
    }

    /// Whether an obstacle is nearer to the body than `gap`, metres.
    fn blocked(&self, body: &Body, gap: f64) -> bool {
        let at = body.position;
        let around = Box::of_body(at, at, body.radius, body.height).inflated(gap);
        let near = |index: u32| {
            let obstacle = &self.obstacles.obstacles()[index as usize];
            match obstacle.body_gap(at, body.radius, body.height) < gap {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        };
        self.obstacles.for_each_near(&around, near).is_break()
    }

    /// Whether the body is wholly within the world's bounds.
    fn within(&self, body: &Body) -> bool {
        self.bounds.is_none_or(|Bounds { low, high }| {
            let (at, radius) = (body.position, body.radius);
            low.x + radius <= at.x
                && at.x <= high.x - radius
                && low.y + radius <= at.y
                && at.y <= high.y - radius
        })
    }

    /// Adds a given start, or reports why a robot cannot be there.
    pub fn check(&mut self, draft: &Draft, names: &Names, robot: RobotId, start: &Placed<Pose>) {
        let body = body(draft, start.value.position);
        let name = names.name(robot);
        let complain = |message: String, help: &str| {
            self.report
                .problem_with_help(start.origin, &start.field, message, help);
        };
        if body.position.z < 0.0 || (body.position.z > 0.0 && !draft.model.body().flies()) {
            complain(
                format!("{name} does not start on the floor"),
                "leave its height at 0",
            );
        } else if !self.within(&body) {
            let help = "move it inside, its radius away from the walls";
            complain(
                format!("{name} starts outside the bounds of the world"),
                help,
            );
        } else if self.blocked(&body, 0.0) {
            complain(
                format!("{name} starts inside an obstacle"),
                "move the robot or the obstacle",
            );
        } else if let Some(index) = self
            .bodies
            .find(body.position, |other| overlap(&body, other))
        {
            let other = names.name(self.robots[index]);
            complain(
                format!("{name} overlaps {other} at the start"),
                "move one of them",
            );
        }
        self.insert(body, robot);
    }

    /// Where robots of a group are placed.
    pub fn area(&self, draft: &Draft) -> Bounds {
        draft.area.as_ref().map_or(self.fallback, |area| area.value)
    }

    /// A free place for a robot without a start; reports it if there is none.
    pub fn draw(
        &mut self,
        draft: &Draft,
        names: &Names,
        robot: RobotId,
        seed: u64,
    ) -> Option<Pose> {
        let (origin, field) = match &draft.area {
            Some(area) => (area.origin, area.field.clone()),
            None => (draft.origin, draft.path.clone()),
        };
        let area = self.area(draft);
        let radius = draft.model.body().radius;
        let (low, high) = (area.low, area.high);
        let mut random = Random::keyed(seed, &[PURPOSE, robot.0.into()]);
        for _ in 0..ATTEMPTS {
            let x = random.between(low.x + radius, high.x - radius);
            let y = random.between(low.y + radius, high.y - radius);
            let body = body(draft, Point::planar(x, y));
            let too_near = |other: &Body| {
                let least = body.radius + other.radius + draft.spacing;
                body.position.planar_distance(other.position) < least
            };
            let fits = low.x + radius <= high.x - radius && low.y + radius <= high.y - radius;
            if fits
                && self.within(&body)
                && self.bodies.find(body.position, too_near).is_none()
                && !self.blocked(&body, draft.spacing)
            {
                self.insert(body, robot);
                let heading = random.between(-math::PI, math::PI);
                return Some(Pose::level(body.position, heading));
            }
        }
        let name = names.name(robot);
        let message = format!("there is no room left to place {name} in");
        let help = "enlarge the area, or have fewer robots or less `spacing`";
        self.complain(origin, &field, message, help);
        None
    }

    fn complain(&self, origin: Origin, field: &str, message: String, help: &str) {
        self.report.problem_with_help(origin, field, message, help);
    }
}

fn body(draft: &Draft, position: Point) -> Body {
    let body = draft.model.body();
    Body {
        position,
        radius: body.radius,
        height: body.height,
    }
}

/// Whether two bodies share some space.
fn overlap(a: &Body, b: &Body) -> bool {
    let apart = a.position.z >= b.position.z + b.height || b.position.z >= a.position.z + a.height;
    !apart && a.position.planar_distance(b.position) < a.radius + b.radius
}
