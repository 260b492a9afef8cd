//! Arithmetic of times and durations, which are never negative.

use starl_lang::machine::Fault;

use super::support::{faults, values};

const DECLARATIONS: &str = "d: Duration = 3s\ne: Duration = 500ms\nn: Int = 4\nx: Float = 1.5";

#[test]
fn durations() {
    values(
        DECLARATIONS,
        &[
            ("d + e", "3500ms"),
            ("d - e", "2500ms"),
            ("e - d", "0s"),
            ("d * 2", "6s"),
            ("2 * d", "6s"),
            ("d * n", "12s"),
            ("n * e", "2s"),
            ("d * x", "4500ms"),
            ("x * d", "4500ms"),
            ("d * 0.5", "1500ms"),
            ("d / 2", "1500ms"),
            ("d / n", "750ms"),
            ("1s / 3", "333333333ns"),
            ("d / x", "2s"),
            ("1s / 0.3", "3333333333ns"),
            ("d / e", "6.0"),
            ("e / d < 0.2", "true"),
            ("d + 7ns", "3000000007ns"),
            ("d + 1h", "3603s"),
            ("1.5min", "90s"),
            ("0s", "0s"),
            ("20us", "20us"),
            ("min(d, e)", "500ms"),
            ("max(d, e)", "3s"),
            ("d > e", "true"),
            ("d == 3s", "true"),
        ],
    );
}

#[test]
fn times() {
    // The clock says 1.5 s.
    values(
        DECLARATIONS,
        &[
            ("now", "1.500s"),
            ("now + d", "4.500s"),
            ("d + now", "4.500s"),
            ("now - e", "1.000s"),
            ("now - d", "0.000s"),
            ("now - now", "0s"),
            ("(now + d) - now", "3s"),
            ("now < now + 1ns", "true"),
        ],
    );
}

#[test]
fn a_duration_is_never_negative() {
    faults(
        DECLARATIONS,
        &[
            ("log(\"{}\", d * -1)", 1, Fault::Overflow),
            ("log(\"{}\", d * -0.5)", 1, Fault::Overflow),
            ("n = -2\nlog(\"{}\", d / n)", 2, Fault::Overflow),
            ("log(\"{}\", d / -2)", 1, Fault::Overflow),
            ("log(\"{}\", d / -0.5)", 1, Fault::Overflow),
            ("log(\"{}\", d / 0.0)", 1, Fault::Overflow),
            ("log(\"{}\", d / 0)", 1, Fault::DivisionByZero),
            ("log(\"{}\", d / 0s)", 1, Fault::DivisionByZero),
        ],
    );
}
