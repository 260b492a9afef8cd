//! Lists: literals, elements, methods.

use starl_lang::machine::Fault;

use super::support::{effect, faults, values};

const DECLARATIONS: &str = "
a: List[Int] = [3, 1, 2]
e: List[Int]
x: List[Float] = [0.5, 1.5]
s: List[String] = [\"b\", \"a\"]
n: List[List[Int]] = [[1], [2, 3]]
i: Int = 1";

#[test]
fn reading() {
    values(
        DECLARATIONS,
        &[
            ("a", "[3, 1, 2]"),
            ("[1, i, i + 1]", "[1, 1, 2]"),
            ("a[0]", "3"),
            ("a[i]", "1"),
            ("a[a[i]]", "1"),
            ("a[a.size() - 1]", "2"),
            ("[5, 6][i]", "6"),
            ("n[1][0]", "2"),
            ("n[i][i]", "3"),
            ("n[1]", "[2, 3]"),
            ("s[1] + s[0]", "ab"),
            ("a.size()", "3"),
            ("e.size()", "0"),
            ("[1, 2].size() + n.size()", "4"),
            ("a.contains(2)", "true"),
            ("a.contains(4)", "false"),
            ("s.contains(\"a\")", "true"),
            ("n.contains([1])", "true"),
            ("a.first()", "3"),
            ("a.last()", "2"),
            ("e.first()", "none"),
            ("e.last()", "none"),
            ("s.last()", "a"),
            ("n.last()! + [4]", "[2, 3, 4]"),
            ("a.index_of(2)", "2"),
            ("a.index_of(9)", "none"),
            ("a.reversed()", "[2, 1, 3]"),
            ("a.sorted()", "[1, 2, 3]"),
            ("s.sorted()", "[\"a\", \"b\"]"),
            ("a.sorted().reversed()", "[3, 2, 1]"),
            ("a", "[3, 1, 2]"),
            ("a.slice(0, 2)", "[3, 1]"),
            ("a.slice(i, i)", "[]"),
            ("a.slice(1, a.size())", "[1, 2]"),
            ("a.sum()", "6"),
            ("e.sum()", "0"),
            ("x.sum()", "2.0"),
            ("a + [4]", "[3, 1, 2, 4]"),
            ("e + a + a", "[3, 1, 2, 3, 1, 2]"),
            ("a + a == a", "false"),
            ("way_points()[1].x", "2.0"),
        ],
    );
}

#[test]
fn changing() {
    let body = "
a.add(9)
a.insert(0, 8)
a.insert(a.size(), 7)
a.remove_at(1)
a.remove(1)
a.remove(100)
a[0] = a[1] + 1
a[i] += 10
log(\"{}\", a)
n[0].add(5)
n[1][0] = 6
n.add([7])
n[1].remove(3)
n[2] = n[0] + n[1]
log(\"{}\", n)
s.add(s[0] + \"c\")
s[0] += \"d\"
log(\"{}\", s)
let l = a
l.add(1)
l = l + l
log(\"{} {}\", l, a)
e = a
e += e
e += [0]
log(\"{} {}\", e, a)";
    let told = effect(DECLARATIONS, body.trim()).unwrap();
    let expected = [
        "[3, 12, 9, 7]",
        "[[1, 5], [6], [1, 5, 6]]",
        "[\"bd\", \"a\", \"bc\"]",
        "[3, 12, 9, 7, 1, 3, 12, 9, 7, 1] [3, 12, 9, 7]",
        "[3, 12, 9, 7, 3, 12, 9, 7, 0] [3, 12, 9, 7]",
    ];
    assert_eq!(told, expected.map(|text| format!("log({text:?})")));
}

#[test]
fn outside_of_the_list() {
    let out = |index, length| Fault::IndexOutOfRange { index, length };
    faults(
        DECLARATIONS,
        &[
            ("log(\"{}\", a[3])", 1, out(3, 3)),
            ("log(\"{}\", a[-1])", 1, out(-1, 3)),
            ("log(\"{}\", e[0])", 1, out(0, 0)),
            ("i = 2\na[i + 1] = 0", 2, out(3, 3)),
            ("a[3] += 1", 1, out(3, 3)),
            ("a.insert(4, 0)", 1, out(4, 3)),
            ("a.remove_at(3)", 1, out(3, 3)),
            ("n[0][1] = 0", 1, out(1, 1)),
            ("n[2].add(1)", 1, out(2, 2)),
            ("log(\"{}\", a.slice(0, 4))", 1, out(4, 3)),
            ("log(\"{}\", a.slice(2, 1))", 1, out(1, 3)),
            (
                "a = [9223372036854775807, 1]\nlog(\"{}\", a.sum())",
                2,
                Fault::Overflow,
            ),
        ],
    );
}
