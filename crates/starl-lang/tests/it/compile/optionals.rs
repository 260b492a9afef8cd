//! Optionals: `none`, `!`, `??`, `some x = ...`.

use starl_lang::machine::Fault;

use super::support::{effect, faults, values};

const DECLARATIONS: &str = "
record Place {at: Point?, name: String?}
o: Int? = 5
n: Int?
p: Point? = Point(1.0, 2.0)
s: String? = \"x\"
u: String?
l: List[Int]? = [1, 2]
r: Place?
q: Place = Place(Point(1.0, 1.0), none)
many: List[Int?] = [1, none]
map: Map[Int, Int?] = {1: 2, 3: none}";

#[test]
fn reading() {
    values(
        DECLARATIONS,
        &[
            ("o", "5"),
            ("n", "none"),
            ("o!", "5"),
            ("o! + 1", "6"),
            ("p!.y", "2.0"),
            ("p!", "(1.0, 2.0, 0.0)"),
            ("s!", "x"),
            ("s! + \"y\"", "xy"),
            ("s", "x"),
            ("u", "none"),
            ("l!.size()", "2"),
            ("l![1]", "2"),
            ("q.at!.x", "1.0"),
            ("q.name", "none"),
            ("q.name ?? \"unnamed\"", "unnamed"),
            ("o ?? 1", "5"),
            ("n ?? 1", "1"),
            ("n ?? o", "5"),
            ("n ?? o ?? 1", "5"),
            ("n ?? n ?? 1", "1"),
            ("n ?? none", "none"),
            ("(n ?? 1) + (o ?? 2)", "6"),
            ("p ?? Point(0.0, 0.0)", "(1.0, 2.0, 0.0)"),
            ("u ?? \"none\"", "none"),
            ("l ?? []", "[1, 2]"),
            ("r == none", "true"),
            ("r ?? q", "(at = (1.0, 1.0, 0.0), name = none)"),
            ("[1, 2].first()", "1"),
            ("[1, 2].first()! + 1", "2"),
            ("[1, 2].index_of(3) ?? -1", "-1"),
            ("[1, 2].index_of(2)!", "1"),
            ("many.first()", "1"),
            ("many.last()", "none"),
            ("many[1] ?? 7", "7"),
            ("map.get(1)", "2"),
            ("map.get(1)!", "2"),
            ("map.get(2)", "none"),
            ("map.get(3)", "none"),
            ("map[3]", "none"),
            ("map[1] ?? 0", "2"),
            ("many == [1, none]", "true"),
            ("none in many", "true"),
            ("o in many", "false"),
        ],
    );
}

#[test]
fn none_has_no_value() {
    faults(
        DECLARATIONS,
        &[
            ("log(\"{}\", n!)", 1, Fault::NoneUnwrapped),
            ("p = none\n\nlog(\"{}\", p!.x)", 3, Fault::NoneUnwrapped),
            ("log(\"{}\", [1].index_of(2)!)", 1, Fault::NoneUnwrapped),
            (
                "let c = n\nlet d = c! + 1\nlog(\"{}\", d)",
                2,
                Fault::NoneUnwrapped,
            ),
            ("log(\"{}\", r!.at!.x)", 1, Fault::NoneUnwrapped),
        ],
    );
}

#[test]
fn bindings() {
    let body = "
if some a = o
    log(\"{}\", a + 1)
if some a = n
    log(\"{}\", a)
else
    log(\"none\")
if some a = p and a.x < 0.0
    log(\"left\")
elif some b = s and some c = l and c.size() == 2
    log(\"{} {}\", b, c)
if some a = [3, 4].last() and some i = [3, 4].index_of(a) and i == 1 then log(\"{} {}\", a, i)
log(\"{}\", if some a = o and a > 4 then a * 2 else 0)
log(\"{}\", if some a = n then a else -1)
log(\"{}\", [a for x in many if some a = x])
let copy = o
if some a = copy
    copy = none
    log(\"{} {}\", a, copy)
if some at = q.at
    q.at = none
    log(\"{} {}\", at, q.at)
if some a = u then log(a)";
    let told = effect(DECLARATIONS, body.trim()).unwrap();
    let expected = [
        "6",
        "none",
        "x [1, 2]",
        "4 1",
        "10",
        "-1",
        "[1]",
        "5 none",
        "(1.0, 1.0, 0.0) none",
    ];
    assert_eq!(told, expected.map(|text| format!("log({text:?})")));
}

#[test]
fn writing() {
    let body = "
n = 4
o = none
p = q.at
q.name = \"here\"
many.add(none)
many[0] = none
many[1] = 9
map[3] = 5
map[1] = none
log(\"{} {} {} {} {} {}\", n, o, p, q, many, map)
n = n ?? 0
let same = n
n = same
log(\"{}\", n)";
    let told = effect(DECLARATIONS, body.trim()).unwrap();
    let first = "4 none (1.0, 1.0, 0.0) (at = (1.0, 1.0, 0.0), name = \"here\") [none, 9, none] {1: none, 3: 5}";
    assert_eq!(told, [format!("log({first:?})"), "log(\"4\")".into()]);
}
