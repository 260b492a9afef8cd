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
