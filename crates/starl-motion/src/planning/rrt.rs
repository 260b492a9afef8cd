//! RRT: a tree grown from the start towards random places (LaValle 1998, "Rapidly-exploring random trees: a new tool
//! for path planning"), in the form of the thesis, section 3.2.2.
//!
//! A random place is tried from the nearest node, on the path that the robot itself would drive ([`Steering`]). If that
//! touches an obstacle, the place halfway to the node is tried instead, until the rest is shorter than a threshold.
//! After every new node the target is tried in the same way. The search gives up when the tree has a given number of
//! nodes.
//!
//! Where we differ: the target is not tried again from a node that it has been tried from, since the
//! outcome would be the same; and it is tried from the new node, too, if that is not the one nearest
//! to it. The nearest may be one from which a robot with a turning circle, or one that has to come
//! from a given side, never gets there.

use super::space::Space;
use super::tree::Tree;
use super::vector::{Vector, between, distance};
use alloc::vec::Vec;
use starl_core::Random;

/// How to get from one place to another.
pub trait Steering<const D: usize> {
    /// The state from which the robot's further motion follows.
    type State;

    /// The state in which the robot arrives if, at the waypoint `from` in this state, it sets out for
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

/// Waypoints from `start`, itself included, to `target`; `state` is that of the robot at `start`.
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
    let mut newest = 0;
    loop {
        if let Some(reached) = search.try_target(target, newest) {
            let mut path: Vec<Vector<D>> = search.tree.to_root(reached).collect();
            path.reverse();
            return Some(path);
        }
        if search.tree.len() >= options.most_nodes as usize {
            return None;
        }
        newest = loop {
            if let Some(added) = search.try_place(&space.sample(random)) {
                break added;
            }
            futile += 1;
            if futile >= options.most_nodes {
                return None;
            }
        };
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
            if let Some(added) = self.go(from, &place) {
                return Some(added);
            }
            place = between(&at, &place, 0.5);
        }
        None
    }

    /// Goes all the way to a place; the new node there.
    fn go(&mut self, from: u32, place: &Vector<D>) -> Option<u32> {
        let state = &self.states[from as usize];
        let state = self.steering.go(self.tree.point(from), state, place)?;
        self.states.push(state);
        self.tried_target.push(false);
        Some(self.tree.add(*place, from))
    }

    /// Goes towards the target for as long as that leads to new nodes, then from the newest node;
    /// the target's node if it is reached.
    fn try_target(&mut self, target: &Vector<D>, newest: u32) -> Option<u32> {
        loop {
            let from = self.tree.nearest(target);
            if self.has_tried(from) {
                break;
            }
            // From nearer than the threshold only the target itself is worth trying.
            let added = match distance(self.tree.point(from), target) < self.threshold {
                true => self.go(from, target),
                false => self.try_from(from, target),
            };
            match added {
                Some(added) if self.tree.point(added) == target => return Some(added),
                Some(_) => {}
                None => break,
            }
        }
        match self.has_tried(newest) {
            true => None,
            false => self.go(newest, target),
        }
    }

    /// Whether the target has been tried from this node; from now on it has.
    fn has_tried(&mut self, node: u32) -> bool {
        core::mem::replace(&mut self.tried_target[node as usize], true)
    }
}

/// A point that moves along straight free segments.
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
