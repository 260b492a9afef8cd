//! Instructions on scalars compute the documented results, and stop at the documented errors.

use crate::machine_support::{float, int, of_floats, scalar};
use starl_lang::machine::Fault;

type Unary = fn(f64) -> f64;
type Binary = fn(f64, f64) -> f64;

const MIN: i64 = i64::MIN;
const MAX: i64 = i64::MAX;

#[test]
fn ints() {
    assert_eq!(int("add_int r0 r0 r1", &[3, 4]), Ok(7));
    assert_eq!(int("add_int r0 r0 r1", &[MAX, 1]), Err(Fault::Overflow));
    assert_eq!(int("subtract_int r0 r0 r1", &[3, 4]), Ok(-1));
    assert_eq!(
        int("subtract_int r0 r0 r1", &[MIN, 1]),
        Err(Fault::Overflow)
    );
    assert_eq!(int("multiply_int r0 r0 r1", &[-3, 4]), Ok(-12));
    assert_eq!(
        int("multiply_int r0 r0 r1", &[MAX, 2]),
        Err(Fault::Overflow)
    );
    assert_eq!(int("negate_int r0 r0", &[5]), Ok(-5));
    assert_eq!(int("negate_int r0 r0", &[MIN]), Err(Fault::Overflow));
    assert_eq!(int("absolute_int r0 r0", &[-5]), Ok(5));
    assert_eq!(int("absolute_int r0 r0", &[MIN]), Err(Fault::Overflow));
    assert_eq!(int("minimum_int r0 r0 r1", &[-5, 2]), Ok(-5));
    assert_eq!(int("maximum_int r0 r0 r1", &[-5, 2]), Ok(2));
}

#[test]
fn division_is_towards_zero() {
    for (left, right) in [
        (7, 2),
        (-7, 2),
        (7, -2),
        (-7, -2),
        (0, 3),
        (1 << 40, 3),
        (MIN, 2),
        (3, MAX),
    ] {
        assert_eq!(int("divide_int r0 r0 r1", &[left, right]), Ok(left / right));
        assert_eq!(
            int("remainder_int r0 r0 r1", &[left, right]),
            Ok(left % right)
        );
    }
    for left in [0, 9, -9, MAX, MIN] {
        assert_eq!(int("divide_constant r0 r0 7", &[left]), Ok(left / 7));
        assert_eq!(int("remainder_constant r0 r0 -7", &[left]), Ok(left % -7));
        for body in ["divide_int r0 r0 r1", "remainder_int r0 r0 r1"] {
            assert_eq!(int(body, &[left, 0]), Err(Fault::DivisionByZero));
        }
        for body in ["divide_constant r0 r0 0", "remainder_constant r0 r0 0"] {
            assert_eq!(int(body, &[left]), Err(Fault::DivisionByZero));
        }
    }
    assert_eq!(int("divide_int r0 r0 r1", &[MIN, -1]), Err(Fault::Overflow));
    assert_eq!(
        int("divide_constant r0 r0 -1", &[MIN]),
        Err(Fault::Overflow)
    );
    assert_eq!(int("remainder_int r0 r0 r1", &[MIN, -1]), Ok(0));
}

#[test]
fn constants_in_instructions() {
    assert_eq!(
        int("add_constant r0 r0 -2147483648", &[1]),
        Ok(1 - (1 << 31))
    );
    assert_eq!(int("add_constant r0 r0 1", &[MAX]), Err(Fault::Overflow));
    assert_eq!(int("multiply_constant r0 r0 -3", &[4]), Ok(-12));
    assert_eq!(
        int("multiply_constant r0 r0 3", &[MAX / 2]),
        Err(Fault::Overflow)
    );
    assert_eq!(int("int r0 -5", &[]), Ok(-5));
}

#[test]
fn moves() {
    assert_eq!(int("copy r0 r1", &[1, 2]), Ok(2));
    // The parts of a block may overlap with where it goes.
    let body = "copy_block r1 r0 #3\n multiply_constant r1 r1 100\n multiply_constant r2 r2 10\n \
                add_int r0 r1 r2\n add_int r0 r0 r3";
    assert_eq!(int(body, &[1, 2, 3]), Ok(123));
}

