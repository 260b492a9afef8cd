//! Tuples: values, parts, names for parts, order, and tuples within everything else.

use super::support::{Robot, bytecode, effect, values};
use starl_lang::check::NoLibraries;

const DECLARATIONS: &str = "
enum Colour {red, green}
record Task {key: (Int, String), tags: List[(Int, Colour)]}
const ORIGIN = (0.0, (0, \"zero\"))
t: (Int, String) = (1, \"one\")
deep: ((Int, (Float, Point)), List[(Int, Int)]) = ((1, (2.5, Point(1.0, 2.0))), [(1, 2), (0, 9)])
zero: (Int, (String, Duration?), Colour)
maybe: (Int, RobotId)?
task: Task = Task((2, \"b\"), [(1, green), (2, red)])
map: Map[(Int, String), (Bool, Int)] = {(2, \"a\"): (true, 1), (1, \"b\"): (false, 2), (1, \"a\"): (true, 3)}
function swap(pair: (Int, String)) -> (String, Int) = (pair.1, pair.0)
function least(list: List[(Int, String)]) -> (Int, String)? = list.sorted().first()";

#[test]
fn parts_are_read() {
    values(
        DECLARATIONS,
        &[
            ("t", "(1, \"one\")"),
            ("t.0", "1"),
            ("t.1", "one"),
            ("(t.1, t.0)", "(\"one\", 1)"),
            ("swap(t)", "(\"one\", 1)"),
            ("swap(t).1", "1"),
            ("deep", "((1, (2.5, (1.0, 2.0, 0.0))), [(1, 2), (0, 9)])"),
            ("deep.0.1.0", "2.5"),
            ("deep.0.1.1.y", "2.0"),
            ("deep.1[1].1", "9"),
            ("ORIGIN.1.1", "zero"),
            ("zero", "(0, (\"\", none), red)"),
            ("maybe", "none"),
            ("maybe == none", "true"),
            ("(1, me).0", "1"),
            ("String(t)", "(1, \"one\")"),
            ("task", "(key = (2, \"b\"), tags = [(1, green), (2, red)])"),
            ("task.tags[0].1", "green"),
            ("((1), 2)", "(1, 2)"),
            ("(1, 2,)", "(1, 2)"),
        ],
    );
}

#[test]
fn order_and_equality_go_by_the_parts() {
    values(
        DECLARATIONS,
        &[
            ("t == (1, \"one\")", "true"),
            ("t != (1, \"two\")", "true"),
            ("t < (1, \"two\")", "true"),
            ("t < (0, \"two\")", "false"),
            ("t <= t and t >= t", "true"),
            ("t < t or t > t", "false"),
            ("(\"b\", 1) < (\"a\", 2)", "false"),
            ("(\"a\", 2) < (\"b\", 1)", "true"),
            ("(1.5, me) < (2.0, me)", "true"),
            ("((1, 2), 3) < ((1, 3), 0)", "true"),
            (
                "[(\"b\", 1), (\"a\", 2), (\"a\", 1)].sorted()",
                "[(\"a\", 1), (\"a\", 2), (\"b\", 1)]",
            ),
            (
                "{(\"b\", 1), (\"a\", 2), (\"a\", 2)}",
                "{(\"a\", 2), (\"b\", 1)}",
            ),
            (
                "map",
                "{(1, \"a\"): (true, 3), (1, \"b\"): (false, 2), (2, \"a\"): (true, 1)}",
            ),
            ("map[(1, \"b\")].1", "2"),
            ("(1, \"c\") in map", "false"),
            (
                "[k for k in map by (k.1, -k.0)]",
                "[(2, \"a\"), (1, \"a\"), (1, \"b\")]",
            ),
            ("least([(2, \"a\"), (1, \"z\")])", "(1, \"z\")"),
            ("min((2, 1.0), (1, 9.0))", "(1, 9.0)"),
            ("max((2, \"a\"), (2, \"b\"))", "(2, \"b\")"),
            ("clamp((5, 0), (1, 1), (3, 3))", "(3, 3)"),
            ("clamp((0, 0), (1, 1), (3, 3))", "(1, 1)"),
            (
                "forall (n, c) in task.tags: n > 0 and c in [red, green]",
                "true",
            ),
            ("exists k, (_, n) in map: n == k.0", "false"),
            ("[n + k for (n, k) in [(1, 2), (3, 4)]]", "[3, 7]"),
            ("{n: s for n, (_, s) in {1: (true, \"x\")}}", "{1: \"x\"}"),
        ],
    );
}

#[test]
fn nan_is_in_no_order() {
    values(
        "nan: Float = 0.0 / 0.0",
        &[
            ("(nan, 1) < (nan, 2)", "false"),
            ("(nan, 1) <= (nan, 1)", "false"),
            ("(nan, 1) == (nan, 1)", "false"),
            ("(1, nan) < (2, nan)", "true"),
            ("(1, nan) > (1, 0.0)", "false"),
        ],
    );
}

#[test]
fn parts_are_changed() {
    let told = effect(
        DECLARATIONS,
        "t.0 = 5
t.1 += \"!\"
deep.0.1.0 *= 2.0
deep.1[0].1 = 7
deep.1.add((3, 3))
map[(1, \"b\")].1 += 2
let (a, b) = t
a += 1
let c = b
b = \"changed\"
maybe = (a, me)
log(\"{} {} {} {} {} {}\", t, a, b, c, deep, map[(1, \"b\")])
if some (n, robot) = maybe then log(\"{} {}\", n, robot)
for (x, y) in deep.1
    deep.1.add((y, x))
let best = (3, \"c\")
best = min(best, (3, \"b\"))
best = max((1, \"a\"), best)
best = clamp((9, \"\"), (0, \"\"), best)
log(\"{} {}\", deep.1, best)",
    );
    let told = told.expect("no errors");
    assert_eq!(
        told,
        [
            r#"log("(5, \"one!\") 6 changed one! ((1, (5.0, (1.0, 2.0, 0.0))), [(1, 7), (0, 9), (3, 3)]) (false, 4)")"#,
            r#"log("6 robot1")"#,
            r#"log("[(1, 7), (0, 9), (3, 3), (7, 1), (9, 0), (3, 3)] (3, \"b\")")"#,
        ]
    );
}

#[test]
fn guards_and_handlers_give_parts_names() {
    let mut robot = Robot::started(
        "program Test
message Bid(offer: (Int, RobotId), path: List[(Float, Float)])
bids: List[(Int, RobotId)] = [(4, me), (2, me)]
best: Int = 0
go()
    pre some (least, _) = bids.sorted().first() and best != least
    eff best = least
check best >= 0
on Bid(from, offer, path)
    let (cost, robot) = offer
    bids.add((cost + path.size(), if robot == me then from else robot))
",
    );
    assert!(robot.action("go").expect("no errors"));
    assert_eq!(robot.get("best"), "2");
    assert!(!robot.action("go").expect("no errors"));
}

/// A type that holds two of a smaller one, and so on, has no endless name.
#[test]
fn types_that_double_are_checked_in_short_time() {
    let lines: String = (1..28)
        .map(|n| {
            format!(
                "    let x{n} = ([x{before}], [x{before}])\n",
                before = n - 1
            )
        })
        .collect();
    let source = format!(
        "program Test\ngo()\n    eff\n        let x0 = (1, 2)\n{}",
        lines.replace("    let", "        let")
    );
    let wrong = source.clone() + "        let y: Int = x27\n        log(\"{}\", y)\n";
    let checked = starl_lang::check::check(&wrong, &NoLibraries);
    assert!(checked.diagnostics().len() == 1);
    bytecode(&(source + "        log(\"{}\", x27)\n"), &NoLibraries);
}
