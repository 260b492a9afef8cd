//! A planner's interface to the world.

use super::vector::Vector;
use starl_core::Random;

/// A region in which a point moves among obstacles. Planners use only this interface.
pub trait Space<const D: usize> {
    /// A point to grow towards, drawn so that every free place has its chance.
    fn sample(&self, random: &mut Random) -> Vector<D>;

    /// How far one can go from `a` straight towards `b`.
    fn reach(&self, a: &Vector<D>, b: &Vector<D>) -> Reach<D>;

    /// Whether the whole segment is free; quicker to say than how much of it is.
    fn sees(&self, a: &Vector<D>, b: &Vector<D>) -> bool;

    /// Area or volume of all of it, obstacles included, square or cubic metres.
    fn volume(&self) -> f64;

    /// Whether the point is free.
    fn is_free(&self, point: &Vector<D>) -> bool {
        self.sees(point, point)
    }
}

/// How far a straight way is free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach<const D: usize> {
    /// The part of the way that is free: one if all of it is, zero if its start is not.
    pub free: f64,
    /// The unit normal of the blocking surface; none if the way is free, or if sliding along the surface is impossible.
    pub wall: Option<Vector<D>>,
}

impl<const D: usize> Reach<D> {
    /// Nothing is in the way.
    pub const ALL: Reach<D> = Reach {
        free: 1.0,
        wall: None,
    };
    /// The start is not free.
    pub const NONE: Reach<D> = Reach {
        free: 0.0,
        wall: None,
    };
}
