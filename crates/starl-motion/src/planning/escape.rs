//! Where to go when one is already too near to something.

use super::free_space::FreeSpace;
use super::ray::Ray;
use super::space::Space;
use super::vector::{Vector, between};
use alloc::vec::Vec;
use starl_core::math;

/// Directions tried in the plane.
const DIRECTIONS: u32 = 48;

/// Halvings of the angle between two directions to find the best one.
const HALVINGS: u32 = 12;

/// The free point nearest to `point`, at most `within` metres away, itself if it is free. Exact if
/// one obstacle is in the way; where several overlap the distance found may be a little more than the
/// least.
pub fn nearest_free<const D: usize>(
    space: &FreeSpace<D>,
    point: &Vector<D>,
    within: f64,
) -> Option<Vector<D>> {
    if space.is_free(point) {
        return Some(*point);
    }
    nearest(space, point, within, &first_gap)
}

/// The nearest free point that can be reached from `point` by moving straight away from the obstacles that are too
/// near, without approaching any of them and without touching another; at most `within` metres away.
pub fn escape<const D: usize>(
    space: &FreeSpace<D>,
    point: &Vector<D>,
    within: f64,
) -> Option<Vector<D>> {
    nearest(space, point, within, &retreat)
}

/// How far from `point` towards `end` the way is good enough to stop at, as a fraction.
type Judge<const D: usize> = dyn Fn(&FreeSpace<D>, &Vector<D>, &Vector<D>) -> Option<f64>;

fn nearest<const D: usize>(
    space: &FreeSpace<D>,
    point: &Vector<D>,
    within: f64,
    judge: &Judge<D>,
) -> Option<Vector<D>> {
    if within.is_nan() || within <= 0.0 {
        return None;
    }
    let mut best: Option<(f64, Vector<D>)> = None;
    let mut attempt = |direction: Vector<D>| {
        let end = core::array::from_fn(|axis| point[axis] + within * direction[axis]);
        let fraction = judge(space, point, &end)? + CLEAR_OF;
        let found = between(point, &end, fraction);
        let better = best.is_none_or(|(least, _)| fraction < least);
        if fraction <= 1.0 && better && space.is_free(&found) {
            best = Some((fraction, found));
            return Some(());
        }
        None
    };
    let planar = |x: f64, y: f64| {
        let mut direction = [0.0; D];
        (direction[0], direction[1]) = (x, y);
        direction
    };
    for &number in &containing(space, point) {
        if let Some((_, [x, y])) = space.obstacles().gap(number, point) {
            attempt(planar(x, y));
        }
    }
    let mut step = math::TAU / f64::from(DIRECTIONS);
    let mut angle = 0.0;
    for turn in 0..DIRECTIONS {
        let (y, x) = math::sincos(f64::from(turn) * step);
        if attempt(planar(x, y)).is_some() {
            angle = f64::from(turn) * step;
        }
    }
    for _ in 0..HALVINGS {
        step *= 0.5;
        for candidate in [angle - step, angle + step] {
            let (y, x) = math::sincos(candidate);
            if attempt(planar(x, y)).is_some() {
                angle = candidate;
            }
        }
    }
    for axis in 2..D {
        for sign in [1.0, -1.0] {
            let mut direction = [0.0; D];
            direction[axis] = sign;
            attempt(direction);
        }
    }
    best.map(|(_, found)| found)
}

/// Beyond the boundary by this part of the distance looked at, whatever the rounding.
const CLEAR_OF: f64 = 1e-6;

fn containing<const D: usize>(space: &FreeSpace<D>, point: &Vector<D>) -> Vec<u32> {
    let mut found = Vec::new();
    space.for_each_met(point, point, |number, _, _| found.push(number));
    found.sort_unstable();
    found
}

/// Where the obstacles along the way first leave a gap.
fn first_gap<const D: usize>(
    space: &FreeSpace<D>,
    point: &Vector<D>,
    end: &Vector<D>,
) -> Option<f64> {
    let mut met = Vec::new();
    space.for_each_met(point, end, |_, enter, leave| met.push((enter, leave)));
    met.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let covered = |free: f64, &(enter, leave): &(f64, f64)| {
        if enter <= free + CLEAR_OF && leave > free {
            leave
        } else {
            free
        }
    };
    Some(met.iter().fold(0.0, covered))
}

/// Where one has left all that one was in, if that is possible by only ever moving away from it.
///
/// The distance to a convex shape is a convex function of the distance along a line: if it does not
/// shrink at first it never does.
fn retreat<const D: usize>(
    space: &FreeSpace<D>,
    point: &Vector<D>,
    end: &Vector<D>,
) -> Option<f64> {
    let way = Ray::new(point, end).way;
    let flat = way[0] == 0.0 && way[1] == 0.0;
    let mut left: f64 = 0.0;
    let mut allowed = true;
    let mut first_other = f64::INFINITY;
    space.for_each_met(point, end, |number, enter, leave| {
        if enter > 0.0 {
            first_other = if enter < first_other {
                enter
            } else {
                first_other
            };
            return;
        }
        left = if leave > left { leave } else { left };
        allowed &= flat
            || space
                .obstacles()
                .gap(number, point)
                .is_some_and(|(_, [x, y])| way[0] * x + way[1] * y >= -1e-9);
    });
    (allowed && left < first_other && left < 1.0).then_some(left)
}
