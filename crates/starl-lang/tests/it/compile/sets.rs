//! Sets: literals, methods.

use super::support::{effect, values};

const DECLARATIONS: &str = "
a: Set[Int] = {3, 1, 2, 3}
b: Set[Int] = {2, 5}
e: Set[Int]
s: Set[String] = {\"y\", \"x\"}
r: Set[RobotId] = peers";

#[test]
fn reading() {
    values(
        DECLARATIONS,
        &[
            ("a", "{1, 2, 3}"),
            ("{1 + 1, 1}", "{1, 2}"),
            ("e", "{}"),
            ("a.size()", "3"),
            ("a.contains(3)", "true"),
            ("a.contains(4)", "false"),
            ("s.contains(\"x\")", "true"),
            ("a.union(b)", "{1, 2, 3, 5}"),
            ("a.intersection(b)", "{2}"),
            ("a.difference(b)", "{1, 3}"),
            ("a.union(e).difference(a)", "{}"),
            ("a", "{1, 2, 3}"),
            ("a.min()", "1"),
            ("a.max()", "3"),
            ("e.min()", "none"),
            ("s.max()", "y"),
            ("r.max()", "robot2"),
            ("peers.min() == me", "false"),
            ("{round(p.x) for p in way_points()}", "{1, 2, 4}"),
        ],
    );
}

#[test]
fn changing() {
    let body = "
a.add(7)
a.add(1)
a.remove(2)
a.remove(20)
log(\"{}\", a)
let c = a
c.add(0)
log(\"{} {}\", c, a)
a = a.union(b)
log(\"{}\", a)";
    let told = effect(DECLARATIONS, body.trim()).unwrap();
    let expected = ["{1, 3, 7}", "{0, 1, 3, 7} {1, 3, 7}", "{1, 2, 3, 5, 7}"];
    assert_eq!(told, expected.map(|text| format!("log({text:?})")));
}
