//! RRT*: a tree whose paths become as short as can be as it grows (Karaman and Frazzoli 2011,
//! "Sampling-based algorithms for optimal motion planning").
//!
//! A new node hangs on the neighbour that gives it the shortest path from the start, and neighbours
//! that are reached sooner through it are hung on it. Once a path is known only places that could be
//! on a shorter one are drawn, which is the inside of an ellipsoid about start and target (Gammell,
//! Srinivasa and Barfoot 2014, "Informed RRT*").
//!
//! Where we differ: the tree may begin with a path that is already known; edges are as long as the way
//! is free rather than a fixed step; every new node that would make the path shorter tries the target,
//! near or not.

use super::cost_tree::CostTree;
use super::ellipsoid::Ellipsoid;
use super::space::Space;
use super::vector::{Vector, between, distance};
use alloc::vec::Vec;
use starl_core::{Random, math};

/// How to search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Ends when the tree has this many nodes, or after ten times as many samples.
    pub most_nodes: u32,
    /// Ends as soon as a path is not longer than this, metres: infinite for any path at all, zero for
    /// the best that `most_nodes` buy.
    pub long_enough: f64,
    /// Shorter edges are not worth a node, metres.
    pub shortest_step: f64,
}

/// The shortest path found from `start` to `target`, both included. `known` is one found before, or
/// empty.
pub fn rrt_star<const D: usize>(
    space: &impl Space<D>,
    start: &Vector<D>,
    target: &Vector<D>,
    known: &[Vector<D>],
    options: &Options,
    random: &mut Random,
) -> Option<Vec<Vector<D>>> {
    if space.sees(start, target) {
        return Some(alloc::vec![*start, *target]);
    }
    let mut search = Search::new(space, start, target, known);
    let least = distance(start, target) * (1.0 + 1e-9);
    let most_samples = options.most_nodes.saturating_mul(10);
    for _ in 0..most_samples {
        let best = search.best();
        if best <= least
            || best <= options.long_enough && best.is_finite()
            || search.tree.len() >= options.most_nodes as usize
        {
            break;
        }
        let place = search.draw(best, random);
        search.grow(&place, options.shortest_step);
    }
    search.tree.path_to(search.target_node?)
}

struct Search<'a, const D: usize, T> {
    space: &'a T,
    start: Vector<D>,
    target: Vector<D>,
    tree: CostTree<D>,
    target_node: Option<u32>,
    /// Filled and emptied in every step: neighbours of the place, their distance and what the path to
    /// the place through them would be, metres.
    neighbours: Vec<(f64, f64, u32)>,
}

impl<'a, const D: usize, T: Space<D>> Search<'a, D, T> {
    fn new(
        space: &'a T,
        start: &Vector<D>,
        target: &Vector<D>,
        known: &[Vector<D>],
    ) -> Search<'a, D, T> {
        let mut tree = CostTree::new(*start);
        let mut last = 0;
        for place in known.iter().skip(1) {
            last = tree.add(*place, last);
        }
        let target_node = (last > 0).then_some(last);
        let neighbours = Vec::new();
        Search {
            space,
            start: *start,
            target: *target,
            tree,
            target_node,
            neighbours,
        }
    }

    /// Length of the best path, infinite if there is none.
    fn best(&self) -> f64 {
        self.target_node
            .map_or(f64::INFINITY, |node| self.tree.cost(node))
    }

    /// A place that could be on a path shorter than the best.
    fn draw(&self, best: f64, random: &mut Random) -> Vector<D> {
        let through =
            |place: &Vector<D>| distance(&self.start, place) + distance(place, &self.target);
        if best.is_finite() && random.bits() & 1 == 0 {
            return Ellipsoid::new(&self.start, &self.target, best).sample(random);
        }
        let mut place = self.space.sample(random);
        for _ in 0..8 {
            if through(&place) < best {
                break;
            }
            place = self.space.sample(random);
        }
        place
    }

    /// The radius in which a new node has neighbours, with the least constant for which paths are
    /// proved to become shortest (Karaman and Frazzoli, theorem 38), metres.
    fn radius(&self, best: f64) -> f64 {
        let dimension = D as f64;
        let all = self.space.volume();
        let volume = match best.is_finite() {
            true => Ellipsoid::new(&self.start, &self.target, best)
                .volume()
                .min(all),
            false => all,
        };
        let ball = if D == 2 {
            math::PI
        } else {
            4.0 / 3.0 * math::PI
        };
        let count = self.tree.len() as f64 + 1.0;
        let root = |value: f64| {
            if D == 2 {
                math::sqrt(value)
            } else {
                math::pow(value, 1.0 / dimension)
            }
        };
        let gamma = 2.0 * root((1.0 + 1.0 / dimension) * volume / ball);
        gamma * root(math::log(count) / count)
    }

    /// Grows the tree towards a place.
    fn grow(&mut self, place: &Vector<D>, shortest: f64) {
        let best = self.best();
        let nearest = self.tree.nearest(place);
        let from = *self.tree.point(nearest);
        let reach = self.space.reach(&from, place);
        let place = if reach.free >= 1.0 {
            *place
        } else {
            between(&from, place, reach.free)
        };
        let step = distance(&from, &place);
        let ahead = distance(&place, &self.target);
        if step < shortest || distance(&self.start, &place) + ahead >= best {
            return;
        }
        self.find_neighbours(&place, best);
        let cost = self.tree.cost(nearest) + step;
        let parent = self
            .neighbours
            .iter()
            .find(|&&(through, _, node)| {
                through < cost && self.space.sees(self.tree.point(node), &place)
            })
            .map_or(nearest, |&(_, _, node)| node);
        let added = self.tree.add(place, parent);
        if self.tree.cost(added) + ahead >= best {
            return;
        }
        self.rewire(added);
        self.try_target(added, ahead);
    }

    /// The nodes near a place, the one that promises the shortest path first.
    fn find_neighbours(&mut self, place: &Vector<D>, best: f64) {
        let radius = self.radius(best);
        self.neighbours.clear();
        let (tree, found) = (&self.tree, &mut self.neighbours);
        tree.for_each_within(place, radius, &mut |node, squared| {
            let way = math::sqrt(squared);
            found.push((tree.cost(node) + way, way, node));
        });
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
    }

    /// Hangs those neighbours on a node that are reached sooner through it.
    fn rewire(&mut self, through: u32) {
        let at = *self.tree.point(through);
        for index in 0..self.neighbours.len() {
            let (_, way, node) = self.neighbours[index];
            let cost = self.tree.cost(through) + way;
            if cost < self.tree.cost(node) && self.space.sees(&at, self.tree.point(node)) {
                self.tree.hang(node, through);
            }
        }
    }

    fn try_target(&mut self, from: u32, way: f64) {
        if self.tree.cost(from) + way >= self.best()
            || !self.space.sees(self.tree.point(from), &self.target)
        {
            return;
        }
        match self.target_node {
            Some(node) => self.tree.hang(node, from),
            None => self.target_node = Some(self.tree.add(self.target, from)),
        }
    }
}