#[test]
fn spans_are_never_negative() {
    assert_eq!(int("subtract_span r0 r0 r1", &[7, 4]), Ok(3));
    assert_eq!(int("subtract_span r0 r0 r1", &[4, 7]), Ok(0));
    assert_eq!(int("multiply_span r0 r0 r1", &[4, 7]), Ok(28));
    assert_eq!(
        int("multiply_span r0 r0 r1", &[4, -7]),
        Err(Fault::Overflow)
    );
    assert_eq!(
        int("multiply_span r0 r0 r1", &[MAX, 2]),
        Err(Fault::Overflow)
    );
    let half = 0.5f64.to_bits() as i64;
    assert_eq!(int("scale_span r0 r0 r1", &[5, half]), Ok(3)); // 2.5, halves away from zero
    for factor in [-1.0, 1e300, f64::NAN, f64::INFINITY] {
        let factor = f64::to_bits(factor) as i64;
        assert_eq!(
            int("scale_span r0 r0 r1", &[5, factor]),
            Err(Fault::Overflow)
        );
    }
    assert_eq!(scalar("ratio_span r0 r0 r1", &[3, 2]), Ok(1.5f64.to_bits()));
    assert_eq!(
        scalar("ratio_span r0 r0 r1", &[3, 0]),
        Err(Fault::DivisionByZero)
    );
}

#[test]
fn floats() {
    assert_eq!(float("add_float r0 r0 r1", &[1.5, 2.0]), 3.5);
    assert_eq!(float("subtract_float r0 r0 r1", &[1.5, 2.0]), -0.5);
    assert_eq!(float("multiply_float r0 r0 r1", &[1.5, 2.0]), 3.0);
    assert_eq!(float("divide_float r0 r0 r1", &[1.5, 2.0]), 0.75);
    assert_eq!(float("divide_float r0 r0 r1", &[1.5, 0.0]), f64::INFINITY);
    assert_eq!(float("negate_float r0 r0", &[1.5]), -1.5);
    assert_eq!(float("absolute_float r0 r0", &[-1.5]), 1.5);
    assert_eq!(float("minimum_float r0 r0 r1", &[1.5, 2.0]), 1.5);
    assert_eq!(float("maximum_float r0 r0 r1", &[1.5, 2.0]), 2.0);
    assert_eq!(float("minimum_float r0 r0 r1", &[f64::NAN, 2.0]), 2.0);
    assert_eq!(float("maximum_float r0 r0 r1", &[2.0, f64::NAN]), 2.0);
    // Whichever comes first: the sign of a zero does not depend on the order.
    for pair in [[0.0, -0.0], [-0.0, 0.0]] {
        assert!(float("minimum_float r0 r0 r1", &pair).is_sign_negative());
        assert!(float("maximum_float r0 r0 r1", &pair).is_sign_positive());
    }
}

#[test]
fn there_is_one_nan() {
    let zero_by_zero = scalar("divide_float r0 r0 r1", &[0, 0]);
    assert_eq!(zero_by_zero, Ok(f64::NAN.to_bits()));
    let root = scalar("unary r0 r0 square_root", &[(-1.0f64).to_bits()]);
    assert_eq!(root, Ok(f64::NAN.to_bits()));
}

#[test]
fn functions_of_floats() {
    use starl_core::math;
    let unary: [(&str, Unary); 13] = [
        ("square_root", math::sqrt),
        ("sine", math::sin),
        ("cosine", math::cos),
        ("tangent", math::tan),
        ("arc_sine", math::asin),
        ("arc_cosine", math::acos),
        ("arc_tangent", math::atan),
        ("exponential", math::exp),
        ("logarithm", math::log),
        ("floor", math::floor),
        ("ceiling", math::ceil),
        ("round", math::round),
        ("wrap_angle", math::wrap_angle),
    ];
    for (name, function) in unary {
        assert_eq!(
            float(&format!("unary r0 r0 {name}"), &[0.7]),
            function(0.7),
            "{name}"
        );
    }
    let binary: [(&str, Binary); 4] = [
        ("arc_tangent", math::atan2),
        ("power", math::pow),
        ("hypotenuse", math::hypot),
        ("remainder", |left, right| left % right),
    ];
    for (name, function) in binary {
        let result = float(&format!("binary r0 r0 r1 {name}"), &[-7.5, 2.0]);
        assert_eq!(result, function(-7.5, 2.0), "{name}");
    }
}

