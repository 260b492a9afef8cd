//! The output of `log` and `emit`.

use super::support::effect;

#[test]
fn each_placeholder_shows_the_next_value() {
    let told = effect(
        "s: String = \"x\"",
        "log(\"a\")\nlog(\"{}\", 1)\nlog(\"{}{}\", 1, s)\nlog(\"<{}> and {}.\", s, [s])\nlog(\"\")\nlog(s)\nlog(s + s)",
    );
    assert_eq!(
        told.unwrap(),
        [
            "log(\"a\")",
            "log(\"1\")",
            "log(\"1x\")",
            "log(\"<x> and [\\\"x\\\"].\")",
            "log(\"\")",
            "log(\"x\")",
            "log(\"xx\")",
        ]
    );
}

#[test]
fn places_and_values_that_do_not_match() {
    // The checker warns of them; values are computed too.
    let told = effect(
        "",
        "log(\"{} {}\", 1)\nlog(\"{}\", 1, random_int(0, 9))\nlog(\"none\", 1)",
    );
    assert_eq!(
        told.unwrap(),
        [
            "log(\"1 {}\")",
            "random_int(0, 9)",
            "log(\"1\")",
            "log(\"none\")",
        ]
    );
}

#[test]
fn a_format_that_is_not_a_literal() {
    let body = "log(f, 1, \"b\")\nlog(f + f, 1, \"b\", 2.5)\nlog(\"{}\" + f, s)\nlog(s, 1)\nlog(f + f + f, s)";
    let told = effect("f: String = \"<{}|{}>\"\ns: String = \"t\"", body).unwrap();
    assert_eq!(
        told,
        [
            "log(\"<1|b>\")",
            "log(\"<1|b><2.5|{}>\")",
            "log(\"t<{}|{}>\")",
            "log(\"t\")",
            "log(\"<t|{}><{}|{}><{}|{}>\")",
        ]
    );
}

#[test]
fn events_with_fields_of_any_type() {
    let told = effect(
        "record R {a: Int, s: String}\nr: R = R(1, \"x\")\nname: String = \"moved\"",
        "emit(\"done\")\nemit(\"at\", where = position, what = r, who = [me])\nemit(name + \"!\", n = 1 + 1)",
    );
    assert_eq!(
        told.unwrap(),
        [
            "emit(\"done\")",
            "emit(\"at\", (1.0, 2.0, 3.0), (a = 1, s = \"x\"), [robot1]) where what who",
            "emit(\"moved!\", 2) n",
        ]
    );
}
