//! Finding a way: from where a robot is to where it should be, clear of everything unsafe.
//!
//! [`plan`] is what hosts call. It grows the obstacles by the robot's body, looks whether the
//! straight way is free (most often it is, and nothing else is done), and otherwise lets one of the
//! planners search: [`rrt`], [`rrt_connect`] or [`rrt_star`], in the plane for robots on the floor and
//! in space for those in the air. Paths are then made taut ([`shorten`]).
//!
//! The planners know nothing of robots: they search a [`space::Space`]. Everything is exact, no path
//! is tested at sample points, and the same request gives the same path on every machine.

pub mod box_tree;
pub mod cost_tree;
mod driving;
pub mod ellipsoid;
pub mod escape;
pub mod free_space;
mod grow;
pub mod grown;
pub mod nearest;
pub mod rrt;
pub mod rrt_connect;
pub mod rrt_star;
pub mod shorten;
pub mod space;
pub mod tree;
pub mod vector;

use crate::{Model, Neighbour};
use alloc::vec::Vec;
use driving::Driving;
use free_space::FreeSpace;
use grow::Mover;
use space::Space;
use starl_core::geometry::Obstacle;
use starl_core::motion::{Body, Estimate, Path, PlanRequest, Planner};
use starl_core::{Point, Pose, Random};
use vector::Vector;

/// What a host may change about planning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// How far paths stay away from things beyond the body's own radius, as a part of that radius.
    /// Where the target or its vicinity leaves less room than that, half of it.
    pub margin_radii: f64,
    /// How far a robot that is too near to something may go to get clear of it, in radii.
    pub escape_radii: f64,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            margin_radii: 0.15,
            escape_radii: 4.0,
        }
    }
}

/// Way-points from the estimated pose to the target of the request, the last of them exactly the
/// target; none if the planner gave up.
///
/// - The body keeps out of the unsafe set all along the way, `margin_radii` further off than it must.
/// - If the target is not free, the free point nearest to it takes its place, unless that is more
///   than the request's vicinity away.
/// - If the start is too near to something, the first way-point is the nearest free place that can be
///   reached by moving away from it. A robot whose centre is inside an obstacle gets no path.
/// - A robot in the air that is below its lowest height of travel is taken to have risen there.
pub fn plan(
    model: &dyn Model,
    start: &Estimate,
    request: &PlanRequest,
    robots: &[Neighbour],
) -> Option<Path> {
    plan_with(&Options::default(), model, start, request, robots)
}

/// [`plan`] with options.
pub fn plan_with(
    options: &Options,
    model: &dyn Model,
    start: &Estimate,
    request: &PlanRequest,
    robots: &[Neighbour],
) -> Option<Path> {
    let body = model.body();
    let from = body.reachable(start.pose.position);
    let target = body.reachable(request.target);
    if !from.is_finite() || !target.is_finite() {
        return None;
    }
    let robots = if request.around_robots { robots } else { &[] };
    let task = Task {
        start,
        options,
        model,
        request,
        robots,
        body,
        from,
        target,
    };
    if body.flies() {
        task.solve::<3>()
    } else {
        task.solve::<2>()
    }
}

/// Edges of trees shorter than this are not worth a node, in radii.
const SHORTEST_STEP: f64 = 0.01;

/// Rounds of shortening; most paths are taut sooner.
const ROUNDS: u32 = 8;

struct Task<'a> {
    start: &'a Estimate,
    options: &'a Options,
    model: &'a dyn Model,
    request: &'a PlanRequest,
    robots: &'a [Neighbour],
    body: Body,
    from: Point,
    target: Point,
}