#[test]
fn conversions() {
    assert_eq!(scalar("float_of_int r0 r0", &[3]), Ok(3f64.to_bits()));
    let roundings = [
        ("truncate", [2, -2, 2, -2]),
        ("floor", [2, -3, 2, -3]),
        ("ceiling", [3, -2, 3, -2]),
        ("nearest", [3, -3, 2, -2]),
    ];
    for (rounding, expected) in roundings {
        let body = format!("int_of_float r0 r0 {rounding}");
        for (number, expected) in [2.5, -2.5, 2.4, -2.4].into_iter().zip(expected) {
            assert_eq!(
                of_floats(&body, &[number]),
                Ok(expected),
                "{rounding} {number}"
            );
        }
        for number in [f64::NAN, f64::INFINITY, 9_223_372_036_854_775_808.0, -1e19] {
            assert_eq!(
                of_floats(&body, &[number]),
                Err(Fault::ConversionOutOfRange)
            );
        }
        assert_eq!(of_floats(&body, &[-9_223_372_036_854_775_808.0]), Ok(MIN));
    }
}

#[test]
fn truth() {
    assert_eq!(int("not r0 r0", &[0]), Ok(1));
    assert_eq!(int("not r0 r0", &[1]), Ok(0));
    for (left, right) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        assert_eq!(int("and r0 r0 r1", &[left, right]), Ok(left & right));
        assert_eq!(int("or r0 r0 r1", &[left, right]), Ok(left | right));
    }
}

#[test]
fn comparisons() {
    for (left, right) in [(1, 2), (2, 1), (2, 2), (-1, 1), (MIN, MAX)] {
        let is = |body: &str, expected: bool| {
            assert_eq!(
                int(body, &[left, right]),
                Ok(i64::from(expected)),
                "{body} {left} {right}"
            );
        };
        is("equal r0 r0 r1", left == right);
        is("not_equal r0 r0 r1", left != right);
        is("less_int r0 r0 r1", left < right);
        is("less_equal_int r0 r0 r1", left <= right);
    }
    for (left, right) in [
        (1.0, 2.0),
        (2.0, 1.0),
        (0.0, -0.0),
        (f64::NAN, 1.0),
        (f64::NAN, f64::NAN),
    ] {
        let is = |body: &str, expected: bool| {
            assert_eq!(
                of_floats(body, &[left, right]),
                Ok(i64::from(expected)),
                "{body} {left} {right}"
            );
        };
        is("equal_float r0 r0 r1", left == right);
        is("less_float r0 r0 r1", left < right);
        is("less_equal_float r0 r0 r1", left <= right);
    }
}

#[test]
fn points() {
    let a = [1.0, 2.0, 3.0];
    let b = [4.0, 6.0, 3.0];
    let both = [a, b].concat();
    let each = |body: &str, expected: [f64; 3]| {
        for (place, expected) in ["r0", "r1", "r2"].into_iter().zip(expected) {
            let body = format!("{body}\n copy r0 {place}");
            assert_eq!(float(&body, &both), expected, "{body}");
        }
    };
    each("copy_point r0 r3", b);
    each("add_point r0 r0 r3", [5.0, 8.0, 6.0]);
    each("subtract_point r0 r0 r3", [-3.0, -4.0, 0.0]);
    each("negate_point r0 r0", [-1.0, -2.0, -3.0]);
    each("scale_point r0 r0 r3", [4.0, 8.0, 12.0]);
    each("divide_point r0 r0 r3", [0.25, 0.5, 0.75]);
    assert_eq!(float("distance r0 r0 r3", &both), 5.0);
    assert_eq!(of_floats("equal_point r0 r0 r3", &both), Ok(0));
    assert_eq!(of_floats("equal_point r0 r0 r0", &both), Ok(1));
}

#[test]
fn none_has_no_value() {
    assert_eq!(int("require r0\n int r0 5", &[1]), Ok(5));
    assert_eq!(
        int("require r0\n int r0 5", &[0]),
        Err(Fault::NoneUnwrapped)
    );
}
