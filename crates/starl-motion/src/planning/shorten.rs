//! Shortening a path without touching anything: corners are cut until the path is taut.
//!
//! First every corner that can be left out is (the farthest later corner in sight is tried
//! first). Then each remaining corner slides along the edge after it, and then along the edge
//! before it, as far as its neighbour still sees it; and where that gains something a corner becomes
//! two, by a cut straight across it as far off as is free. By the triangle inequality none of that
//! makes the path longer. Rounds are repeated until they gain little. Deterministic: no random
//! shortcuts (compare Geraerts and Overmars 2007, "Creating high-quality paths for motion planning").

use super::space::Space;
use super::vector::{Vector, between, distance, length};
use alloc::vec::Vec;

/// Halvings of an edge to find how far along it a corner may slide.
const HALVINGS: u32 = 6;

/// A round that gains less than this part of the path's length is the last.
const ROUND_GAIN: f64 = 0.01;

/// A cut that gains less than this part of the path's length is not worth another corner.
const CUT_GAIN: f64 = 0.04;

/// A path with the same ends as `path`, free if that is, not longer, of at least its ends. At most
/// `rounds` of sliding; fewer if a round gains too little.
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
        cut(space, path, CUT_GAIN * before);
        leave_out(space, path);
        let after = length(path);
        if after > before * (1.0 - ROUND_GAIN) {
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
        let seen = farthest(|part| space.sees(&before, &between(&at, &after, part)));
        path[corner] = between(&at, &after, seen);
    }
}

/// Cuts across every corner where that gains `least` metres, at equal parts of both edges.
fn cut<const D: usize>(space: &impl Space<D>, path: &mut Vec<Vector<D>>, least: f64) {
    let mut corner = 1;
    while corner + 1 < path.len() {
        let (before, at, after) = (path[corner - 1], path[corner], path[corner + 1]);
        let ends = |part| (between(&at, &before, part), between(&at, &after, part));
        let gain = |part: f64| {
            let (a, b) = ends(part);
            distance(&a, &at) + distance(&at, &b) - distance(&a, &b)
        };
        if gain(1.0) >= least {
            let free = farthest(|part| {
                let (a, b) = ends(part);
                space.sees(&a, &b)
            });
            if gain(free) >= least {
                let (a, b) = ends(free);
                path[corner] = a;
                path.insert(corner + 1, b);
                corner += 1;
            }
        }
        corner += 1;
    }
}

/// The greatest part up to which a way was found free, by halving.
fn farthest(is_free: impl Fn(f64) -> bool) -> f64 {
    let (mut seen, mut step) = (0.0, 0.5);
    for _ in 0..HALVINGS {
        if is_free(seen + step) {
            seen += step;
        }
        step *= 0.5;
    }
    seen
}
