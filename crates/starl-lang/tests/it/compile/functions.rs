//! Functions: arguments and results of every kind, recursion, constants, libraries.

use std::collections::BTreeMap;

use starl_lang::machine::{Fault, Limits, Value};

use super::support::{Robot, bytecode, load, values};

const DECLARATIONS: &str = "
record Pair {a: Int, s: String}
const one = 1
const two = one + one
const name = \"n\"
const primes = [2, 3, 5]
const table = {p: p * two for p in primes}
const first = primes[0]
const origin: Point = Point(1.0, 2.0)
const third: Duration = 1s / 3

function double(x: Int) -> Int = x * 2
function fib(n: Int) -> Int
    if n < 2 then return n
    return fib(n - 1) + fib(n - 2)
function even(n: Int) -> Bool
    if n == 0 then return true
    return odd(n - 1)
function odd(n: Int) -> Bool
    if n == 0
        return false
    else
        return even(n - 1)
function swap(p: Pair, s: String) -> Pair = Pair(p.a + 1, s + p.s)
function same(p: Pair) -> Pair = p
function middle(a: Point, b: Point) -> Point = (a + b) / 2.0
function second(a: List[Int], b: List[Int]) -> List[Int] = b
function both(a: List[Int], b: List[Int]) -> List[Int]
    let c = a
    for x in b
        c.add(x)
    return c
function find(xs: List[Int], x: Int) -> Int?
    for i in 0..xs.size()
        if xs[i] == x then return i
    return none
function maybe(x: Int?) -> String = if some y = x then String(y) else \"-\"
function none_of() -> Int? = none
function zero() -> Int = 0
function sum(xs: List[Int]) -> Int
    let s = 0
    for x in xs
        s += x
    return s
function order(a: Int, b: Float, c: String, d: Point, e: Bool) -> String
    return String(a) + String(b) + c + String(d) + String(e)
l: List[Int] = [1, 2]
p: Pair = Pair(1, \"x\")";

#[test]
fn calls() {
    values(
        DECLARATIONS,
        &[
            ("double(4)", "8"),
            ("double(double(4) + 1) - double(1)", "16"),
            ("fib(15)", "610"),
            ("even(10)", "true"),
            ("odd(10)", "false"),
            ("swap(p, \"y\")", "(a = 2, s = \"yx\")"),
            ("swap(swap(p, \"y\"), \"z\").s", "zyx"),
            ("same(p)", "(a = 1, s = \"x\")"),
            ("same(p).a", "1"),
            ("middle(position, Point(0.0, 0.0))", "(0.5, 1.0, 1.5)"),
            ("middle(position, position).z", "3.0"),
            ("second(l, [5])", "[5]"),
            ("second([5], l)[1]", "2"),
            ("both(l, l)", "[1, 2, 1, 2]"),
            ("both(both(l, [3]), second(l, [4]))", "[1, 2, 3, 4]"),
            ("l", "[1, 2]"),
            ("find(l, 2)", "1"),
            ("find(l, 3)", "none"),
            ("find(l, 2)! + 1", "2"),
            ("find(l, 9) ?? -1", "-1"),
            ("maybe(none)", "-"),
            ("maybe(3)", "3"),
            ("maybe(find(l, 1))", "0"),
            ("none_of() ?? zero()", "0"),
            ("sum([fib(i) for i in 0..6])", "12"),
            (
                "order(1, 2.0, \"c\", position, true)",
                "12.0c(1.0, 2.0, 3.0)true",
            ),
            ("one + two", "3"),
            ("name + name", "nn"),
            ("primes[two]", "5"),
            ("table", "{2: 4, 3: 6, 5: 10}"),
            ("table[first]", "4"),
            ("origin.y", "2.0"),
            ("origin + origin", "(2.0, 4.0, 0.0)"),
            ("third", "333333333ns"),
            ("[x in primes for x in 0..4]", "[false, false, true, true]"),
        ],
    );
}

#[test]
fn endless_recursion_is_stopped() {
    let source = "library L\nfunction f(n: Int) -> Int = f(n + 1) + 1\nfunction g(l: List[Int]) -> List[Int] = g(l + [1])\n";
    let mut robot = Robot::of(load(bytecode(source, &starl_lang::check::NoLibraries)));
    let stopped = robot
        .call("f", &[Value::Int(0)])
        .expect_err("it has no end");
    assert_eq!(
        (stopped.fault, &stopped.place[..]),
        (Fault::CallDepth, "l.starl:2:29")
    );
    let stopped = robot
        .call("g", &[Value::List(Vec::new())])
        .expect_err("it has no end");
    assert!(
        matches!(stopped.fault, Fault::OutOfMemory { .. }),
        "{stopped:?}"
    );
}

#[test]
fn libraries() {
    let mut sources = BTreeMap::new();
    sources.insert(
        "geometry",
        "library geometry\nconst unit = 2.0\nrecord Line {a: Point, b: Point}\n\nfunction length(l: Line) -> Float = distance(l.a, l.b) * unit\nfunction at(xs: List[Int], i: Int) -> Int\n    return xs[i]\n",
    );
    let libraries = |name: &str| sources.get(name).map(ToString::to_string);
    let source = "program Test
import geometry
line: geometry.Line = geometry.Line(Point(0.0, 0.0), Point(3.0, 4.0))
go()
    eff
        log(\"{} {}\", geometry.length(line), geometry.unit)
        log(\"{}\", geometry.at([], 3))
";
    let mut robot = Robot::of(load(bytecode(source, &libraries)));
    robot.start().unwrap();
    let stopped = robot.action("go").expect_err("the list is empty");
    assert_eq!(robot.told(), ["log(\"10.0 2.0\")"]);
    assert_eq!(stopped.place, "geometry.starl:7:12");
}

#[test]
fn unused_functions_are_omitted() {
    let source = "program Test\nfunction used(x: Int) -> Int = x\nfunction unused(x: Int) -> Int = x\nn: Int = used(1)\ngo()\n    eff n += 1\n";
    let program = super::support::program(source);
    let names: Vec<&str> = program
        .bytecode()
        .functions
        .iter()
        .map(|f| &f.name[..])
        .collect();
    assert_eq!(names, ["used", "start", "go.pre", "go.eff"]);
}

#[test]
fn deep_recursion_within_the_limits() {
    let source = "library L\nfunction depth(n: Int, l: List[Int]) -> Int\n    if n == 0 then return l.size()\n    return depth(n - 1, l) + 1\n";
    let mut robot = Robot::of(load(bytecode(source, &starl_lang::check::NoLibraries)));
    robot.limits = Limits {
        fuel: 1_000_000,
        ..Limits::default()
    };
    let depth = robot.call(
        "depth",
        &[Value::Int(900), Value::List(vec![Value::Int(1)])],
    );
    assert_eq!(depth, Ok(Value::Int(901)));
}
