//! A segment against boxes: where it enters and leaves, by slabs (Kay and Kajiya 1986, "Ray tracing
//! complex scenes").
//!
//! Fractions are of the segment's length. A segment of length 0 is a point, and one that runs along a
//! face touches the box.

use super::vector::{Vector, difference};

/// A segment, prepared for clipping.
#[derive(Clone, Copy, Debug)]
pub struct Ray<const D: usize> {
    /// Where it starts, metres.
    pub from: Vector<D>,
    /// From the start to the end, metres.
    pub way: Vector<D>,
    pub(super) inverse: Vector<D>,
    /// Added to when the segment leaves a slab it runs along, so that it counts as in the slab to the
    /// end even in its farther face; zero on axes along which it moves.
    pub(super) slack: Vector<D>,
}

impl<const D: usize> Ray<D> {
    /// The segment from `from` to `to`.
    #[inline]
    pub fn new(from: &Vector<D>, to: &Vector<D>) -> Self {
        let way = difference(from, to);
        // A way of zero along an axis becomes one too short to matter, which spares the clipping an
        // undefined product of zero and infinity.
        let inverse = way.map(|way| if way == 0.0 { 1e300 } else { 1.0 / way });
        let slack = way.map(|way| if way == 0.0 { 2.0 } else { 0.0 });
        Ray {
            from: *from,
            way,
            inverse,
            slack,
        }
    }

    /// When the segment passes the nearer of two planes across an axis, as a fraction of its length.
    #[inline]
    pub fn enters(&self, axis: usize, low: f64, high: f64) -> f64 {
        let near = if self.inverse[axis] > 0.0 { low } else { high };
        (near - self.from[axis]) * self.inverse[axis]
    }

    /// The part of the segment up to the fraction `limit` that is in the box, as fractions.
    #[inline]
    pub fn clip(&self, low: &Vector<D>, high: &Vector<D>, limit: f64) -> Option<(f64, f64)> {
        let (mut enter, mut leave) = (0.0, limit);
        for axis in 0..D {
            let inverse = self.inverse[axis];
            let (near, far) = if inverse > 0.0 {
                (low[axis], high[axis])
            } else {
                (high[axis], low[axis])
            };
            let near = (near - self.from[axis]) * inverse;
            let far = (far - self.from[axis]) * inverse + self.slack[axis];
            enter = if near > enter { near } else { enter };
            leave = if far < leave { far } else { leave };
        }
        (enter <= leave).then_some((enter, leave))
    }
}
