//! Shared variables: instances of SingleWriter and MultiWriter after the program's own primitives.

use starl_lang::machine::{Fault, Value};

use super::support::{Robot, robot, some};

const SOURCE: &str = "program Test
record Seen {count: Int, names: List[String]}
motion = Unicast()
allread pos[RobotId]: Point
allread[eventual] maybe[RobotId]: Int?
allwrite sum: Int = 3
allwrite seen: Seen = Seen(1, [\"a\"])
allwrite last: Time
write()
    eff
        pos[me] = position
        maybe[me] = none
        sum = sum + 1
        sum += 2
        seen.count += 1
        seen.names.add(\"b\")
        seen = Seen(0, [])
        last = now
read()
    eff
        log(\"{} {} {}\", pos[me], maybe[me], maybe[robot_of()] ?? 9)
        log(\"{} {} {} {}\", pos.size(), [r for r in pos], pos.get(me), me in pos)
        log(\"{} {} {}\", sum, seen.names, last)
        if some t = last then log(\"{}\", t)
        for r, p in pos
            log(\"{} {}\", r, p.x)
function robot_of_all(rs: Set[RobotId]) -> RobotId = rs.max()!
";

fn source() -> String {
    SOURCE.replace("robot_of()", "robot_of_all(peers)")
}

fn started() -> Robot {
    let mut test = Robot::new(&source());
    let seen = Value::Record(vec![
        ("count".into(), Value::Int(7)),
        ("names".into(), Value::List(vec![Value::Text("z".into())])),
    ]);
    test.world
        .answers
        .insert("MultiWriter.read(3)".into(), some(Value::Int(40)));
    test.world
        .answers
        .insert("MultiWriter.read(4)".into(), some(seen));
    test
}

#[test]
fn bound_after_the_programs_own_and_initialized() {
    let mut test = started();
    test.start().unwrap();
    assert_eq!(
        test.told(),
        [
            "Unicast.bind(0, none)",
            "SingleWriter.bind(1, none)",
            "SingleWriter.bind(2, none)",
            "MultiWriter.bind(3, none)",
            "MultiWriter.initialize(3, 3)",
            "MultiWriter.bind(4, none)",
            "MultiWriter.initialize(4, (count = 1, names = [\"a\"]))",
            "MultiWriter.bind(5, none)",
        ]
    );
    let kinds = test
        .program
        .bytecode()
        .primitives
        .iter()
        .map(|p| format!("{} {}", p.name, p.kind));
    assert_eq!(
        kinds.collect::<Vec<_>>(),
        [
            "motion Unicast",
            "pos SingleWriter",
            "maybe SingleWriter",
            "sum MultiWriter",
            "seen MultiWriter",
            "last MultiWriter"
        ]
    );
}

#[test]
fn writing() {
    let mut test = started();
    test.start().unwrap();
    test.told();
    test.action("write").unwrap();
    assert_eq!(
        test.told(),
        [
            "SingleWriter.write(1, (1.0, 2.0, 3.0))",
            "SingleWriter.write(2, none)",
            "MultiWriter.write(3, 41)",
            "MultiWriter.write(3, 42)",
            "MultiWriter.write(4, (count = 8, names = [\"z\"]))",
            "MultiWriter.write(4, (count = 7, names = [\"z\", \"b\"]))",
            "MultiWriter.write(4, (count = 0, names = []))",
            "MultiWriter.write(5, 1.500s)",
        ]
    );
}

#[test]
fn reading() {
    let mut test = started();
    test.start().unwrap();
    test.told();
    let point = |x| Value::Point(starl_core::Point::planar(x, 0.0));
    let all = Value::Map(vec![(robot(0), point(5.0)), (robot(1), point(6.0))]);
    test.world.answers.insert("SingleWriter.all(1)".into(), all);
    test.world
        .answers
        .insert("SingleWriter.element(1, robot1)".into(), some(point(6.0)));
    // That it was written, and that it is an Int, are one to the program.
    test.world.answers.insert(
        "SingleWriter.element(2, robot1)".into(),
        some(some(Value::Int(4))),
    );
    test.world
        .answers
        .insert("SingleWriter.element(2, robot2)".into(), some(Value::None));
    test.action("read").unwrap();
    assert_eq!(
        test.told(),
        [
            "log(\"(6.0, 0.0, 0.0) 4 9\")",
            "log(\"2 [robot0, robot1] (6.0, 0.0, 0.0) true\")",
            "log(\"40 [\\\"z\\\"] none\")",
            "log(\"robot0 5.0\")",
            "log(\"robot1 6.0\")",
        ]
    );
}

#[test]
fn a_host_without_the_first_value_is_noticed() {
    let mut test = Robot::started(&source());
    let stopped = test.action("write").expect_err("there is no value");
    assert_eq!(stopped.fault, Fault::NoneUnwrapped);
}
