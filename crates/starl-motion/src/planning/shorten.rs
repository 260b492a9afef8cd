//! Shortening a path without touching anything: corners are cut until the path is taut.
//!
//! First every corner that can be left out is (the farthest later corner in sight is gone to
//! straight away). Then each remaining corner slides along the edge after it, and then along the edge
//! before it, as far as its neighbour still sees it; by the triangle inequality that never makes the
//! path longer. Rounds are repeated until they gain little. Deterministic: no random shortcuts
//! (compare Geraerts and Overmars 2007, "Creating high-quality paths for motion planning").

use super::space::Space;
use super::vector::{Vector, between, length};
use alloc::vec::Vec;

/// Halvings of an edge to find how far along it a corner may slide.
const HALVINGS: u32 = 6;

/// A path with the same ends as `path`, free if that is, not longer, of at least its ends. At most
/// `rounds` of sliding; fewer if a round gains less than a hundredth.
pub fn shorten<const D: usize>(space: &impl Space<D>, path: &mut Vec<Vector<D>>, rounds: u32) {
    leave_out(space, path);
    let mut before = length(path);
    for _ in 0..rounds {
        if path.len() < 3 {
            return;
        }
        slide(space, path);
        path.reverse();
        slide(space, path);
        path.reverse();
        leave_out(space, path);
        let after = length(path);
        if after > before * 0.99 {
            return;
        }
        before = after;
    }
}

/// Goes from each corner kept straight to the farthest later one in sight.
fn leave_out<const D: usize>(space: &impl Space<D>, path: &mut Vec<Vector<D>>) {
    let mut kept = 0;
    let mut next = 1;
    while next < path.len() {
        let from = path[kept];
        let farthest = (next + 1..path.len())
            .rev()
            .find(|&later| space.sees(&from, &path[later]));
        next = farthest.unwrap_or(next);
        kept += 1;
        path[kept] = path[next];
        next += 1;
    }
    path.truncate(kept + 1);
}

/// Slides every corner towards the next as far as the one before it sees.
fn slide<const D: usize>(space: &impl Space<D>, path: &mut [Vector<D>]) {
    for corner in 1..path.len().saturating_sub(1) {
        let (before, at, after) = (path[corner - 1], path[corner], path[corner + 1]);
        let (mut seen, mut step) = (0.0, 0.5);
        for _ in 0..HALVINGS {
            if space.sees(&before, &between(&at, &after, seen + step)) {
                seen += step;
            }
            step *= 0.5;
        }
        path[corner] = between(&at, &after, seen);
    }
}
