//! Arithmetic on scalars that is more than one operation.

use crate::machine::error::Fault;
use crate::machine::host::Host;
use crate::machine::operand::{Binary, Rounding, Unary};
use alloc::borrow::Cow;
use starl_core::{RobotId, math};

/// left / right, towards zero.
#[inline(always)]
pub(in crate::machine) fn divide(left: i64, right: i64) -> Result<u64, Fault> {
    if let (Ok(left), Ok(right)) = (u32::try_from(left), u32::try_from(right))
        && right != 0
    {
        return Ok(u64::from(left / right)); // many processors divide 32 bits faster
    }
    match left.checked_div(right) {
        Some(quotient) => Ok(quotient as u64),
        None => Err(division_fault(right)),
    }
}

/// left % right, with the sign of `left`.
#[inline(always)]
pub(in crate::machine) fn remainder(left: i64, right: i64) -> Result<u64, Fault> {
    if let (Ok(left), Ok(right)) = (u32::try_from(left), u32::try_from(right))
        && right != 0
    {
        return Ok(u64::from(left % right));
    }
    match right {
        0 => Err(Fault::DivisionByZero),
        right => Ok(left.wrapping_rem(right) as u64), // i64::MIN % -1 is 0
    }
}

#[cold]
fn division_fault(right: i64) -> Fault {
    if right == 0 {
        Fault::DivisionByZero
    } else {
        Fault::Overflow
    }
}

/// A duration times a number that must not be negative.
pub(in crate::machine) fn multiply_span(span: i64, times: i64) -> Option<i64> {
    span.checked_mul(times).filter(|product| *product >= 0)
}

/// A duration times a factor, to the nearest nanosecond.
pub(in crate::machine) fn scale_span(span: i64, factor: f64) -> Result<u64, Fault> {
    let product = math::round(span as f64 * factor);
    if (0.0..9_223_372_036_854_775_808.0).contains(&product) {
        Ok(product as u64)
    } else {
        Err(Fault::Overflow)
    }
}

/// How many times one duration is another.
pub(in crate::machine) fn ratio_span(left: i64, right: i64) -> Result<u64, Fault> {
    if right == 0 {
        return Err(Fault::DivisionByZero);
    }
    Ok((left as f64 / right as f64).to_bits())
}

/// The lesser of two; where both are zero, the one with its sign set; the other where one is NaN.
pub(in crate::machine) fn minimum(left: f64, right: f64) -> f64 {
    if left < right || right.is_nan() || (left == right && left.is_sign_negative()) {
        left
    } else {
        right
    }
}

/// The greater of two; where both are zero, one without its sign set; the other where one is NaN.
pub(in crate::machine) fn maximum(left: f64, right: f64) -> f64 {
    if left > right || right.is_nan() || (left == right && left.is_sign_positive()) {
        left
    } else {
        right
    }
}

/// A Float as an Int.
pub(in crate::machine) fn int_of_float(number: f64, rounding: Rounding) -> Result<u64, Fault> {
    let whole = match rounding {
        Rounding::Truncate => number,
        Rounding::Floor => math::floor(number),
        Rounding::Ceiling => math::ceil(number),
        Rounding::Nearest => math::round(number),
    };
    // Both bounds are Floats: -2^63 is an Int, 2^63 is not.
    if (-9_223_372_036_854_775_808.0..9_223_372_036_854_775_808.0).contains(&whole) {
        Ok(whole as i64 as u64)
    } else {
        Err(Fault::ConversionOutOfRange)
    }
}

/// A function of one Float.
#[inline(never)]
pub(in crate::machine) fn unary(function: Unary, number: f64) -> f64 {
    match function {
        Unary::SquareRoot => math::sqrt(number),
        Unary::Sine => math::sin(number),
        Unary::Cosine => math::cos(number),
        Unary::Tangent => math::tan(number),
        Unary::ArcSine => math::asin(number),
        Unary::ArcCosine => math::acos(number),
        Unary::ArcTangent => math::atan(number),
        Unary::Exponential => math::exp(number),
        Unary::Logarithm => math::log(number),
        Unary::Floor => math::floor(number),
        Unary::Ceiling => math::ceil(number),
        Unary::Round => math::round(number),
        Unary::WrapAngle => math::wrap_angle(number),
    }
}

/// A function of two Floats.
#[inline(never)]
pub(in crate::machine) fn binary(function: Binary, left: f64, right: f64) -> f64 {
    match function {
        Binary::ArcTangent => math::atan2(left, right),
        Binary::Power => math::pow(left, right),
        Binary::Hypotenuse => math::hypot(left, right),
        Binary::Remainder => left % right, // exact in IEEE 754, so the same everywhere
    }
}

/// A scalar of the state of another robot.
#[inline(never)]
pub(in crate::machine) fn of_other(
    host: &dyn Host,
    robot: RobotId,
    variable: u32,
) -> Result<u64, Fault> {
    let state = host.state_of(robot).ok_or_else(unknown_robot)?;
    let scalar = state.scalars.get(variable as usize);
    scalar.copied().ok_or(Fault::Malformed)
}

/// Three scalars of the state of another robot.
#[inline(never)]
pub(in crate::machine) fn point_of_other(
    host: &dyn Host,
    robot: RobotId,
    variable: u32,
) -> Result<[u64; 3], Fault> {
    let state = host.state_of(robot).ok_or_else(unknown_robot)?;
    let point = state.scalars.get(variable as usize..);
    let point = point.and_then(|scalars| scalars.first_chunk());
    point.copied().ok_or(Fault::Malformed)
}

/// The error of a program that asks for the state of a robot that does not exist.
pub(in crate::machine) fn unknown_robot() -> Fault {
    Fault::Host(Cow::Borrowed("no robot with this number runs this program"))
}
