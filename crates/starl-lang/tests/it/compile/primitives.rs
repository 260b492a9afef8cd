//! Members of primitives: instance first, what may be left out as an optional.

use std::borrow::Cow;

use starl_lang::machine::{Fault, Type, Value};

use super::support::Robot;

const SOURCE: &str = "program Test
message Hello(n: Int)
motion = ReachAvoid()
near = ReachAvoid(vicinity = 5cm)
radio = Broadcast()
talk = Unicast()
cast = Geocast(name = \"g\")
last: Int
go()
    pre not near.active
    eff
        near.reach_avoid(Point(1.0, 2.0), obstacles())
        motion.stop()
        last = radio.broadcast(Hello(4)) + 1
        talk.send(me, Hello(last))
        cast.geocast(message = Hello(1), area = circle(position, 1m))
        if radio.outstanding(last) or motion.done
            log(\"open\")
";

#[test]
fn calls() {
    let mut robot = Robot::started(SOURCE);
    robot
        .world
        .answers
        .insert("Broadcast.broadcast".into(), Value::Int(8));
    robot
        .world
        .answers
        .insert("Broadcast.outstanding(2, 9)".into(), Value::Bool(true));
    assert_eq!(robot.action("go"), Ok(true));
    let told = robot.told();
    assert_eq!(
        told[..4],
        [
            "ReachAvoid.reach_avoid(1, (1.0, 2.0, 0.0), 0 obstacles)",
            "ReachAvoid.stop(0)",
            "Broadcast.broadcast(2, (n = 4)) Hello",
            "Unicast.send(3, robot1, (n = 9)) Hello",
        ]
    );
    assert!(
        told[4].starts_with("Geocast.geocast(4, (n = 1), Some(Circle"),
        "{}",
        told[4]
    );
    assert_eq!(told[5..], ["log(\"open\")"]);
    assert_eq!(robot.get("last"), "9");
}

#[test]
fn imports_have_their_signatures() {
    let robot = Robot::new(SOURCE);
    let imports = &robot.program.bytecode().imports;
    let named = |name: &str| imports.iter().find(|import| import.name == name).unwrap();
    assert!(named("ReachAvoid.active").query);
    assert!(!named("ReachAvoid.stop").query);
    assert!(!named("ReachAvoid.bind").query);
    let send = named("Unicast.send");
    assert_eq!(send.labels, ["Hello"]);
    let record = Type::Record(vec![("n".into(), Type::Int)]);
    assert_eq!(send.arguments, [Type::Int, Type::Robot, record]);
    assert_eq!(send.results, [Type::Int]);
    let bind = named("ReachAvoid.bind");
    let optional = |kind| Type::Optional(Box::new(kind));
    let expected = [
        Type::Float,
        Type::Float,
        Type::Float,
        Type::Duration,
        Type::Int,
    ];
    assert_eq!(bind.arguments[0], Type::Int);
    assert_eq!(bind.arguments[1..=5], expected.map(optional));
}

#[test]
fn a_robot_that_refuses_stops_the_program_where_it_asked() {
    let mut robot = Robot::started(SOURCE);
    let reason = Value::Text("the motor is off".into());
    robot
        .world
        .answers
        .insert("ReachAvoid.stop refuses".into(), reason);
    let stopped = robot.action("go").expect_err("it was refused");
    assert_eq!(
        stopped.fault,
        Fault::Host(Cow::Borrowed("the motor is off"))
    );
    assert_eq!(stopped.place, "test.starl:13:9");
}
