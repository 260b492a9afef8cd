//! Records and enums: values, fields, and records within collections.

use super::support::{effect, values};

const DECLARATIONS: &str = "
enum Colour {red, green}
record Inner {s: String, at: Point, tags: Set[String]}
record Outer {n: Int, inner: Inner, flag: Bool, colour: Colour}
record Empty {}
a: Outer = Outer(1, Inner(\"x\", Point(1.0, 2.0), {\"t\"}), true, green)
list: List[Outer] = [a, a]
map: Map[String, Inner] = {\"k\": a.inner}
e: Empty
zero: Outer";

#[test]
fn reading() {
    values(
        DECLARATIONS,
        &[
            ("a.n", "1"),
            ("a.inner.s", "x"),
            ("a.inner.at.y", "2.0"),
            ("a.inner.tags", "{\"t\"}"),
            ("a.flag and a.colour == green", "true"),
            ("a.colour", "green"),
            (
                "a.inner",
                "(s = \"x\", at = (1.0, 2.0, 0.0), tags = {\"t\"})",
            ),
            ("list[1].inner.s", "x"),
            ("list[1].inner.at.x", "1.0"),
            ("list[0].inner == a.inner", "true"),
            ("map[\"k\"].at", "(1.0, 2.0, 0.0)"),
            (
                "Outer(n = 2, flag = false, inner = a.inner, colour = red).n",
                "2",
            ),
            ("Outer(2, a.inner, false, red).inner.s", "x"),
            (
                "Inner(\"q\\\"\", a.inner.at, {})",
                "(s = \"q\\\\\"\", at = (1.0, 2.0, 0.0), tags = {})",
            ),
            ("e", "()"),
            ("e == Empty()", "true"),
            ("[Empty(), e]", "[(), ()]"),
            (
                "zero",
                "(n = 0, inner = (s = \"\", at = (0.0, 0.0, 0.0), tags = {}), flag = false, colour = red)",
            ),
            ("Colour.red", "red"),
            ("[red, green]", "[red, green]"),
        ],
    );
}

#[test]
fn fields_can_be_changed() {
    let body = "
let b = a
b.n += 5
b.inner.s = b.inner.s + \"y\"
b.inner.at.x = 9.0
b.inner.tags.add(\"u\")
a.inner.tags.remove(\"t\")
a.inner = Inner(\"z\", a.inner.at, a.inner.tags)
list[1].inner.tags.add(\"v\")
list[0].n *= 7
list[0].inner.at.z = 1.0
map[\"k\"].s += \"!\"
map[\"l\"] = a.inner
log(\"{}\", b)
log(\"{}\", a)
log(\"{}\", list[0])
log(\"{}\", list[1].inner)
log(\"{}\", map)
list[0] = b
log(\"{}\", list[0] == b)";
    let told = effect(DECLARATIONS, body.trim()).unwrap();
    let expected = [
        "(n = 6, inner = (s = \"xy\", at = (9.0, 2.0, 0.0), tags = {\"t\", \"u\"}), flag = true, colour = green)",
        "(n = 1, inner = (s = \"z\", at = (1.0, 2.0, 0.0), tags = {}), flag = true, colour = green)",
        "(n = 7, inner = (s = \"x\", at = (1.0, 2.0, 1.0), tags = {\"t\"}), flag = true, colour = green)",
        "(s = \"x\", at = (1.0, 2.0, 0.0), tags = {\"t\", \"v\"})",
        "{\"k\": (s = \"x!\", at = (1.0, 2.0, 0.0), tags = {\"t\"}), \"l\": (s = \"z\", at = (1.0, 2.0, 0.0), tags = {})}",
        "true",
    ];
    assert_eq!(told, expected.map(|text| format!("log({text:?})")));
}

#[test]
fn a_record_made_of_its_own_fields() {
    let body = "
let p = Pair(1, 2)
p = Pair(p.b, p.a)
pair = Pair(pair.b, pair.a)
p.a = p.b + p.a
log(\"{} {}\", p, pair)";
    let told = effect(
        "record Pair {a: Int, b: Int}\npair: Pair = Pair(3, 4)",
        body.trim(),
    )
    .unwrap();
    assert_eq!(told, ["log(\"(a = 3, b = 1) (a = 4, b = 3)\")"]);
}

#[test]
fn records_as_keys() {
    values(
        "record Cell {x: Int, name: String}\ncells: Set[Cell] = {Cell(2, \"a\"), Cell(1, \"b\"), Cell(1, \"a\")}\ncount: Map[Cell, Int] = {Cell(1, \"b\"): 5}",
        &[
            ("[c.x for c in cells]", "[1, 1, 2]"),
            ("Cell(1, \"a\") in cells", "true"),
            ("count[Cell(1, \"b\")]", "5"),
            ("count.get(Cell(1, \"c\")) ?? 0", "0"),
        ],
    );
}
