//! A point, or a displacement, in space.

use crate::math;
use core::fmt;
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub};
use serde::{Deserialize, Serialize};

/// A point or displacement in the world frame, metres (the thesis's ItemPosition).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Metres along x.
    pub x: f64,
    /// Metres along y.
    pub y: f64,
    /// Metres above the floor.
    pub z: f64,
}

impl Point {
    /// The origin.
    pub const ZERO: Point = Point::new(0.0, 0.0, 0.0);

    /// The point with these coordinates.
    pub const fn new(x: f64, y: f64, z: f64) -> Point {
        Point { x, y, z }
    }

    /// The point on the floor with these coordinates.
    pub const fn planar(x: f64, y: f64) -> Point {
        Point { x, y, z: 0.0 }
    }

    /// The displacement of this length in the floor plane, `angle` radians from the x axis.
    pub fn polar(length: f64, angle: f64) -> Point {
        let (sin, cos) = math::sincos(angle);
        Point::planar(length * cos, length * sin)
    }

    /// This point moved to height `z`.
    pub const fn at_height(self, z: f64) -> Point {
        Point { z, ..self }
    }

    /// Scalar product.
    pub fn dot(self, other: Point) -> f64 {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The z component of the cross product: positive if `other` is to the left in the plane.
    pub fn cross_planar(self, other: Point) -> f64 {
        self.x * other.y - self.y * other.x
    }

    /// Squared length.
    pub fn length_squared(self) -> f64 {
        self.dot(self)
    }

    /// Length.
    pub fn length(self) -> f64 {
        math::sqrt(self.length_squared())
    }

    /// Length of the part in the floor plane.
    pub fn planar_length(self) -> f64 {
        math::sqrt(self.x * self.x + self.y * self.y)
    }

    /// Distance to another point.
    pub fn distance(self, other: Point) -> f64 {
        (other - self).length()
    }

    /// Distance to another point, heights left out.
    pub fn planar_distance(self, other: Point) -> f64 {
        (other - self).planar_length()
    }

    /// Direction of the part in the floor plane, radians from the x axis.
    pub fn heading(self) -> f64 {
        math::atan2(self.y, self.x)
    }

    /// The point `fraction` of the way to another one.
    pub fn lerp(self, other: Point, fraction: f64) -> Point {
        self + (other - self) * fraction
    }

    /// The displacement of length one that points the same way; none for length zero.
    pub fn normalized(self) -> Option<Point> {
        let length = self.length();
        (length > 0.0).then(|| self / length)
    }

    /// Whether all coordinates are finite.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }
}

impl Add for Point {
    type Output = Point;
    fn add(self, other: Point) -> Point {
        Point::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl AddAssign for Point {
    fn add_assign(&mut self, other: Point) {
        *self = *self + other;
    }
}

impl Sub for Point {
    type Output = Point;
    fn sub(self, other: Point) -> Point {
        Point::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl Neg for Point {
    type Output = Point;
    fn neg(self) -> Point {
        Point::new(-self.x, -self.y, -self.z)
    }
}

impl Mul<f64> for Point {
    type Output = Point;
    fn mul(self, factor: f64) -> Point {
        Point::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl Div<f64> for Point {
    type Output = Point;
    fn div(self, divisor: f64) -> Point {
        Point::new(self.x / divisor, self.y / divisor, self.z / divisor)
    }
}

impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({:.3}, {:.3}, {:.3}) m", self.x, self.y, self.z)
    }
}
