//! Standing at the goal without hunting the noise of the positioning system.
//!
//! A robot that has stopped at its goal leaves it again only when the mean of the estimates since
//! then says that it stands off. The mean of n estimates has 1/sqrt(n) of one estimate's deviation,
//! so noise soon cannot move a standing robot while a real push still does.

use super::{Goal, Tracking};
use starl_core::Point;

/// The estimates since the robot came to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rest {
    target: Point,
    /// Mean of the positions estimated since, metres.
    mean: Point,
    samples: u32,
}

/// Distances to the goal in the floor plane at which a robot stops and starts, metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tolerance {
    /// It stops when it is this near.
    pub stop: f64,
    /// It starts again when it is farther away than this.
    pub start: f64,
}

/// A target that moves less than this is the same one, metres.
const SAME_TARGET: f64 = 0.005;

/// The mean forgets so slowly, estimates.
const MOST_SAMPLES: u32 = 20;

/// Whether a robot estimated at `position` is at rest at its goal, or should stop there now.
pub(super) fn at_rest(
    tracking: &mut Tracking,
    goal: &Goal,
    position: Point,
    tolerance: Tolerance,
) -> bool {
    let rest = match tracking.rest {
        Some(rest) if rest.target.planar_distance(goal.target) < SAME_TARGET => {
            let samples = (rest.samples + 1).min(MOST_SAMPLES);
            let mean = rest.mean + (position - rest.mean) / f64::from(samples);
            // A few estimates are too few to judge by.
            let away = mean.planar_distance(goal.target) > tolerance.start;
            (!away).then_some(Rest {
                samples,
                mean,
                ..rest
            })
        }
        _ => {
            let near = position.planar_distance(goal.target) <= tolerance.stop;
            near.then_some(Rest {
                target: goal.target,
                mean: goal.target,
                samples: 3,
            })
        }
    };
    tracking.rest = rest;
    rest.is_some()
}
