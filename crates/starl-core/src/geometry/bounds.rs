//! Boxes along the axes and vertical intervals.

use super::Point;
use super::segment::{greater, lesser};
use serde::{Deserialize, Serialize};

/// A vertical interval, both ends included.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeightSpan {
    /// Lower end, metres above the floor.
    pub low: f64,
    /// Upper end, metres above the floor.
    pub high: f64,
}

impl HeightSpan {
    /// The interval from `low` to `high`, metres above the floor.
    pub const fn new(low: f64, high: f64) -> HeightSpan {
        HeightSpan { low, high }
    }

    /// Whether the height lies in the interval, ends included.
    pub fn contains(self, z: f64) -> bool {
        self.low <= z && z <= self.high
    }

    /// Signed distance from a height to the ends, metres: negative inside.
    pub fn signed_distance(self, z: f64) -> f64 {
        greater(self.low - z, z - self.high)
    }

    /// Whether the ends are finite and in order.
    pub fn is_valid(self) -> bool {
        self.low.is_finite() && self.high.is_finite() && self.low <= self.high
    }
}

/// A box with sides along the axes, boundary included; infinite in z around things without a height.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bounds {
    /// The corner with the least coordinates, metres.
    pub low: Point,
    /// The corner with the greatest coordinates, metres.
    pub high: Point,
}

impl Bounds {
    /// The smallest box around both points.
    #[inline]
    pub fn of_segment(a: Point, b: Point) -> Bounds {
        Bounds {
            low: Point::new(lesser(a.x, b.x), lesser(a.y, b.y), lesser(a.z, b.z)),
            high: Point::new(greater(a.x, b.x), greater(a.y, b.y), greater(a.z, b.z)),
        }
    }

    /// The smallest box around an upright cylinder moved from base centre `a` to base centre `b`,
    /// radius and height in metres.
    pub fn of_body(a: Point, b: Point, radius: f64, body_height: f64) -> Bounds {
        let path = Bounds::of_segment(a, b);
        let low = Point::new(path.low.x - radius, path.low.y - radius, path.low.z);
        let top = path.high.z + body_height;
        Bounds {
            low,
            high: Point::new(path.high.x + radius, path.high.y + radius, top),
        }
    }

    /// This box moved outwards by `margin` metres on every side.
    #[inline]
    pub fn inflated(&self, margin: f64) -> Bounds {
        let margin = Point::new(margin, margin, margin);
        Bounds {
            low: self.low - margin,
            high: self.high + margin,
        }
    }

    /// This box without limits in height.
    pub fn planar(&self) -> Bounds {
        Bounds {
            low: self.low.at_height(f64::NEG_INFINITY),
            high: self.high.at_height(f64::INFINITY),
        }
    }

    /// Whether the boxes share a point.
    #[inline]
    pub fn overlaps(&self, other: &Bounds) -> bool {
        // One branch instead of six: this is what a query spends most of its time on.
        (self.low.x <= other.high.x)
            & (other.low.x <= self.high.x)
            & (self.low.y <= other.high.y)
            & (other.low.y <= self.high.y)
            & (self.low.z <= other.high.z)
            & (other.low.z <= self.high.z)
    }

    /// Whether the point lies in the box or on its boundary.
    #[inline]
    pub fn contains(&self, p: Point) -> bool {
        self.overlaps(&Bounds { low: p, high: p })
    }
}
