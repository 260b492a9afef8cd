//! Answering a request: from the world of robots to the planners' space and back.

use super::driving::{self, Driving};
use super::free_space::FreeSpace;
use super::grow::Mover;
use super::space::Space;
use super::vector::Vector;
use super::{Options, escape, rrt, rrt_connect, rrt_star, shorten};
use crate::{Model, Neighbour};
use alloc::vec::Vec;
use starl_core::motion::{Estimate, Path, PlanRequest, Planner};
use starl_core::{Point, Pose, Random};

/// Edges of trees shorter than this are not worth a node, in radii.
const SHORTEST_STEP: f64 = 0.01;

/// Rounds of shortening; most paths are taut sooner.
const ROUNDS: u32 = 8;

/// A request and all that bears on it.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    pub options: &'a Options,
    pub model: &'a dyn Model,
    pub start: &'a Estimate,
    pub request: &'a PlanRequest,
    /// Robots to keep away from.
    pub robots: &'a [Neighbour],
    /// Where the robot starts from, at a height it can travel at.
    pub from: Point,
    /// Where it should go, likewise.
    pub target: Point,
}

impl Task<'_> {
    /// The way-points, or none; in two coordinates on the floor, three in the air.
    pub fn solve<const D: usize>(&self) -> Option<Path> {
        let mover = self.mover();
        let grown = mover.grow::<D>(&self.request.unsafe_set, self.robots);
        let (from, target) = (Mover::to_space(self.from), Mover::to_space(self.target));
        let drives = self.planner() == Planner::Rrt;
        if !drives && grown.is_clear(&from, &target) {
            return Some(alloc::vec![self.target]);
        }
        let space = mover.space::<D>(self.from, self.target, grown);
        let target = escape::nearest_free(&space, &target, self.request.vicinity)?;
        let within = self.options.escape_radii * mover.body.radius;
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
        let mut path = self.connect(space, root, target, &mut random)?;
        shorten::shorten(space, &mut path, ROUNDS);
        if self.planner() == Planner::RrtStar {
            let options = rrt_star::Options {
                most_nodes: self.request.most_nodes,
                long_enough: 0.0,
                shortest_step: self.shortest_step(),
            };
            path = rrt_star::rrt_star(space, root, target, &path, &options, &mut random)?;
            shorten::shorten(space, &mut path, ROUNDS);
        }
        Some(path)
    }

    fn connect<const D: usize>(
        &self,
        space: &FreeSpace<D>,
        root: &Vector<D>,
        target: &Vector<D>,
        random: &mut Random,
    ) -> Option<Vec<Vector<D>>> {
        let options = rrt_connect::Options {
            most_nodes: self.request.most_nodes,
            longest_step: f64::INFINITY,
            shortest_step: self.shortest_step(),
        };
        rrt_connect::rrt_connect(space, root, target, &options, random)
    }

    fn shortest_step(&self) -> f64 {
        SHORTEST_STEP * self.model.body().radius
    }

    /// Way-points that the robot follows in its own manner, the root included.
    fn drive<const D: usize>(
        &self,
        space: &FreeSpace<D>,
        root: &Vector<D>,
        target: &Vector<D>,
    ) -> Option<Vec<Vector<D>>> {
        let mut random = self.random();
        // Where a point finds no way a body finds none, and the point is much sooner done.
        self.connect(space, root, target, &mut random)?;
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
        let mut path = rrt::rrt(space, &driving, start, target, &options, &mut random)?;
        driving.leave_out(&state, &mut path);
        Some(path)
    }

    /// The body with its margin: the one asked for, or half of the room that the target leaves. A
    /// target that is not free leaves as much as its vicinity reaches beyond the nearest free point.
    fn mover(&self) -> Mover {
        let body = self.model.body();
        let gap = Mover::gap(body, self.target, &self.request.unsafe_set, self.robots);
        let room = if gap > 0.0 {
            gap
        } else {
            gap + self.request.vicinity
        };
        let margin = (0.5 * room).clamp(0.0, self.options.margin_radii * body.radius);
        Mover { body, margin }
    }
}
