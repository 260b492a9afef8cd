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
        ],
    );
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
