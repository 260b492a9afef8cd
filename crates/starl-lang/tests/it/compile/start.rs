//! The start: defaults, parameters, primitives, variables, `init`, in that order.

use starl_lang::machine::{Fault, Parameter, Value};

use super::support::Robot;

const SOURCE: &str = "program Test
const step = 2
param speed: Float = 1.5
param rounds: Int
param names: List[String] = [String(k * step) for k in 0..2]
motion = ReachAvoid(vicinity = speed, most_replans = rounds + 1)
radio = Broadcast(\"r\")
other = Unicast()
a: Int = rounds * 2
b: Int = a + 1
c: List[Float] = [speed, Float(b)]
d: Point = position
e: Duration
init
    log(\"{} {} {} {} {} {}\", a, b, c, d, e, names)
    if a > 100
        return
    a = 0
";

#[test]
fn in_order() {
    let mut robot = Robot::new(SOURCE);
    robot.set("rounds", &Value::Int(5));
    robot.start().unwrap();
    let told = robot.told();
    assert!(
        told[0].starts_with("ReachAvoid.bind(0, 1.5, none, none, none, 6"),
        "{}",
        told[0]
    );
    assert_eq!(
        told[1..],
        [
            "Broadcast.bind(1, \"r\", none)",
            "Unicast.bind(2, none)",
            "log(\"10 11 [1.5, 11.0] (1.0, 2.0, 3.0) 0s [\\\"0\\\", \\\"2\\\"]\")",
        ]
    );
    assert_eq!(robot.get("a"), "0");
    let primitives = &robot.program.bytecode().primitives;
    let names: Vec<(&str, &str)> = primitives
        .iter()
        .map(|p| (&p.name[..], &p.kind[..]))
        .collect();
    assert_eq!(
        names,
        [
            ("motion", "ReachAvoid"),
            ("radio", "Broadcast"),
            ("other", "Unicast")
        ]
    );
}

#[test]
fn init_may_end_early() {
    let mut robot = Robot::new(SOURCE);
    robot.set("rounds", &Value::Int(51));
    robot.start().unwrap();
    assert_eq!(robot.get("a"), "102");
}

#[test]
fn parameters_say_whether_they_must_be_given() {
    let robot = Robot::new(SOURCE);
    let variables = robot.program.bytecode().variables.iter();
    let known: Vec<(&str, Parameter)> = variables
        .map(|variable| (&variable.name[..], variable.parameter))
        .collect();
    assert_eq!(
        known,
        [
            ("a", Parameter::No),
            ("b", Parameter::No),
            ("c", Parameter::No),
            ("d", Parameter::No),
            ("e", Parameter::No),
            ("speed", Parameter::Optional),
            ("rounds", Parameter::Required),
            ("names", Parameter::Optional),
        ]
    );
}

#[test]
fn a_fault_in_a_first_value_is_at_its_place() {
    let mut robot = Robot::new("program Test\nl: List[Int]\nx: Int = l[2]\n");
    let stopped = robot.start().expect_err("the list is empty");
    assert_eq!(
        stopped.fault,
        Fault::IndexOutOfRange {
            index: 2,
            length: 0
        }
    );
    assert_eq!(stopped.place, "test.starl:3:10");
    let mut robot = Robot::new("program Test\nparam x: Int = 1 / 0\n");
    assert_eq!(robot.start().expect_err("by zero").place, "test.starl:2:16");
}
