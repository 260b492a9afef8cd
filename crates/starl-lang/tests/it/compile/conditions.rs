//! `and`, `or`, `not`, conditionals and `if`.

use starl_lang::machine::Fault;

use super::support::{effect, faults, values};

const DECLARATIONS: &str = "t: Bool = true\nf: Bool = false\na: Int = 1\nz: Int = 0\no: Int?";

#[test]
fn every_combination() {
    let mut rows = Vec::new();
    for bits in 0..8 {
        let [p, q, r] = [1, 2, 4].map(|bit| bits & bit != 0);
        let [a, b, c] = [p, q, r].map(|value| if value { "t" } else { "f" });
        for (text, value) in [
            (format!("{a} and {b} or {c}"), p && q || r),
            (format!("{a} and ({b} or {c})"), p && (q || r)),
            (format!("({a} or {b}) and not {c}"), (p || q) && !r),
            (format!("not ({a} and {b}) or {c}"), !(p && q) || r),
            (format!("not ({a} or not ({b} and {c}))"), !(p || !(q && r))),
            (format!("if {a} then {b} else {c}"), if p { q } else { r }),
            (
                format!("not (if {a} then not {b} else {c} and {b})"),
                !(if p { !q } else { r && q }),
            ),
            (format!("({a} == {b}) != {c}"), (p == q) != r),
        ] {
            rows.push((text, value.to_string()));
        }
    }
    let rows: Vec<_> = rows
        .iter()
        .map(|(text, value)| (&text[..], &value[..]))
        .collect();
    values(DECLARATIONS, &rows);
    let lines: Vec<String> = rows
        .iter()
        .map(|(text, _)| format!("if {text}\n    log(\"true\")\nelse\n    log(\"false\")"))
        .collect();
    let told = effect(DECLARATIONS, &lines.join("\n")).unwrap();
    for ((text, value), told) in rows.iter().zip(&told) {
        assert_eq!(*told, format!("log(\"{value}\")"), "{text}");
    }
}

#[test]
fn undecisive_operands_are_not_computed() {
    values(
        DECLARATIONS,
        &[
            ("f and a / z == 0", "false"),
            ("t or a / z == 0", "true"),
            ("if t then a else a / z", "1"),
            ("if f then a / z else 2", "2"),
            ("o ?? a", "1"),
            ("(if z != 0 then a / z else 0) == 0", "true"),
        ],
    );
    let rows = [
        ("log(\"{}\", t and a / z == 0)", 1, Fault::DivisionByZero),
        ("log(\"{}\", f or a / z == 0)", 1, Fault::DivisionByZero),
        (
            "if t and\n        a / z == 0\n    log(\"\")",
            2,
            Fault::DivisionByZero,
        ),
    ];
    faults(DECLARATIONS, &rows);
}

#[test]
fn conditionals_of_every_kind_of_value() {
    values(
        "record R {a: Int, s: String}\nt: Bool = true\nlist: List[Int] = [1]\nr: R = R(1, \"x\")\nn: Int?",
        &[
            ("if t then 1.5 else 2.5", "1.5"),
            ("if not t then \"a\" else \"b\"", "b"),
            ("if t then list else [2]", "[1]"),
            ("if t then r else R(2, \"y\")", "(a = 1, s = \"x\")"),
            ("(if not t then r else R(2, \"y\")).s", "y"),
            (
                "if t then Point(1.0, 2.0) else Point(0.0, 0.0)",
                "(1.0, 2.0, 0.0)",
            ),
            ("if t then n else 1", "none"),
            ("if not t then n else 1", "1"),
            ("if t then if not t then 1 else 2 else 3", "2"),
        ],
    );
}

#[test]
fn chains() {
    let body = "for i in 0..5\n    if i == 0\n        log(\"zero\")\n    elif i == 1\n        log(\"one\")\n    elif i < 3\n        log(\"two\")\n    else\n        log(\"many\")";
    let told = effect("", body).unwrap();
    let expected = ["zero", "one", "two", "many", "many"].map(|word| format!("log(\"{word}\")"));
    assert_eq!(told, expected);
}

#[test]
fn a_condition_that_is_known() {
    let body = "if 1 == 1\n    log(\"a\")\nif true and z == 0 then log(\"b\") else log(\"c\")\nif false or z == 1 then log(\"d\") else log(\"e\")";
    let told = effect(DECLARATIONS, body).unwrap();
    assert_eq!(told, ["log(\"a\")", "log(\"b\")", "log(\"e\")"]);
}

#[test]
fn quantifiers_over_collections() {
    let declarations =
        "xs: List[Int] = [1, 2, 3]\nempty: Set[Int]\nm: Map[String, Int] = {\"a\": 1, \"b\": 2}";
    values(
        declarations,
        &[
            ("forall x in xs: x > 0", "true"),
            ("forall x in xs: x > 1", "false"),
            ("exists x in xs: x == 2", "true"),
            ("exists x in xs: x > 3", "false"),
            ("forall x in empty: false", "true"),
            ("exists x in empty: true", "false"),
            ("forall i in 0..3: xs[i] == i + 1", "true"),
            (
                "exists key, value in m: key == \"b\" and value == 2",
                "true",
            ),
            ("forall key in m: m[key] < 2", "false"),
            ("not (exists x in xs: x > 3) and xs.size() == 3", "true"),
            (
                "xs == [] or forall x in xs: exists y in xs: x + y == 4",
                "true",
            ),
            ("if exists x in xs: x == 3 then 1 else 2", "1"),
            ("[x for x in xs if forall y in xs: y <= x]", "[3]"),
        ],
    );
}

#[test]
fn a_quantifier_stops_at_the_element_that_decides() {
    values(
        "xs: List[Int] = [1, 0, 2]",
        &[
            ("exists x in xs: 2 / x == 2", "true"),
            ("forall x in xs: 2 / x == 1", "false"),
        ],
    );
}

#[test]
fn some_stands_anywhere_in_an_expression() {
    let declarations = "t: Bool = true\nf: Bool = false\no: Int? = 3\nn: Int?";
    values(
        declarations,
        &[
            ("some x = o and x > 2", "true"),
            ("some x = o and x > 3", "false"),
            ("some x = n and x > 2", "false"),
            ("f or some x = o and x == 3", "true"),
            ("some x = n and x > 0 or some x = o and x == 3", "true"),
            ("(some x = n and x > 0) or t", "true"),
            ("not (some x = o and x > 3)", "true"),
            ("not (some x = n)", "true"),
            ("(some x = o and x > 2) == (some y = o and y < 9)", "true"),
            ("[some x = o and x == y for y in [2, 3]]", "[false, true]"),
            ("exists y in [2, 3]: some x = o and x == y", "true"),
        ],
    );
    let body = "let is_large = some x = o and x > 2\nif is_large or some x = n and x > 1 then log(\"yes\")";
    assert_eq!(effect(declarations, body).unwrap(), ["log(\"yes\")"]);
}
