//! Dents in grown obstacles: where the margin yields to the ends of a path.
//!
//! An obstacle is grown by the body and a margin. Where a path starts or ends within that margin the
//! obstacle is dented: in a ball about that end only a lesser growth counts, half of the gap that there
//! is at the end. So paths keep all of the margin except near an end that has less, never touch, and
//! what is free still follows exactly from where a segment enters and leaves convex things.

use super::ray::Ray;
use super::vector::{Vector, difference, dot};
use starl_core::math;

/// A ball in which a lesser growth of an obstacle counts.
#[derive(Clone, Copy, Debug)]
pub struct Dent<const D: usize, T> {
    /// The end of a path, metres.
    pub center: Vector<D>,
    /// Metres.
    pub radius: f64,
    /// The obstacle as it counts in the ball.
    pub inner: T,
}

impl<const D: usize, T> Dent<D, T> {
    /// The part of the line through the segment that is in the ball, as fractions of the segment's
    /// length; the first is greater if there is none.
    fn ball(&self, ray: &Ray<D>) -> (f64, f64) {
        let offset = difference(&self.center, &ray.from);
        let rest = dot(&offset, &offset) - self.radius * self.radius;
        let squared = dot(&ray.way, &ray.way);
        if squared == 0.0 {
            return if rest < 0.0 {
                (0.0, f64::INFINITY)
            } else {
                (1.0, 0.0)
            };
        }
        let half = dot(&offset, &ray.way);
        let discriminant = half * half - squared * rest;
        if discriminant < 0.0 {
            return (1.0, 0.0);
        }
        let root = math::sqrt(discriminant);
        ((-half - root) / squared, (root - half) / squared)
    }
}

/// Where the segment is first in the dented obstacle, if it is in the undented one from `enter` to
/// `leave`. `meets` says where it is in a lesser growth. All are fractions of the segment's length.
pub fn first_met<const D: usize, T>(
    dents: &[Dent<D, T>],
    ray: &Ray<D>,
    (enter, leave): (f64, f64),
    meets: impl Fn(&T) -> Option<(f64, f64)>,
) -> Option<f64> {
    let mut at = enter;
    // From ball to ball: it never returns to a ball that it has left.
    loop {
        let inside = |dent: &&Dent<D, T>| {
            let (from, to) = dent.ball(ray);
            from <= at && at < to
        };
        let Some(dent) = dents.iter().find(inside) else {
            return Some(at);
        };
        let (_, out) = dent.ball(ray);
        if let Some((enter, leave)) = meets(&dent.inner)
            && leave >= at
            && enter <= out
        {
            return Some(if enter > at { enter } else { at });
        }
        at = out;
        if at > leave {
            return None;
        }
    }
}
