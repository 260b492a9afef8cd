//! A tree of places that knows the length of the path to each and can be rewired.

use super::nearest::Nearest;
use super::vector::{Vector, distance};
use alloc::vec::Vec;

/// No node.
const NONE: u32 = u32::MAX;

/// Places and the length of the path along which each is reached from the root, node zero.
///
/// Invariant: a node's cost is its parent's and the distance between them; children of a node form
/// a list linked both ways.
#[derive(Clone, Debug)]
pub struct CostTree<const D: usize> {
    points: Vec<Vector<D>>,
    links: Vec<Links>,
    costs: Vec<f64>,
    nearest: Nearest<D>,
    /// Emptied after use: nodes whose costs must be recomputed.
    waiting: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Links {
    parent: u32,
    first_child: u32,
    next: u32,
    previous: u32,
}

impl<const D: usize> CostTree<D> {
    /// The tree of a root alone.
    pub fn new(root: Vector<D>) -> Self {
        let mut tree = CostTree {
            points: Vec::new(),
            links: Vec::new(),
            costs: Vec::new(),
            nearest: Nearest::new(),
            waiting: Vec::new(),
        };
        tree.push(root, NONE, 0.0);
        tree
    }

    fn push(&mut self, point: Vector<D>, parent: u32, cost: f64) -> u32 {
        self.nearest.add(&point);
        self.points.push(point);
        self.costs.push(cost);
        self.links.push(Links {
            parent,
            first_child: NONE,
            next: NONE,
            previous: NONE,
        });
        (self.points.len() - 1) as u32
    }

    /// Adds a place reached from `parent`; answers its number.
    pub fn add(&mut self, point: Vector<D>, parent: u32) -> u32 {
        let cost = self.cost(parent) + distance(self.point(parent), &point);
        let node = self.push(point, parent, cost);
        self.link(node, parent);
        node
    }

    /// How many places there are.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Never: there is a root.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// The place with this number.
    pub fn point(&self, node: u32) -> &Vector<D> {
        &self.points[node as usize]
    }

    /// Length of the path to it, metres.
    pub fn cost(&self, node: u32) -> f64 {
        self.costs[node as usize]
    }

    /// The number of the place nearest to `point`.
    pub fn nearest(&self, point: &Vector<D>) -> u32 {
        self.nearest.nearest(point)
    }

    /// Calls `visit` with the number and squared distance of every place nearer than `radius` metres.
    pub fn for_each_within(
        &self,
        point: &Vector<D>,
        radius: f64,
        visit: &mut impl FnMut(u32, f64),
    ) {
        self.nearest.for_each_within(point, radius, visit);
    }

    /// Hangs a node, and all that hangs on it, on another one. The other must not be below it, which
    /// is so if the node's path becomes shorter by it.
    pub fn hang(&mut self, node: u32, parent: u32) {
        let Links {
            parent: before,
            next,
            previous,
            ..
        } = self.links[node as usize];
        if before != NONE {
            match previous {
                NONE => self.links[before as usize].first_child = next,
                previous => self.links[previous as usize].next = next,
            }
            if next != NONE {
                self.links[next as usize].previous = previous;
            }
        }
        self.link(node, parent);
        self.waiting.push(node);
        while let Some(node) = self.waiting.pop() {
            let parent = self.links[node as usize].parent;
            self.costs[node as usize] =
                self.cost(parent) + distance(self.point(parent), self.point(node));
            let mut child = self.links[node as usize].first_child;
            while child != NONE {
                self.waiting.push(child);
                child = self.links[child as usize].next;
            }
        }
    }

    fn link(&mut self, node: u32, parent: u32) {
        let next = core::mem::replace(&mut self.links[parent as usize].first_child, node);
        if next != NONE {
            self.links[next as usize].previous = node;
        }
        let links = &mut self.links[node as usize];
        (links.parent, links.next, links.previous) = (parent, next, NONE);
    }

    /// The places from the root to this one, both included.
    pub fn path_to(&self, mut node: u32) -> Option<Vec<Vector<D>>> {
        let mut path = Vec::new();
        while node != NONE {
            path.push(*self.points.get(node as usize)?);
            node = self.links[node as usize].parent;
        }
        path.reverse();
        Some(path)
    }
}
