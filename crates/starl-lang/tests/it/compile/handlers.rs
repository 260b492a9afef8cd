//! Handlers of messages and of what primitives report.

use starl_lang::machine::{Type, Value};

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
fn handlers_take_all_that_the_message_has() {
    let test = Robot::new(SOURCE);
    let bytecode = test.program.bytecode();
    let kinds = |event: &str| {
        let mut handlers = bytecode.handlers.iter();
        let handler = handlers.find(|handler| handler.event == event).unwrap();
        let function = &bytecode.functions[handler.function as usize];
        (handler.primitive, function.arguments.clone())
    };
    let (primitive, arguments) = kinds("Reached");
    assert_eq!((primitive, arguments.len()), (None, 5));
    assert_eq!(arguments[..3], [Type::Robot, Type::Int, Type::Point]);
    assert_eq!(kinds("Ping"), (None, vec![Type::Robot]));
    let (primitive, arguments) = kinds("failed");
    assert_eq!((primitive, arguments.len()), (Some(0), 2));
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
