//! Values as bytes of messages: short, the same as a native program's, refused where they are wrong.

use crate::machine_support::program;
use serde::Serialize;
use starl_core::{Point, Random, RobotId, message};
use starl_lang::machine::{Object, Program, Type, Value};

const TYPES: &str = "
enum Location init pick wait
type Text
type List[Int]
type Set[Robot]
type Map[type0, Point?]
";

fn kinds() -> Vec<Type> {
    let record = vec![("at".into(), Type::Time), ("word".into(), Type::Object(0))];
    vec![
        Type::Bool,
        Type::Int,
        Type::Float,
        Type::Point,
        Type::Robot,
        Type::Enum(0),
        Type::Optional(Box::new(Type::Int)),
        Type::Optional(Box::new(Type::Record(record))),
        Type::Object(1),
        Type::Object(2),
        Type::Object(3),
    ]
}

fn values() -> Vec<Value> {
    let robot = |number| Value::Robot(RobotId(number));
    let text = |text: &str| Value::Text(text.into());
    let point = Value::Some(Box::new(Value::Point(Point::new(1.0, -2.0, 0.5))));
    vec![
        Value::Bool(true),
        Value::Int(-300),
        Value::Float(0.1),
        Value::Point(Point::planar(1.0, 2.0)),
        robot(70_000),
        Value::Variant("wait".into()),
        Value::None,
        Value::Some(Box::new(Value::Record(vec![
            ("at".into(), Value::Time(starl_core::Time(5_000_000_000))),
            ("word".into(), text("caf\u{e9}")),
        ]))),
        Value::List(vec![
            Value::Int(3),
            Value::Int(i64::MIN),
            Value::Int(i64::MAX),
        ]),
        Value::Set(vec![robot(1), robot(2)]),
        Value::Map(vec![(text(""), Value::None), (text("b"), point)]),
    ]
}

fn registers(program: &Program) -> (Vec<u64>, Vec<Object>) {
    let (mut scalars, mut objects) = (Vec::new(), Vec::new());
    for (value, kind) in values().iter().zip(&kinds()) {
        assert!(
            value.write(program, kind, &mut scalars, &mut objects),
            "{value}"
        );
    }
    (scalars, objects)
}

#[test]
fn sent_messages_are_received() {
    let program = program(TYPES);
    let (scalars, objects) = registers(&program);
    let bytes = program
        .encode(&kinds(), &scalars, &objects)
        .expect("they are values");
    assert_eq!(
        program.decode(&kinds(), &bytes),
        Some((scalars.clone(), objects.clone()))
    );
    let read = Value::read_all(&program, &kinds(), &scalars, &objects);
    assert_eq!(read, Some(values()));
}

#[test]
fn bytes_are_those_of_a_native_message() {
    #[derive(Serialize)]
    struct Native {
        bool: bool,
        int: i64,
        float: f64,
        point: Point,
        robot: RobotId,
        text: &'static str,
        none: Option<i64>,
        list: Vec<i64>,
    }
    let native = Native {
        bool: true,
        int: -300,
        float: 0.1,
        point: Point::planar(1.0, 2.0),
        robot: RobotId(70_000),
        text: "caf\u{e9}",
        none: None,
        list: vec![7, -7],
    };
    let program = program(TYPES);
    let kinds = [
        Type::Bool,
        Type::Int,
        Type::Float,
        Type::Point,
        Type::Robot,
        Type::Object(0),
        Type::Optional(Box::new(Type::Int)),
        Type::Object(1),
    ];
    let values = [
        Value::Bool(native.bool),
        Value::Int(native.int),
        Value::Float(native.float),
        Value::Point(native.point),
        Value::Robot(native.robot),
        Value::Text(native.text.into()),
        Value::None,
        Value::List(native.list.iter().map(|&n| Value::Int(n)).collect()),
    ];
    let (mut scalars, mut objects) = (Vec::new(), Vec::new());
    for (value, kind) in values.iter().zip(&kinds) {
        assert!(value.write(&program, kind, &mut scalars, &mut objects));
    }
    let bytes = program
        .encode(&kinds, &scalars, &objects)
        .expect("they are values");
    assert_eq!(bytes, message::encode(&native));
}

