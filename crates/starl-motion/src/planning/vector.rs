//! Points of the planners' space: two coordinates for a robot on the floor, three for one in the air.

use starl_core::math;

/// A point or displacement with `D` coordinates, metres.
pub type Vector<const D: usize> = [f64; D];

/// The displacement from `a` to `b`.
#[inline]
pub fn difference<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> Vector<D> {
    core::array::from_fn(|axis| b[axis] - a[axis])
}

/// Scalar product.
#[inline]
pub fn dot<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> f64 {
    let mut sum = 0.0;
    for axis in 0..D {
        sum += a[axis] * b[axis];
    }
    sum
}

/// Squared distance, square metres.
#[inline]
pub fn distance_squared<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> f64 {
    let way = difference(a, b);
    dot(&way, &way)
}

/// Distance, metres.
#[inline]
pub fn distance<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> f64 {
    math::sqrt(distance_squared(a, b))
}

/// The point `fraction` of the way from `a` to `b`.
#[inline]
pub fn between<const D: usize>(a: &Vector<D>, b: &Vector<D>, fraction: f64) -> Vector<D> {
    core::array::from_fn(|axis| a[axis] + (b[axis] - a[axis]) * fraction)
}

/// Length of a path, metres.
pub fn length<const D: usize>(path: &[Vector<D>]) -> f64 {
    path.windows(2)
        .map(|ends| distance(&ends[0], &ends[1]))
        .sum()
}
