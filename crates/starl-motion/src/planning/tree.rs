//! A tree of places, rooted at the first.

use super::nearest::Nearest;
use super::vector::Vector;
use alloc::vec::Vec;

/// Places and the one each was reached from. The root is number zero and its own parent.
#[derive(Clone, Debug)]
pub struct Tree<const D: usize> {
    points: Vec<Vector<D>>,
    parents: Vec<u32>,
    nearest: Nearest<D>,
}

impl<const D: usize> Tree<D> {
    /// The tree of a root alone.
    pub fn new(root: Vector<D>) -> Self {
        let mut tree = Tree {
            points: Vec::with_capacity(64),
            parents: Vec::with_capacity(64),
            nearest: Nearest::new(),
        };
        tree.add(root, 0);
        tree
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
    pub fn point(&self, number: u32) -> &Vector<D> {
        &self.points[number as usize]
    }

    /// Adds a place reached from `parent`; answers its number.
    pub fn add(&mut self, point: Vector<D>, parent: u32) -> u32 {
        self.nearest.add(&point);
        self.points.push(point);
        self.parents.push(parent);
        (self.points.len() - 1) as u32
    }

    /// The number of the place nearest to `point`.
    pub fn nearest(&self, point: &Vector<D>) -> u32 {
        self.nearest.nearest(point)
    }

    /// The places from this one back to the root, both included.
    pub fn to_root(&self, number: u32) -> impl Iterator<Item = Vector<D>> + '_ {
        let mut next = Some(number);
        core::iter::from_fn(move || {
            let number = next?;
            let parent = self.parents[number as usize];
            next = (parent != number).then_some(parent);
            Some(self.points[number as usize])
        })
    }
}
