//! The places through which a path between two points can be shorter than a given length.

use super::vector::{Vector, between, difference, distance, dot};
use starl_core::{Random, math};

/// All points whose distances to two foci sum to at most a given length: an ellipse in the plane, an ellipsoid of
/// revolution in space (Gammell, Srinivasa and Barfoot 2014).
#[derive(Clone, Copy, Debug)]
pub struct Ellipsoid<const D: usize> {
    center: Vector<D>,
    /// Reflects the first axis onto the line through the foci; zero if it is that line already.
    mirror: Vector<D>,
    /// Half the length along that line, and across it, metres.
    along: f64,
    across: f64,
}

impl<const D: usize> Ellipsoid<D> {
    /// The one about these foci for paths of this length, metres.
    pub fn new(a: &Vector<D>, b: &Vector<D>, length: f64) -> Self {
        let apart = distance(a, b);
        let squared = length * length - apart * apart;
        let across = if squared > 0.0 {
            0.5 * math::sqrt(squared)
        } else {
            0.0
        };
        let mut mirror = difference(a, b).map(|way| if apart > 0.0 { way / apart } else { 0.0 });
        mirror[0] -= 1.0;
        let size = dot(&mirror, &mirror);
        let flat = apart <= 0.0 || size < 1e-24;
        let scale = if flat { 0.0 } else { math::sqrt(2.0 / size) };
        let mirror = mirror.map(|part| part * scale);
        Ellipsoid {
            center: between(a, b, 0.5),
            mirror,
            along: 0.5 * length,
            across,
        }
    }

    /// Area or volume.
    pub fn volume(&self) -> f64 {
        let ball = if D == 2 {
            math::PI
        } else {
            4.0 / 3.0 * math::PI
        };
        (1..D).fold(ball * self.along, |volume, _| volume * self.across)
    }

    /// A place in it, drawn evenly.
    pub fn sample(&self, random: &mut Random) -> Vector<D> {
        let mut ball: Vector<D> = [1.0; D];
        while dot(&ball, &ball) > 1.0 {
            ball = core::array::from_fn(|_| random.between(-1.0, 1.0));
        }
        let stretched: Vector<D> = core::array::from_fn(|axis| {
            ball[axis] * if axis == 0 { self.along } else { self.across }
        });
        // A reflection (Householder) does for a rotation, the ellipsoid being one of revolution.
        let part = dot(&stretched, &self.mirror);
        core::array::from_fn(|axis| self.center[axis] + stretched[axis] - part * self.mirror[axis])
    }
}
