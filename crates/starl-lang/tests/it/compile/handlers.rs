//! Handlers of messages and of primitives' events.

use starl_lang::machine::{Origin, Type, Value};

use super::support::{Robot, robot};

const SOURCE: &str = "program Test
message Reached(index: Int, at: Point, names: List[String], maybe: Int?)
message Ping()
radio = Broadcast()
sum: Int
on Reached(from, index, _, names, maybe)
    if index < 0
        return
    sum += index
    log(\"{} {} {} {}\", from, index, names, maybe)
on Reached(from, _, at, _, _)
    log(\"{} at {}\", from, at)
on Ping(from)
    radio.broadcast(Reached(sum, position, [robot_name(from)], none))
    radio.broadcast(Ping())
on radio.failed(number)
    log(\"failed {}\", number)
";

fn reached(index: i64) -> [Value; 5] {
    [
        robot(7),
        Value::Int(index),
        Value::Point(starl_core::Point::planar(1.0, 0.0)),
        Value::List(vec![Value::Text("n".into())]),
        Value::Some(Box::new(Value::Int(5))),
    ]
}

#[test]
fn a_message_goes_to_all_its_handlers() {
    let mut test = Robot::started(SOURCE);
    test.handle("Reached", &reached(3)).unwrap();
    assert_eq!(
        test.told(),
        [
            "log(\"robot7 3 [\\\"n\\\"] 5\")",
            "log(\"robot7 at (1.0, 0.0, 0.0)\")"
        ]
    );
    test.handle("Reached", &reached(-1)).unwrap();
    assert_eq!(test.told(), ["log(\"robot7 at (1.0, 0.0, 0.0)\")"]);
    assert_eq!(test.get("sum"), "3");
}

#[test]
fn handlers_get_all_fields_of_the_message() {
    let test = Robot::new(SOURCE);
    let bytecode = test.program.bytecode();
    let kinds = |event: &str| {
        let mut handlers = bytecode.handlers.iter();
        let handler = handlers.find(|handler| handler.event == event).unwrap();
        let function = &bytecode.functions[handler.function as usize];
        (handler.origin.clone(), function.arguments.clone())
    };
    let (origin, arguments) = kinds("Reached");
    assert_eq!((origin, arguments.len()), (Origin::Message, 5));
    assert_eq!(arguments[..3], [Type::Robot, Type::Int, Type::Point]);
    assert_eq!(kinds("Ping"), (Origin::Message, vec![Type::Robot]));
    let (origin, arguments) = kinds("failed");
    assert_eq!((origin, arguments.len()), (Origin::Primitive(0), 2));
}

#[test]
fn messages_are_sent_as_records_with_their_name() {
    let mut test = Robot::started(SOURCE);
    test.world
        .answers
        .insert("robot_name".into(), Value::Text("g".into()));
    test.handle("Ping", &[robot(7)]).unwrap();
    assert_eq!(
        test.told(),
        [
            "Broadcast.broadcast(0, (index = 0, at = (1.0, 2.0, 3.0), names = [\"g\"], maybe = none)) Reached",
            "Broadcast.broadcast(0, ()) Ping",
        ]
    );
    test.handle("failed", &[Value::Int(4), Value::List(Vec::new())])
        .unwrap();
    assert_eq!(test.told(), ["log(\"failed 4\")"]);
}

#[test]
fn handlers_of_inputs_take_the_fields_by_name() {
    let source = "program Test
on input go(to: Point, speed: Float, names: List[RobotId])
    log(\"{} {} {}\", to, speed, names)
on input way_points()
    log(\"new\")
";
    let mut test = Robot::started(source);
    let handlers = &test.program.bytecode().handlers;
    let fields = ["to", "speed", "names"].map(String::from).to_vec();
    assert_eq!(handlers[0].origin, Origin::Input(fields));
    assert_eq!(handlers[1].origin, Origin::Input(Vec::new()));
    let function = &test.program.bytecode().functions[handlers[0].function as usize];
    assert_eq!(function.name, "on.input.go");
    assert_eq!(function.arguments[..2], [Type::Point, Type::Float]);
    let place = Value::Point(starl_core::Point::planar(1.0, 0.0));
    let names = Value::List(vec![robot(2)]);
    test.handle("go", &[place, Value::Float(0.5), names])
        .unwrap();
    test.handle("way_points", &[]).unwrap();
    assert_eq!(
        test.told(),
        ["log(\"(1.0, 0.0, 0.0) 0.5 [robot2]\")", "log(\"new\")"]
    );
}
