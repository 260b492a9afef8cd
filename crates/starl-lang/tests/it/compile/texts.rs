//! Texts: operators, methods, and the text of every kind of value.

use super::support::{effect, values};

const DECLARATIONS: &str = "
enum Colour {red, green}
s: String = \"caf\\u{e9}\"
t: String
o: Colour? = green";

#[test]
fn operators_and_methods() {
    values(
        DECLARATIONS,
        &[
            ("s", "caf\u{e9}"),
            ("s + \"!\"", "caf\u{e9}!"),
            ("t + s + t + s", "caf\u{e9}caf\u{e9}"),
            ("\"a\" + \"b\" + String(1)", "ab1"),
            ("s.size()", "4"),
            ("t.size()", "0"),
            ("s.contains(\"af\")", "true"),
            ("s.contains(t)", "true"),
            ("s.contains(\"x\")", "false"),
            ("\"a,b,\".split(\",\")", "[\"a\", \"b\", \"\"]"),
            ("s.split(\"\")", "[\"caf\u{e9}\"]"),
            ("\"1 2\".split(\" \")[1]", "2"),
            ("s.upper()", "CAF\u{c9}"),
            ("s.upper().lower()", "caf\u{e9}"),
            ("\"stra\u{df}e\".upper()", "STRASSE"),
            ("t.lower()", ""),
            ("\" a b\\n\".trim()", "a b"),
            ("s.starts_with(\"ca\")", "true"),
            ("s.starts_with(\"af\")", "false"),
            ("s.starts_with(t)", "true"),
            ("s.ends_with(\"\u{e9}\")", "true"),
            ("t.ends_with(s)", "false"),
            ("\"a-b-c\".replace(\"-\", \", \")", "a, b, c"),
            ("\"aaa\".replace(\"aa\", \"b\")", "ba"),
            ("s.replace(\"\", \"x\")", "caf\u{e9}"),
            ("s.replace(s, s + s)", "caf\u{e9}caf\u{e9}"),
            ("[\"a\", \"\", s].join(\"/\")", "a//caf\u{e9}"),
            ("[s].join(s)", "caf\u{e9}"),
            ("\"a b\".split(\" \").join(t)", "ab"),
        ],
    );
}

#[test]
fn numbers_are_read_from_texts() {
    values(
        DECLARATIONS,
        &[
            ("\"12\".to_int()", "12"),
            ("\"-9223372036854775808\".to_int()", "-9223372036854775808"),
            ("\"9223372036854775808\".to_int()", "none"),
            ("\" 12 \".to_int()", "none"),
            ("\" 12 \".trim().to_int() ?? 0", "12"),
            ("\"1.5\".to_int()", "none"),
            ("\"1_000\".to_int()", "none"),
            ("t.to_int()", "none"),
            ("\"2\".to_float()", "2.0"),
            ("\"-1.5e-3\".to_float()", "-0.0015"),
            ("\"1e999\".to_float()", "none"),
            ("\"NaN\".to_float()", "none"),
            ("\"inf\".to_float()", "none"),
            ("s.to_float()", "none"),
            ("String(12).to_int()", "12"),
        ],
    );
}

/// A text of a megabyte and more is an error before it is made.
#[test]
fn a_text_that_would_be_too_long_is_not_made() {
    let double = "let u = \"aaaaaaaa\"\nfor i in 0..14\n    u += u\n";
    for grow in ["u.replace(\"a\", u)", "[u for i in 0..20].join(u)"] {
        let body = format!("{double}log(\"{{}}\", {grow}.size())");
        let fault = effect("s: String = \"a\"", &body).unwrap_err();
        assert!(format!("{fault:?}").contains("OutOfMemory"), "{fault:?}");
    }
}

#[test]
fn text_of_every_type() {
    values(
        DECLARATIONS,
        &[
            ("String(true)", "true"),
            ("String(1 == 2)", "false"),
            ("String(-5)", "-5"),
            ("String(0.1)", "0.1"),
            ("String(1e300)", "1e300"),
            ("String(2s)", "2s"),
            ("String(now)", "1.500s"),
            ("String(me)", "robot1"),
            ("String(position)", "(1.0, 2.0, 3.0)"),
            ("String(Colour.red)", "red"),
            ("String(o)", "green"),
            ("String(s)", "caf\u{e9}"),
            ("String(s + s)", "caf\u{e9}caf\u{e9}"),
            ("String([\"a\", \"b\"])", "[\"a\", \"b\"]"),
            ("String({1: [0.5]})", "{1: [0.5]}"),
            ("String(peers)", "{robot0, robot1, robot2}"),
            ("String([o, none])", "[green, none]"),
            ("String(String(1).size())", "1"),
        ],
    );
}

#[test]
fn texts_grow() {
    let body = "
s += \"1\"
s = s + \"2\"
s += s
let u = s
u += \"3\"
u = u + u
log(\"{} {}\", s, u)";
    let told = effect("s: String = \"a\"", body.trim()).unwrap();
    assert_eq!(told, ["log(\"a12a12 a12a123a12a123\")"]);
}

#[test]
fn a_text_grows_by_what_it_was_before() {
    let body = "
let u = \"a\"
u += \"<\" + u + String(u) + String(o) + \">\"
let p = Named(\"n\", 1)
p.name += String(p) + p.name
let l = [1]
l += [2] + l + [3]
s += \"-\" + s + String(s.size())
log(\"{} {} {} {}\", u, p.name, l, s)";
    let declarations = "record Named {name: String, size: Int}\no: Int? = 7\ns: String = \"s\"";
    let told = effect(declarations, body.trim()).unwrap();
    assert_eq!(
        told,
        ["log(\"a<aa7> n(name = \\\"n\\\", size = 1)n [1, 2, 1, 3] s-s1\")"]
    );
}
