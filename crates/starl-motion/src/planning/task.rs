//! Answering a request: from the world of robots to the planners' space and back.

use super::driving::{self, Driving};
use super::free_space::FreeSpace;
use super::grow::{Mover, Yields};
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

/// How many margins are tried at most, each half of the one before but no less than the least. Every
/// search but the last may use half of the nodes that are left.
const MARGINS: u32 = 4;

/// A request with its context.
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
    /// Its goal, in the same form.
    pub target: Point,
}

impl Task<'_> {
    /// The waypoints, or none; in two coordinates on the floor, three in the air.
    pub fn solve<const D: usize>(&self) -> Option<Path> {
        let mut mover = Mover {
            body: self.model.body(),
            margin: self.options.margin_radii * self.model.body().radius,
            least: self.options.least_margin,
            yields: Yields::NearEnds,
        };
        let mut left = self.request.most_nodes;
        for turn in 1.. {
            let next = self.next::<D>(mover, turn);
            let nodes = if next.is_some() { left / 2 } else { left };
            left -= nodes;
            if let Some(path) = self.solve_with::<D>(mover, nodes) {
                return Some(path);
            }
            mover = next?;
        }
        None
    }

    /// The next attempt if there is no path with this margin: half the margin, down to the least. For a
    /// robot that is in a narrower place, or whose target is, it is the margin there.
    fn next<const D: usize>(&self, mover: Mover, turn: u32) -> Option<Mover> {
        let least = self.options.least_margin;
        if turn < MARGINS && mover.margin > least {
            let margin = (0.5 * mover.margin).max(least);
            return Some(Mover { margin, ..mover });
        }
        let narrow = Mover {
            yields: Yields::Along,
            ..mover
        };
        let ends = [Some(self.from), self.end::<D>(mover)];
        let has_less = |at: Point| {
            let room = mover.room(at, &self.request.unsafe_set, self.robots);
            0.0 < room && room < least.min(mover.margin)
        };
        let is_narrow = ends.into_iter().flatten().any(has_less);
        (mover.yields == Yields::NearEnds && is_narrow).then_some(narrow)
    }

    /// A path for this body and margin, found with so many nodes.
    fn solve_with<const D: usize>(&self, mover: Mover, nodes: u32) -> Option<Path> {
        let end = self.end::<D>(mover)?;
        let grown = mover.grow::<D>(&self.request.unsafe_set, self.robots, &[self.from, end]);
        let (from, target) = (Mover::to_space(self.from), Mover::to_space(end));
        let drives = self.planner() == Planner::Rrt;
        if !drives && grown.is_clear(&from, &target) {
            return Some(alloc::vec![end]);
        }
        let space = mover.space::<D>(self.from, end, grown);
        let root = match space.is_free(&from) {
            true => from,
            false => escape::escape(&space, &from, self.longest_escape())?,
        };
        let found = match drives {
            true => self.drive(&space, &root, &target, nodes)?,
            false => self.search(&space, &root, &target, nodes)?,
        };
        // The root is the first waypoint only where it is not where the robot is.
        let path = found.iter().skip(usize::from(root == from));
        Some(path.map(Mover::to_world).collect())
    }

    /// Metres.
    fn longest_escape(&self) -> f64 {
        self.options.escape_radii * self.model.body().radius
    }

    /// Where the path ends: at the target if the body can be there, otherwise at the nearest place
    /// where it has the margin or half of the room that the vicinity leaves beyond contact.
    fn end<const D: usize>(&self, mover: Mover) -> Option<Point> {
        let request = self.request;
        let room = mover.room(self.target, &request.unsafe_set, self.robots);
        if room > 0.0 {
            return Some(self.target);
        }
        let left = 0.5 * (room + request.vicinity);
        if left.is_nan() || left <= 0.0 {
            return None;
        }
        let margin = if left < mover.margin {
            left
        } else {
            mover.margin
        };
        let mover = Mover { margin, ..mover };
        let grown = mover.grow::<D>(&request.unsafe_set, self.robots, &[]);
        let space = mover.space::<D>(self.from, self.target, grown);
        let target = Mover::to_space(self.target);
        let end = escape::nearest_free(&space, &target, request.vicinity)?;
        Some(Mover::to_world(&end))
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
        nodes: u32,
    ) -> Option<Vec<Vector<D>>> {
        let mut random = self.random();
        let mut path = self.connect(space, root, target, nodes, &mut random)?;
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

    /// A path of points. Searches begin where both ends have their margin: in a dent most of what a tree
    /// grows to is its rim, and no way from there.
    fn connect<const D: usize>(
        &self,
        space: &FreeSpace<D>,
        root: &Vector<D>,
        target: &Vector<D>,
        nodes: u32,
        random: &mut Random,
    ) -> Option<Vec<Vector<D>>> {
        let options = rrt_connect::Options {
            most_nodes: nodes,
            longest_step: f64::INFINITY,
            shortest_step: self.shortest_step(),
        };
        let (first, last) = (
            self.out_of_dent(space, root),
            self.out_of_dent(space, target),
        );
        let mut path = rrt_connect::rrt_connect(space, &first, &last, &options, random)?;
        if first != *root {
            path.insert(0, *root);
        }
        if last != *target {
            path.push(*target);
        }
        Some(path)
    }

    /// The nearest place with the margin straight away from everything that an end is too near to; the end itself
    /// if it has the margin, or if there is no such way.
    fn out_of_dent<const D: usize>(&self, space: &FreeSpace<D>, end: &Vector<D>) -> Vector<D> {
        let mut is_near = false;
        space.for_each_met(end, end, |_, _, _| is_near = true);
        is_near
            .then(|| escape::escape(space, end, self.longest_escape()))
            .flatten()
            .filter(|out| space.sees(end, out))
            .unwrap_or(*end)
    }

    fn shortest_step(&self) -> f64 {
        SHORTEST_STEP * self.model.body().radius
    }

    /// Waypoints that the robot follows in its own manner, the root included.
    fn drive<const D: usize>(
        &self,
        space: &FreeSpace<D>,
        root: &Vector<D>,
        target: &Vector<D>,
        nodes: u32,
    ) -> Option<Vec<Vector<D>>> {
        let mut random = self.random();
        // Where a point finds no way a body finds none, and the point is much sooner done.
        self.connect(space, root, target, nodes, &mut random)?;
        let driving = Driving::new(self.model, space, nodes);
        let mut pose = Pose {
            position: self.from,
            ..self.start.pose
        };
        if *root != Mover::to_space(self.from) {
            // The robot is taken to stand at the first waypoint, as it came there.
            let turned = driving.force(&self.model.at_rest(pose), root).pose;
            pose = Pose {
                position: Mover::to_world(root),
                ..turned
            };
        }
        let state = self.model.at_rest(pose);
        let options = rrt::Options {
            most_nodes: nodes,
            threshold: driving::SHORTEST_DRIVE,
        };
        let start = (root, state);
        let mut path = rrt::rrt(space, &driving, start, target, &options, &mut random)?;
        driving.leave_out(&state, &mut path);
        Some(path)
    }
}