#[test]
fn wrong_bytes_are_refused() {
    let program = program(TYPES);
    let refused = |kind: Type, bytes: &[u8]| {
        assert_eq!(
            program.decode(std::slice::from_ref(&kind), bytes),
            None,
            "{kind} {bytes:?}"
        );
    };
    refused(Type::Bool, &[2]);
    refused(Type::Bool, &[]);
    refused(Type::Bool, &[1, 0]);
    refused(Type::Int, &[0x80]);
    refused(Type::Int, &[0xff; 11]);
    refused(
        Type::Int,
        &[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 2],
    );
    refused(
        Type::Time,
        &[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 1],
    );
    refused(Type::Robot, &[0xff, 0xff, 0xff, 0xff, 0x1f]);
    refused(Type::Enum(0), &[3]);
    refused(Type::Object(0), &[1, 0xff]);
    refused(Type::Object(1), &[0xff, 0xff, 0xff, 0xff, 0x0f]);
    refused(Type::Object(2), &[2, 2, 1]);
    refused(Type::Object(2), &[2, 1, 1]);
}

#[test]
fn random_bytes_never_panic() {
    let program = program(TYPES);
    let (scalars, objects) = registers(&program);
    let sent = program
        .encode(&kinds(), &scalars, &objects)
        .expect("they are values");
    let mut random = Random::keyed(7, &[0]);
    let mut taken = 0;
    for _ in 0..20_000 {
        let mut bytes = sent.clone();
        for _ in 0..=random.below(3) {
            let place = random.below(bytes.len() as u32) as usize;
            bytes[place] = random.bits() as u8;
        }
        if let Some((scalars, objects)) = program.decode(&kinds(), &bytes) {
            let again = program
                .encode(&kinds(), &scalars, &objects)
                .expect("they are values");
            assert_eq!(program.decode(&kinds(), &again), Some((scalars, objects)));
            taken += 1;
        }
    }
    assert!(taken > 1000, "{taken}");
}

#[test]
fn variables_have_names() {
    let program = program(&format!(
        "{TYPES} parameter vicinity Float\n variable words type1\n variable last Point?"
    ));
    let mut state = program.new_state();
    assert_eq!(program.get(&state, "vicinity"), Some(Value::Float(0.0)));
    assert!(program.set(&mut state, "vicinity", &Value::Float(0.5)));
    assert!(program.set(
        &mut state,
        "last",
        &Value::Some(Box::new(Value::Point(Point::planar(1.0, 2.0))))
    ));
    assert!(
        !program.set(&mut state, "vicinity", &Value::Int(1)),
        "another type"
    );
    assert!(
        !program.set(&mut state, "distance", &Value::Int(1)),
        "another name"
    );
    let shown: Vec<String> = program
        .values(&state)
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    assert_eq!(
        shown,
        ["vicinity = 0.5", "words = []", "last = (1.0, 2.0, 0.0)"]
    );
}

#[test]
fn sets_and_maps_are_sorted() {
    let program = program(TYPES);
    let robot = |number| Value::Robot(RobotId(number));
    let write = |value: Value, kind: u16| {
        let (mut scalars, mut objects) = (Vec::new(), Vec::new());
        let kind = Type::Object(kind);
        let written = value.write(&program, &kind, &mut scalars, &mut objects);
        written.then(|| Value::read(&program, &kind, &scalars, &objects).expect("a value"))
    };
    let set = Value::Set(vec![robot(3), robot(1), robot(3)]);
    assert_eq!(write(set, 2), Some(Value::Set(vec![robot(1), robot(3)])));
    let entry = |key: &str| (Value::Text(key.into()), Value::None);
    let map = Value::Map(vec![entry("b"), entry("a")]);
    assert_eq!(
        write(map, 3),
        Some(Value::Map(vec![entry("a"), entry("b")]))
    );
    let twice = Value::Map(vec![entry("b"), entry("b")]);
    assert_eq!(write(twice, 3), None);
    let mixed = Value::List(vec![Value::Int(1), Value::Bool(true)]);
    assert_eq!(write(mixed, 1), None);
}
