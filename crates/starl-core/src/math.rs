//! Transcendental functions that give the same bits on every target.
//!
//! The standard library's differ between glibc and WebAssembly; these come from `libm`. Square root, floor and similar
//! functions are exact in IEEE 754, so those of the standard library may be used.

pub use core::f64::consts::{FRAC_PI_2, PI, TAU};
pub use exact::{ceil, fabs, floor, sqrt};
pub use libm::{acos, asin, atan, atan2, cos, exp, hypot, log, pow, round, sin, sincos, tan, tanh};

/// `libm` computes these in software on WebAssembly, which has instructions for them.
#[cfg(target_family = "wasm")]
mod exact {
    extern crate std;

    /// The square root.
    pub fn sqrt(x: f64) -> f64 {
        x.sqrt()
    }
    /// The largest whole number that is not above `x`.
    pub fn floor(x: f64) -> f64 {
        x.floor()
    }
    /// The smallest whole number that is not below `x`.
    pub fn ceil(x: f64) -> f64 {
        x.ceil()
    }
    /// The absolute value.
    pub fn fabs(x: f64) -> f64 {
        x.abs()
    }
}

#[cfg(not(target_family = "wasm"))]
mod exact {
    pub use libm::{ceil, fabs, floor, sqrt};
}

/// The angle in (-pi, pi] that points the same way, in radians.
pub fn wrap_angle(angle: f64) -> f64 {
    if angle > -PI && angle <= PI {
        return angle;
    }
    let turned = angle - TAU * floor((angle + PI) / TAU);
    if turned <= -PI { turned + TAU } else { turned }
}

/// Degrees to radians.
pub fn radians(degrees: f64) -> f64 {
    degrees * (PI / 180.0)
}

/// Radians to degrees.
pub fn degrees(radians: f64) -> f64 {
    radians * (180.0 / PI)
}
