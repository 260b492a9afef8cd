//! Arithmetic of Ints and Floats, with constants and without.

use starl_lang::machine::Fault;

use super::support::{faults, values};

const DECLARATIONS: &str =
    "a: Int = 7\nb: Int = -3\nx: Float = 2.5\ny: Float = -0.5\nfar: Int = 3000000000";

#[test]
fn whole_numbers_are_floats_where_these_belong() {
    let declarations = format!(
        "{DECLARATIONS}\nz: Float = 4\nw: Float? = -5\nzs: List[Float] = [1, 2.5, -3]\np: Point = Point(1, 2)"
    );
    values(
        &declarations,
        &[
            ("z", "4.0"),
            ("w ?? 0", "-5.0"),
            ("zs", "[1.0, 2.5, -3.0]"),
            ("2 * x", "5.0"),
            ("x / 2", "1.25"),
            ("1 - x", "-1.5"),
            ("x > 2 and 3 > x and x != 2", "true"),
            ("2 * p / 4", "(0.5, 1.0, 0.0)"),
            ("max(0, x)", "2.5"),
            ("min(x, 1)", "1.0"),
            ("max(1, 2)", "2"),
            ("max(1, 2) / 4", "0"),
            ("if x > 2 then 1 else 0.5", "1.0"),
            ("(if x > 2 then 1 else 0) / 2", "0"),
            ("sqrt(4)", "2.0"),
            ("zs.contains(1)", "true"),
            ("zs + [4]", "[1.0, 2.5, -3.0, 4.0]"),
            // The division is of Ints, and its result is not in the text.
            ("x + Float(7 / 2)", "5.5"),
        ],
    );
}

#[test]
fn integers() {
    values(
        DECLARATIONS,
        &[
            ("a + b", "4"),
            ("a - b", "10"),
            ("a * b", "-21"),
            ("a / b", "-2"),
            ("b / a", "0"),
            ("a % b", "1"),
            ("b % a", "-3"),
            ("a + 1", "8"),
            ("1 + a", "8"),
            ("a - 1", "6"),
            ("1 - a", "-6"),
            ("a * 2", "14"),
            ("2 * a", "14"),
            ("a / 2", "3"),
            ("b / 2", "-1"),
            ("20 / a", "2"),
            ("a % 4", "3"),
            ("b % 2", "-1"),
            ("20 % a", "6"),
            ("-a", "-7"),
            ("-(a + b)", "-4"),
            ("a + b * 2", "1"),
            ("(a + b) * 2", "8"),
            ("a - b - 1", "9"),
            ("a - (b - 1)", "11"),
            ("(a + 1) * (b + 1) - (a - 1) * (b - 1)", "8"),
            ("a + far", "3000000007"),
            ("a + 3000000000", "3000000007"),
            ("a - 3000000000", "-2999999993"),
            ("far * 2", "6000000000"),
            ("a - -2147483648", "2147483655"),
            ("2 + 3 * 4", "14"),
            ("7 / 2", "3"),
            ("-7 / 2", "-3"),
            ("-7 % 2", "-1"),
            ("9223372036854775807", "9223372036854775807"),
            ("-9223372036854775807 - 1", "-9223372036854775808"),
            ("abs(b)", "3"),
            ("min(a, b)", "-3"),
            ("max(a, b)", "7"),
            ("max(a, 8)", "8"),
            ("clamp(a, 0, 5)", "5"),
            ("clamp(b, 0, 5)", "0"),
            ("clamp(a, 0, 50)", "7"),
        ],
    );
}

#[test]
fn floats() {
    values(
        DECLARATIONS,
        &[
            ("x + y", "2.0"),
            ("x - y", "3.0"),
            ("x * y", "-1.25"),
            ("x / y", "-5.0"),
            ("x + 1.0", "3.5"),
            ("1.0 - x", "-1.5"),
            ("-x", "-2.5"),
            ("-(x * 2.0)", "-5.0"),
            ("1.5 + 2.0 * 3.0", "7.5"),
            ("x / 0.0", "inf"),
            ("-x / 0.0", "-inf"),
            ("0.0 / 0.0", "NaN"),
            ("75mm", "0.075"),
            ("2km + 1m", "2001.0"),
            ("180deg == pi", "true"),
            ("abs(y)", "0.5"),
            ("min(x, y)", "-0.5"),
            ("max(x, y)", "2.5"),
            ("clamp(x, 0.0, 1.0)", "1.0"),
            ("clamp(y, 0.0, 1.0)", "0.0"),
            ("sqrt(x + 1.5)", "2.0"),
            ("sin(0.0)", "0.0"),
            ("cos(0.0)", "1.0"),
            ("tan(0.0)", "0.0"),
            ("atan2(0.0, 1.0)", "0.0"),
            ("exp(0.0)", "1.0"),
            ("log_e(1.0)", "0.0"),
            ("pow(2.0, 10.0)", "1024.0"),
            ("pi > 3.14 and pi < 3.15", "true"),
        ],
    );
}

#[test]
fn conversions() {
    values(
        DECLARATIONS,
        &[
            ("Float(a)", "7.0"),
            ("Float(3)", "3.0"),
            ("Float(a) / 2.0", "3.5"),
            ("Int(x)", "2"),
            ("Int(-x)", "-2"),
            ("round(x)", "3"),
            ("round(-x)", "-3"),
            ("floor(-x)", "-3"),
            ("ceil(-x)", "-2"),
            ("floor(x)", "2"),
            ("ceil(x)", "3"),
        ],
    );
}

#[test]
fn arithmetic_errors_stop_the_program_at_their_line() {
    let rows = [
        ("log(\"{}\", a / (b + 3))", 1, Fault::DivisionByZero),
        ("let c = a\nlog(\"{}\", c / 0)", 2, Fault::DivisionByZero),
        ("a = a % (b + 3)", 1, Fault::DivisionByZero),
        ("a = 9223372036854775807\na += 1", 2, Fault::Overflow),
        (
            "a = 9223372036854775807\n\nlog(\"{}\", a * 2)",
            3,
            Fault::Overflow,
        ),
        ("log(\"{}\", 9223372036854775807 + a)", 1, Fault::Overflow),
        ("log(\"{}\", 9223372036854775807 + 1)", 1, Fault::Overflow),
        ("log(\"{}\", Int(1e300))", 1, Fault::ConversionOutOfRange),
        (
            "x = 1.0 / 0.0\nlog(\"{}\", round(x))",
            2,
            Fault::ConversionOutOfRange,
        ),
        (
            "a = -9223372036854775807\na -= 1\nlog(\"{}\", abs(a))",
            3,
            Fault::Overflow,
        ),
    ];
    faults(DECLARATIONS, &rows);
}
