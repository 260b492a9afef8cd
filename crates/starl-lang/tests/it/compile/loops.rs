//! `for` over every kind of collection.

use super::support::effect;

const DECLARATIONS: &str = "
a: List[Int] = [3, 1, 2]
e: List[Int]
n: List[List[Int]] = [[1], [2, 3]]
s: Set[String] = {\"y\", \"x\"}
m: Map[Int, String] = {2: \"b\", 1: \"a\"}
k: Int = 3";

fn told(body: &str) -> Vec<String> {
    let told = effect(DECLARATIONS, body).unwrap();
    let text = |line: &String| line["log(\"".len()..line.len() - 2].to_string();
    told.iter().map(text).collect()
}

#[test]
fn over_collections() {
    assert_eq!(told("for x in a\n    log(\"{}\", x)"), ["3", "1", "2"]);
    assert_eq!(told("for x in e\n    log(\"{}\", x)"), [""; 0]);
    assert_eq!(told("for x in s\n    log(x)"), ["x", "y"]);
    assert_eq!(told("for k_ in m\n    log(\"{}\", k_)"), ["1", "2"]);
    assert_eq!(
        told("for k_, v in m\n    log(\"{}{}\", k_, v)"),
        ["1a", "2b"]
    );
    assert_eq!(told("for _, v in m\n    log(v)"), ["a", "b"]);
    assert_eq!(told("for k_, _ in m\n    log(\"{}\", k_)"), ["1", "2"]);
    assert_eq!(told("for _ in m\n    log(\"m\")"), ["m", "m"]);
    assert_eq!(told("for _ in a\n    log(\"a\")"), ["a", "a", "a"]);
    assert_eq!(
        told("for l in n\n    for x in l\n        log(\"{}\", x)"),
        ["1", "2", "3"]
    );
    assert_eq!(
        told("for x in [1, 2] + a.sorted()\n    log(\"{}\", x)"),
        ["1", "2", "1", "2", "3"]
    );
    assert_eq!(
        told("for x in way_points()\n    log(\"{}\", x.x)"),
        ["1.0", "2.0", "4.0"]
    );
}

#[test]
fn over_ranges() {
    assert_eq!(told("for i in 0..3\n    log(\"{}\", i)"), ["0", "1", "2"]);
    assert_eq!(told("for i in 1..k\n    log(\"{}\", i)"), ["1", "2"]);
    assert_eq!(told("for i in k..k\n    log(\"{}\", i)"), [""; 0]);
    assert_eq!(told("for i in k..0\n    log(\"{}\", i)"), [""; 0]);
    assert_eq!(told("for i in 3..3\n    log(\"{}\", i)"), [""; 0]);
    assert_eq!(told("for _ in 0..2\n    log(\"x\")"), ["x", "x"]);
    assert_eq!(told("for i in -2..0\n    log(\"{}\", i)"), ["-2", "-1"]);
    let end = "for i in 9223372036854775805..9223372036854775807\n    log(\"{}\", i % 10)";
    assert_eq!(told(end), ["5", "6"]);
    assert_eq!(
        told("for i in 0..2\n    for j in i..2\n        log(\"{}{}\", i, j)"),
        ["00", "01", "11"]
    );
}

#[test]
fn a_loop_iterates_over_the_original_collection() {
    assert_eq!(
        told("for x in a\n    a.add(x * 2)\nlog(\"{}\", a)"),
        ["[3, 1, 2, 6, 2, 4]"]
    );
    assert_eq!(
        told("for x in a\n    a = []\n    log(\"{}\", x)"),
        ["3", "1", "2"]
    );
    assert_eq!(
        told("let l = a\nfor x in l\n    l.remove(x)\nlog(\"{}\", l)"),
        ["[]"]
    );
    assert_eq!(
        told("for k_, v in m\n    m[k_ + 10] = v\nlog(\"{}\", m.size())"),
        ["4"]
    );
    assert_eq!(
        told("for k_ in m\n    m.remove(k_)\nlog(\"{}\", m.size())"),
        ["0"]
    );
    assert_eq!(
        told("let n_ = 2\nfor i in 0..n_\n    n_ += 5\n    log(\"{}\", n_)"),
        ["7", "12"]
    );
    assert_eq!(
        told("for i in 0..k\n    k = 0\n    log(\"{}\", i)"),
        ["0", "1", "2"]
    );
    assert_eq!(
        told("for l in n\n    l.size()\n    n[0].add(9)\nlog(\"{}\", n[0].size())"),
        ["3"]
    );
}

#[test]
fn leaving_early() {
    assert_eq!(
        told("for x in a\n    if x == 1\n        return\n    log(\"{}\", x)\nlog(\"end\")"),
        ["3"]
    );
}

#[test]
fn locals_are_initialized_in_each_iteration() {
    let body = "for x in a\n    let l: List[Int] = []\n    l.add(x)\n    let c = 0\n    c += 1\n    log(\"{} {}\", l, c)";
    assert_eq!(told(body), ["[3] 1", "[1] 1", "[2] 1"]);
}
