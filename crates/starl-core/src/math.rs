//! Transcendental functions that give the same bits on every target.
//!
//! The standard library's differ between glibc and WebAssembly; these come from `libm`. Square root,
//! floor and the like are exact in IEEE 754 and may be used from wherever they come.

pub use core::f64::consts::{FRAC_PI_2, PI, TAU};
pub use libm::{
    acos, asin, atan, atan2, ceil, cos, exp, fabs, floor, hypot, log, pow, round, sin, sincos,
    sqrt, tan,
};

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
