//! Comprehensions of lists, sets and maps.

use super::support::{effect, values};

#[test]
fn from_every_kind_of_collection() {
    values(
        "
a: List[Int] = [3, 1, 2]
s: Set[String] = {\"y\", \"x\"}
m: Map[Int, String] = {2: \"b\", 1: \"a\"}
o: List[Int?] = [1, none, 3]
k: Int = 2",
        &[
            ("[x * 2 for x in a]", "[6, 2, 4]"),
            ("[x for x in a if x > 1]", "[3, 2]"),
            ("[x for x in a if x > k and x < 9]", "[3]"),
            ("[t + t for t in s]", "[\"xx\", \"yy\"]"),
            ("[i * i for i in 0..4]", "[0, 1, 4, 9]"),
            ("[i for i in 0..0]", "[]"),
            ("[key for key in m]", "[1, 2]"),
            ("[v for _, v in m]", "[\"a\", \"b\"]"),
            ("[String(i) + v for i, v in m]", "[\"1a\", \"2b\"]"),
            ("[y for x in o if some y = x]", "[1, 3]"),
            ("{x % 2 for x in a}", "{0, 1}"),
            ("{x: x * x for x in a}", "{1: 1, 2: 4, 3: 9}"),
            ("{v: i for i, v in m}", "{\"a\": 1, \"b\": 2}"),
            ("{x % 2: x for x in a}", "{0: 2, 1: 1}"),
        ],
    );
}

#[test]
fn nested() {
    values(
        "n: List[List[Int]] = [[1], [2, 3]]",
        &[
            ("[[x + 1 for x in l] for l in n]", "[[2], [3, 4]]"),
            ("[[i + j for j in 0..i] for i in 0..3]", "[[], [1], [2, 3]]"),
            ("[l.sum() for l in [[x, x] for x in 0..3]]", "[0, 2, 4]"),
        ],
    );
}

#[test]
fn of_the_variable_itself() {
    let body = "a = [x + a.size() for x in a if x in a]\nlet l = a\nl = [x for x in l + l]\nlog(\"{} {}\", a, l)";
    let told = effect("a: List[Int] = [1, 2]", body).unwrap();
    assert_eq!(told, ["log(\"[3, 4] [3, 4, 3, 4]\")"]);
}

#[test]
fn sorted_by_a_key() {
    values(
        "
a: List[Int] = [3, 1, 2, 11]
s: Set[String] = {\"ab\", \"c\"}
m: Map[Int, Float] = {1: 0.5, 2: 0.25, 3: 0.5}
p: List[Point] = [Point(3.0, 0.0), Point(1.0, 0.0)]
o: List[Int?] = [5, none, 3]",
        &[
            ("[x for x in a by -x]", "[11, 3, 2, 1]"),
            ("[x for x in a if x < 10 by x % 2]", "[2, 3, 1]"),
            ("[x * 2 for x in a by String(x)]", "[2, 22, 4, 6]"),
            ("[t for t in s by t.size()]", "[\"c\", \"ab\"]"),
            ("[k for k, v in m by v]", "[2, 1, 3]"),
            ("[k for k, v in m by -v].first()", "1"),
            (
                "[q.x for q in p by distance(q, Point(0.0, 0.0))]",
                "[1.0, 3.0]",
            ),
            ("[y for x in o if some y = x by y]", "[3, 5]"),
            (
                "[[y for y in 0..x by -y] for x in 1..4 by -x]",
                "[[2, 1, 0], [1, 0], [0]]",
            ),
            ("[x for x in a by Float(x) * 0.0 / 0.0]", "[3, 1, 2, 11]"),
            ("[x for x in a if false by x]", "[]"),
        ],
    );
}

#[test]
fn by_is_no_reserved_word() {
    let body = "let by = [3, 1]\nby = [x for x in by by x + by[0]]\nlog(\"{}\", by)";
    assert_eq!(effect("", body).unwrap(), ["log(\"[1, 3]\")"]);
}

#[test]
fn the_best_element() {
    values(
        "bids: Map[Int, Float] = {1: 2.5, 2: 0.5, 3: 0.5, 4: 2.5}
nan: Float = 0.0 / 0.0
texts: List[String] = [\"b\", \"ab\", \"a\", \"ab\"]
nothing: List[Int]",
        &[
            ("min(n for n in [3, 1, 2])", "1"),
            ("max(n * n for n in -3..3)", "9"),
            ("min(n for n in nothing)", "none"),
            ("max(n for n in [1, 2] if n > 2) ?? 7", "7"),
            ("min(r for r, bid in bids by bid)", "2"),
            ("max(r for r, bid in bids by bid)", "1"),
            ("max(r for r, bid in bids by (bid, r))", "4"),
            ("min(r for r in bids by (-bids[r], -r))", "4"),
            ("min((bid, r) for r, bid in bids)", "(0.5, 2)"),
            (
                "max((bid, String(r)) for r, bid in bids if r < 4)",
                "(2.5, \"1\")",
            ),
            ("min(t for t in texts)", "a"),
            ("max(t for t in texts by t.size())", "ab"),
            ("min(t + \"!\" for t in texts by (t.size(), t))", "a!"),
            ("min([t] for t in texts by t)", "[\"a\"]"),
            ("min(x for x in [nan, 2.0, 1.0])", "1.0"),
            ("max(x for x in [1.0, -nan])", "1.0"),
            ("[x for x in [nan, 2.0] by x].first()", "2.0"),
            ("min(o for o in [bids.get(9), bids.get(1)] by 1)", "none"),
            ("min(o for o in [bids.get(1), bids.get(9)] by 1)", "2.5"),
            ("min(min(n, 2) for n in [3, 4])", "2"),
            (
                "min(m for m in [min(n for n in [k, 5]) ?? 0 for k in [8, 3]])",
                "3",
            ),
            ("max(n for (n, _) in [(1, 9), (2, 0)])", "2"),
        ],
    );
}
