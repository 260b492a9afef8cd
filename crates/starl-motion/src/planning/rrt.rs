//! RRT: a tree grown from the start by trying to go to random places (LaValle 1998, "Rapidly-exploring
//! random trees: a new tool for path planning"), in the form of the thesis, section 3.2.2.
//!
//! A random place is tried from the nearest node, by whatever way the robot itself would take there
//! ([`Steering`]). If that touches something, the place halfway to the node is tried instead, until
//! the rest is shorter than a threshold. After every new node the target is tried in the same manner.
//! The search gives up when the tree has a given number of nodes.
//!
//! Where we differ: the target is not tried again from a node that it has been tried from, since the
//! outcome would be the same.

use super::space::Space;
use super::tree::Tree;
use super::vector::{Vector, between, distance};
use alloc::vec::Vec;
use starl_core::Random;

/// How to get from one place to another.
pub trait Steering<const D: usize> {
    /// All that decides how the robot goes on from where it is.
    type State;

    /// The state in which the robot arrives if, at the way-point `from` in this state, it sets out for
    /// another; none if something is in the way or it does not arrive.
    fn go(&self, from: &Vector<D>, state: &Self::State, to: &Vector<D>) -> Option<Self::State>;
}

/// How to search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Gives up when the tree has this many nodes, or after as many places that led nowhere.
    pub most_nodes: u32,
    /// Nearer places are not worth a node, metres.
    pub threshold: f64,
}

/// Way-points from `start`, itself included, to `target`; `state` is that of the robot at `start`.
pub fn rrt<const D: usize, S: Steering<D>>(
    space: &impl Space<D>,
    steering: &S,
    (start, state): (&Vector<D>, S::State),
    target: &Vector<D>,
    options: &Options,
    random: &mut Random,
) -> Option<Vec<Vector<D>>> {
    let mut search = Search {
        steering,
        tree: Tree::new(*start),
        states: alloc::vec![state],
        tried_target: alloc::vec![false],
        threshold: options.threshold,
    };
    let mut futile = 0;
    loop {
        if let Some(path) = search.try_target(target) {
            return Some(path);
        }
        while search.try_place(&space.sample(random)).is_none() {
            futile += 1;
            if futile >= options.most_nodes {
                return None;
            }
        }
        if search.tree.len() >= options.most_nodes as usize {
            return None;
        }
    }
}

struct Search<'a, const D: usize, S: Steering<D>> {
    steering: &'a S,
    tree: Tree<D>,
    /// The robot's state at each node.
    states: Vec<S::State>,
    tried_target: Vec<bool>,
    threshold: f64,
}

impl<const D: usize, S: Steering<D>> Search<'_, D, S> {
    /// Goes towards a place from the nearest node; the new node.
    fn try_place(&mut self, place: &Vector<D>) -> Option<u32> {
        let from = self.tree.nearest(place);
        self.try_from(from, place)
    }

    fn try_from(&mut self, from: u32, place: &Vector<D>) -> Option<u32> {
        let at = *self.tree.point(from);
        let mut place = *place;
        while distance(&at, &place) >= self.threshold {
            if let Some(state) = self.steering.go(&at, &self.states[from as usize], &place) {
                return Some(self.add(&place, from, state));
            }
            place = between(&at, &place, 0.5);
        }
        None
    }

    fn add(&mut self, place: &Vector<D>, from: u32, state: S::State) -> u32 {
        self.states.push(state);
        self.tried_target.push(false);
        self.tree.add(*place, from)
    }

    /// Goes towards the target for as long as that leads to new nodes; the path if it is reached.
    fn try_target(&mut self, target: &Vector<D>) -> Option<Vec<Vector<D>>> {
        loop {
            let from = self.tree.nearest(target);
            if core::mem::replace(&mut self.tried_target[from as usize], true) {
                return None;
            }
            let at = *self.tree.point(from);
            // From nearer than the threshold only the target itself is worth trying.
            let added = match distance(&at, target) < self.threshold {
                true => {
                    let state = self.steering.go(&at, &self.states[from as usize], target)?;
                    self.add(target, from, state)
                }
                false => self.try_from(from, target)?,
            };
            if self.tree.point(added) == target {
                let mut path: Vec<Vector<D>> = self.tree.to_root(added).collect();
                path.reverse();
                return Some(path);
            }
        }
    }
}

/// A point that goes straight to wherever the way is free.
#[derive(Clone, Copy, Debug)]
pub struct Straight<'a, T> {
    /// Where it moves.
    pub space: &'a T,
}

impl<const D: usize, T: Space<D>> Steering<D> for Straight<'_, T> {
    type State = ();

    fn go(&self, from: &Vector<D>, _: &(), to: &Vector<D>) -> Option<()> {
        self.space.sees(from, to).then_some(())
    }
}
