//! Random well-typed programs on robots that communicate: there is no panic and no value of a wrong type, runs repeat,
//! and a copy continues like the original.

use crate::robot_support::World;
use crate::robot_support::seen::Seen;
use crate::support::{generate, hold};
use starl_core::{Input, Message, Order, Point, Random, RobotId, Value};
use starl_lang::machine::Origin;
use starl_lang::robot::properties::Judge;
use starl_lang::robot::{Code, RobotProgram};

const ROBOTS: u32 = 2;

/// A run of a program on all robots; if asked for, with copies in their places halfway.
fn run(code: &Code, seed: u64, copies: bool) -> (World, String) {
    let mut random = Random::keyed(seed, &[5]);
    let program = RobotProgram::new(code, &[]).expect("it was made before");
    let programs = vec![program; ROBOTS as usize];
    let mut world = World::new(programs).with_way_points(&[(1.0, 2.0), (3.0, -1.0)]);
    let mut judge = Judge::new(code);
    let mut judged = String::new();
    for step in 0..8 {
        if step == 4 && copies {
            world = world.clone();
        }
        world.step();
        garble(&mut world, &mut random);
        order(&mut world, &mut random);
        judged += &format!("{:?}", judge.observe(world.now, &Seen::new(&world)));
    }
    (world, judged)
}

/// Delivers sent messages again, with a few bytes changed.
fn garble(world: &mut World, random: &mut Random) {
    let sent = world.sent().take(3);
    let sent: Vec<_> = sent
        .map(|sent| (sent.from, sent.port, sent.payload.to_vec()))
        .collect();
    for (from, port, mut bytes) in sent {
        for byte in &mut bytes {
            if random.chance(0.1) {
                *byte = random.below(256) as u8;
            }
        }
        let message = Message {
            from,
            port,
            payload: bytes.into(),
        };
        let to = (from.0 + 1) % ROBOTS;
        world.input(to as usize, &Input::Message(message));
    }
}

/// Gives each robot every order that it handles, with values of any types.
fn order(world: &mut World, random: &mut Random) {
    for robot in 0..ROBOTS as usize {
        let bytecode = world.program(robot).code().program().bytecode();
        let inputs: Vec<(String, Vec<String>)> = (bytecode.handlers.iter())
            .filter_map(|handler| match &handler.origin {
                Origin::Input(fields) => Some((handler.event.clone(), fields.clone())),
                _ => None,
            })
            .collect();
        for (name, fields) in inputs {
            let fields = fields.into_iter();
            let fields = fields.map(|field| (field.into(), detail(random)));
            let order = Order {
                name: name.into(),
                fields: fields.collect(),
            };
            world.input(robot, &Input::Order(order));
        }
    }
}

/// Some field of an order.
fn detail(random: &mut Random) -> Value {
    let number = random.below(5);
    match random.below(8) {
        0 | 1 => Value::Int(i64::from(number)),
        2 => Value::Bool(number == 0),
        3 => Value::Float(f64::from(number) - 0.5),
        4 => Value::Text("text".into()),
        5 => Value::Point(Point::planar(f64::from(number), 1.0)),
        6 => Value::Robot(RobotId(number)),
        _ => Value::Path(vec![Point::ZERO; number as usize]),
    }
}

/// The observable result of a run.
fn seen((world, judged): &(World, String)) -> String {
    let mut text = format!("{:?}{judged}", world.records);
    for (robot, unit) in world.robots.iter().enumerate() {
        let state = world.program(robot).state();
        let failure = world.failure(robot);
        text += &format!("{state:?}{failure:?}{}", unit.travel.halts);
    }
    text
}

#[test]
fn never_go_wrong() {
    let (mut running, mut events) = (0, 0);
    for seed in 0..300 {
        let mut random = Random::keyed(seed, &[4]);
        let bytes: Vec<u8> = (0..random.below(1500))
            .map(|_| random.below(256) as u8)
            .collect();
        let text = generate::program(&bytes);
        let Some((_, bytecode)) = hold::compiled(&text) else {
            continue;
        };
        let code = Code::load(bytecode).unwrap_or_else(|error| panic!("{error}\n{text}"));
        // A default that is a run-time error is reported at once.
        if RobotProgram::new(&code, &[]).is_err() {
            continue;
        }
        let first = run(&code, seed, false);
        for robot in 0..ROBOTS as usize {
            let failed = first.0.failure(robot).unwrap_or_default();
            assert!(!failed.contains("wrong type"), "{failed}\n{text}");
        }
        assert_eq!(seen(&run(&code, seed, false)), seen(&first), "{text}");
        assert_eq!(seen(&run(&code, seed, true)), seen(&first), "{text}");
        running += (0..ROBOTS as usize)
            .filter(|&robot| first.0.failure(robot).is_none())
            .count();
        events += first.0.records.len();
    }
    // Else too little would be shown.
    assert!(
        running > 200 && events > 5000,
        "{running} robots ran, with {events} events"
    );
}
