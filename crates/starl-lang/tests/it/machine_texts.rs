//! Instructions on texts.

use crate::machine_support::{call, program};
use starl_lang::machine::{Fault, Object};

const DECLARATIONS: &str = "
enum Location init pick wait
type Text
type List[type0]
text \"caf\\u{e9} \\\"1\\\"\"
";

/// The text that a body leaves in `b0`, which begins with two texts as arguments in `b0` and `b1`
/// and an Int in `r0`.
fn text(body: &str, number: u64, texts: [&str; 2]) -> Result<String, Fault> {
    let code = format!(
        "{DECLARATIONS} function test function (Int, type0, type0) (type0) registers 8 objects 4\n\
         {body}\n return #1 #4"
    );
    match call(&program(&code), &[number], &texts.map(Object::from)) {
        Ok((_, objects)) => Ok(objects[0].text().to_string()),
        Err(error) => Err(error.fault),
    }
}

fn scalar(body: &str, texts: [&str; 2]) -> u64 {
    let code = format!(
        "{DECLARATIONS} function test function (Int, type0, type0) (Int) registers 8 objects 4\n\
         {body}\n return_scalar r0 #4"
    );
    call(&program(&code), &[0], &texts.map(Object::from))
        .expect("no error")
        .0[0]
}

#[test]
fn constants_and_sums() {
    assert_eq!(
        text("load_text b0 t0", 0, ["", ""]),
        Ok("caf\u{e9} \"1\"".into())
    );
    assert_eq!(
        text("append_text b0 b1", 0, ["ab", "cd"]),
        Ok("abcd".into())
    );
    assert_eq!(
        text("append_text b0 b0", 0, ["ab", "cd"]),
        Ok("abab".into())
    );
    assert_eq!(
        text("clear_object b0 type0\n append_text b0 b1", 0, ["ab", "cd"]),
        Ok("cd".into())
    );
}

#[test]
fn scalars_in_text_form() {
    for (format, scalar, expected) in [
        ("bool", 1, "true"),
        ("bool", 0, "false"),
        ("int", -5i64 as u64, "-5"),
        ("float", 1f64.to_bits(), "1.0"),
        ("float", 0.1f64.to_bits(), "0.1"),
        ("float", f64::NAN.to_bits(), "NaN"),
        ("time", 1_500_000_000, "1.500s"),
        ("duration", 1_500_000_000, "1500ms"),
        ("robot", 3, "robot3"),
    ] {
        let body = format!("append_scalar b0 r0 {format}");
        assert_eq!(
            text(&body, scalar, ["x = ", ""]),
            Ok(format!("x = {expected}"))
        );
    }
    assert_eq!(
        text("append_variant b0 r0 enum0", 2, ["", ""]),
        Ok("wait".into())
    );
    let missing = text("append_variant b0 r0 enum0", 3, ["", ""]);
    assert_eq!(missing, Err(Fault::ConversionOutOfRange));
    let point = "float_of_int r1 r0\n copy r2 r1\n copy r3 r1\n append_point b0 r1";
    assert_eq!(text(point, 2, ["", ""]), Ok("(2.0, 2.0, 2.0)".into()));
}

#[test]
fn objects_in_text_form() {
    let list = "split_text b2 b1 b0 type1\n append_object b0 b2 type1";
    assert_eq!(text(list, 0, [",", "a,b"]), Ok(",[\"a\", \"b\"]".into()));
    let plain = "append_object b0 b1 type0";
    assert_eq!(text(plain, 0, ["x = ", "a"]), Ok("x = a".into()));
    let quoted = "append_quoted b0 b1";
    let written = Ok("x = \"a\\\"b\"".into());
    assert_eq!(text(quoted, 0, ["x = ", "a\"b"]), written);
}

#[test]
fn sizes_are_in_characters() {
    assert_eq!(scalar("size r0 b0", ["caf\u{e9}", ""]), 4);
    assert_eq!(scalar("size r0 b1", ["caf\u{e9}", ""]), 0);
}

#[test]
fn order_and_equality() {
    assert_eq!(scalar("equal_object r0 b0 b1 type0", ["ab", "ab"]), 1);
    assert_eq!(scalar("equal_object r0 b0 b1 type0", ["ab", "b"]), 0);
    assert_eq!(scalar("less_object r0 b0 b1 type0", ["ab", "b"]), 1);
    assert_eq!(scalar("less_object r0 b0 b1 type0", ["", "b"]), 1);
    assert_eq!(scalar("less_object r0 b0 b1 type0", ["b", "ab"]), 0);
    // An empty text equals one that was never written.
    assert_eq!(
        scalar(
            "clear_object b1 type0\n equal_object r0 b0 b1 type0",
            ["", "x"]
        ),
        1
    );
}

#[test]
fn parts() {
    assert_eq!(scalar("contains_text r0 b0 b1", ["abcd", "bc"]), 1);
    assert_eq!(scalar("contains_text r0 b0 b1", ["abcd", "cb"]), 0);
    assert_eq!(
        scalar("split_text b2 b0 b1 type1\n size r0 b2", ["a,b,,c", ","]),
        4
    );
    let third = "split_text b2 b0 b1 type1\n int r0 3\n list_get b2 r0 r0 b0";
    assert_eq!(text(third, 0, ["a,b,,c", ","]), Ok("c".into()));
    assert_eq!(
        scalar("split_text b2 b0 b1 type1\n size r0 b2", ["abc", ""]),
        1
    );
}