impl Task<'_> {
    fn solve<const D: usize>(&self) -> Option<Path> {
        let obstacles: &[Obstacle] = &self.request.unsafe_set;
        let mover = Mover {
            body: self.body,
            margin: self.margin(obstacles),
        };
        let space = mover.space::<D>(self.from, self.target, obstacles, self.robots);
        let (from, target) = (Mover::to_space(self.from), Mover::to_space(self.target));
        let drives = self.planner() == Planner::Rrt;
        if !drives && space.sees(&from, &target) {
            return Some(alloc::vec![self.target]);
        }
        let target = escape::nearest_free(&space, &target, self.request.vicinity)?;
        let within = self.options.escape_radii * self.body.radius;
        let root = match space.is_free(&from) {
            true => from,
            false => escape::escape(&space, &from, within)?,
        };
        let found = match drives {
            true => self.drive(&space, &root, &target)?,
            false => self.search(&space, &root, &target)?,
        };
        // The root is the first way-point only where it is not where the robot is.
        let path = found.iter().skip(usize::from(root == from));
        Some(path.map(Mover::to_world).collect())
    }

    /// The planner asked for, or the one that suits the model.
    fn planner(&self) -> Planner {
        match self.request.planner {
            Planner::Auto if self.model.limits().turn_radius > 0.0 => Planner::Rrt,
            Planner::Auto => Planner::RrtConnect,
            planner => planner,
        }
    }

    fn random(&self) -> Random {
        Random::keyed(self.request.seed, &[])
    }

    /// A path for a robot that goes straight wherever it likes, both ends included.
    fn search<const D: usize>(
        &self,
        space: &FreeSpace<D>,
        root: &Vector<D>,
        target: &Vector<D>,
    ) -> Option<Vec<Vector<D>>> {
        let mut random = self.random();
        let most_nodes = self.request.most_nodes;
        let shortest_step = SHORTEST_STEP * self.body.radius;
        let options = rrt_connect::Options {
            most_nodes,
            longest_step: f64::INFINITY,
            shortest_step,
        };
        let mut path = rrt_connect::rrt_connect(space, root, target, &options, &mut random)?;
        shorten::shorten(space, &mut path, ROUNDS);
        if self.planner() == Planner::RrtStar {
            let options = rrt_star::Options {
                most_nodes,
                long_enough: 0.0,
                shortest_step,
            };
            path = rrt_star::rrt_star(space, root, target, &path, &options, &mut random)?;
            shorten::shorten(space, &mut path, ROUNDS);
        }
        Some(path)
    }

    /// Way-points that the robot follows in its own manner, the root included.
    fn drive<const D: usize>(
        &self,
        space: &FreeSpace<D>,
        root: &Vector<D>,
        target: &Vector<D>,
    ) -> Option<Vec<Vector<D>>> {
        let driving = Driving {
            model: self.model,
            space,
        };
        let mut pose = Pose {
            position: self.from,
            ..self.start.pose
        };
        if *root != Mover::to_space(self.from) {
            // The robot is taken to stand at the first way-point, as it came there.
            let turned = driving.force(&self.model.at_rest(pose), root).pose;
            pose = Pose {
                position: Mover::to_world(root),
                ..turned
            };
        }
        let state = self.model.at_rest(pose);
        let options = rrt::Options {
            most_nodes: self.request.most_nodes,
            threshold: driving::SHORTEST_DRIVE,
        };
        let start = (root, state);
        let mut path = rrt::rrt(space, &driving, start, target, &options, &mut self.random())?;
        driving.leave_out(&state, &mut path);
        Some(path)
    }

    /// The margin in metres: the one asked for, or half of the room that the target leaves. A target
    /// that is not free leaves as much as its vicinity reaches beyond the nearest free point.
    fn margin(&self, obstacles: &[Obstacle]) -> f64 {
        let Body { radius, height, .. } = self.body;
        let gaps = obstacles
            .iter()
            .map(|obstacle| obstacle.body_gap(self.target, radius, height));
        let gap = gaps.fold(
            f64::INFINITY,
            |least, gap| if gap < least { gap } else { least },
        );
        let room = if gap > 0.0 {
            gap
        } else {
            gap + self.request.vicinity
        };
        (0.5 * room).clamp(0.0, self.options.margin_radii * radius)
    }
}
