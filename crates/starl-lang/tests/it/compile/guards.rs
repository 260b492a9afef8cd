//! Guards: when actions fire, and what their bindings hand to the effect.

use starl_lang::machine::{Fault, Value};

use super::support::{Robot, some};

#[test]
fn bindings_are_there_in_the_effect() {
    let source = "program Test
record Tagged {name: String, at: Point}
n: Int?
tagged: Tagged?
list: List[String]
go()
    pre some a = n and a > 2 and some t = tagged and some last = list.last() and t.at.x > 0.0
    eff
        log(\"{} {} {}\", a, t, last)
        n = a - 1
        let b = a + 1
        log(\"{} {}\", b, n)
";
    let mut robot = Robot::started(source);
    assert_eq!(robot.action("go"), Ok(false));
    robot.set("n", &some(Value::Int(4)));
    assert_eq!(robot.action("go"), Ok(false));
    let at = Value::Point(starl_core::Point::planar(1.0, 2.0));
    let fields = vec![("name".into(), Value::Text("x".into())), ("at".into(), at)];
    robot.set("tagged", &some(Value::Record(fields)));
    robot.set(
        "list",
        &Value::List(vec![Value::Text("p".into()), Value::Text("q".into())]),
    );
    assert_eq!(robot.action("go"), Ok(true));
    assert_eq!(
        robot.told(),
        [
            "log(\"4 (name = \\\"x\\\", at = (1.0, 2.0, 0.0)) q\")",
            "log(\"5 3\")"
        ]
    );
    assert_eq!(robot.action("go"), Ok(true));
    assert_eq!(robot.action("go"), Ok(false));
    assert_eq!(robot.get("n"), "2");
}

#[test]
fn no_guard_always_holds() {
    let mut robot = Robot::started("program Test\nn: Int\ngo()\n    eff n += 1\n");
    assert_eq!(robot.action("go"), Ok(true));
    assert_eq!(robot.action("go"), Ok(true));
    assert_eq!(robot.get("n"), "2");
}

#[test]
fn guards_read_everything_and_change_nothing() {
    let source = "program Test
motion = ReachAvoid()
enum Location {here, there}
loc: Location = here
flag: Bool
names: Set[String] = {\"a\"}
go()
    pre (loc == here or flag) and not motion.done and \"a\" in names and position.x == 1.0 and peers.size() == 3 and [x for x in 0..3].sum() == 3
    eff loc = there
";
    let mut robot = Robot::started(source);
    assert_eq!(robot.action("go"), Ok(true));
    assert_eq!(robot.action("go"), Ok(false));
    robot.set("flag", &Value::Bool(true));
    assert_eq!(robot.action("go"), Ok(true));
    robot
        .world
        .answers
        .insert("ReachAvoid.done".into(), Value::Bool(true));
    assert_eq!(robot.action("go"), Ok(false));
    assert_eq!(robot.told(), [""; 0]);
}

#[test]
fn a_guard_may_stop_the_program() {
    let mut robot =
        Robot::started("program Test\nl: List[Int]\ngo()\n    pre l[0] == 1\n    eff l = []\n");
    let stopped = robot.action("go").expect_err("the list is empty");
    assert_eq!(
        stopped.fault,
        Fault::IndexOutOfRange {
            index: 0,
            length: 0
        }
    );
    assert_eq!(stopped.place, "test.starl:4:9");
}
