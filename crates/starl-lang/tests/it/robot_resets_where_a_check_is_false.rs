//! A program restarts when an invariant of its variables is false: its variables, its primitives and `init`.

use crate::robot_support::{World, compile};
use starl_core::{Input, Order, Point, Random, Value};

const GUARDED: &str = "program Guarded

param most: Int in 1..100 = 5

motion = ReachAvoid()
mux = Mutex(\"m\")
count: Int in 0..most + 1 = 0
list: List[Int] = [1, 2]
starts: Int = 0

check list.size() > count % 2 and list[count % 2] > 0
check not motion.active or motion.target == Point(3.0, 0.0)

init starts = 7

go()
    pre not motion.active
    eff motion.reach_avoid(Point(3.0, 0.0), obstacles()); mux.acquire({\"a\"})

work()
    pre count < most
    eff count += 1

on input put(number: Int)
    count = number

on input empty()
    list = []; starts = 0
";

/// As a fault would, but with a value of our choice.
fn overwrite(
    world: &mut World,
    robot: usize,
    order: &'static str,
    fields: &[(&'static str, Value)],
) {
    let fields = fields.iter();
    let fields = fields
        .map(|(name, value)| ((*name).into(), value.clone()))
        .collect();
    let name = order.into();
    world.input(robot, &Input::Order(Order { name, fields }));
}

/// How often a robot has started again.
fn resets(world: &World, robot: u32) -> usize {
    let emitted = world.emitted(robot);
    emitted.iter().filter(|(name, _)| name == "reset").count()
}

fn corrupted(order: &'static str, fields: &[(&'static str, Value)]) -> World {
    let code = compile(GUARDED);
    let mut world = World::of(&code, 1);
    world.steps(3);
    assert_eq!(world.int(0, "count"), 3);
    overwrite(&mut world, 0, order, fields);
    world
}

#[test]
fn a_value_out_of_range_gives_way_to_the_first_value() {
    let mut world = corrupted("put", &[("number", (-4_i64).into())]);
    world.step();
    assert_eq!(world.int(0, "count"), 1);
    assert_eq!(world.int(0, "starts"), 7);
    assert_eq!(resets(&world, 0), 1);
    let (name, fields) = &world.emitted(0)[0];
    assert_eq!(name, "reset");
    let place = format!("{:?}", fields[0].1);
    assert!(place.contains("guarded.starl:7:12"), "{place}");
    let failed = world.program(0).failed_check();
    assert!(failed.is_some_and(|at| at.ends_with("guarded.starl:7:12 (count = -4, most = 5)")));
    // It is not repeated.
    world.steps(3);
    assert_eq!(resets(&world, 0), 1);
    assert_eq!(world.int(0, "count"), 4);
}

#[test]
fn a_check_that_cannot_be_computed_is_false() {
    let mut world = corrupted("empty", &[]);
    world.step();
    assert_eq!(world.failure(0), None);
    assert_eq!(world.get(0, "list").to_string(), "[1, 2]");
    assert_eq!(resets(&world, 0), 1);
}

#[test]
fn valid_variables_are_kept() {
    let mut world = corrupted("put", &[("number", 1_i64.into())]);
    world.step();
    assert_eq!(world.int(0, "count"), 2);
    assert_eq!(resets(&world, 0), 0);
}

#[test]
fn primitives_stop_their_work() {
    // To ask for a second resource while the first is held is an error.
    let source = GUARDED.replace("mux.acquire({\"a\"})", "mux.acquire({String(now)})");
    let source = source.replace("pre not motion.active", "pre count == 0");
    let mut world = World::of(&compile(&source), 1);
    world.steps(2);
    overwrite(&mut world, 0, "empty", &[]);
    world.step();
    assert_eq!(world.failure(0), None);
    assert_eq!((world.int(0, "starts"), world.int(0, "count")), (7, 1));
    let commands = world.actions(0).into_iter().filter(|name| name == "go");
    assert_eq!(commands.count(), 2);
}

#[test]
fn checks_hold_after_an_activation_for_any_corruption() {
    let code = compile(GUARDED);
    for seed in 0..200 {
        let mut world = World::of(&code, 1);
        world.steps(2);
        world.corrupt(0, &mut Random::keyed(seed, &[1]));
        world.step();
        assert_eq!(world.failure(0), None, "seed {seed}");
        assert!((0..=5).contains(&world.int(0, "count")), "seed {seed}");
        let target = world.program(0).target();
        assert!(
            target.is_none_or(|at| at == Point::planar(3.0, 0.0)),
            "seed {seed}: {target:?}"
        );
    }
}

#[test]
fn checks_are_made_before_handlers_too() {
    let code = compile(
        "program Talk

message Say(number: Int)

radio = Broadcast()
count: Int in 0..1000 = 0
heard: Int = 0
said: Bool = false

say()
    pre me == [r for r in peers].first() and not said
    eff radio.broadcast(Say(1)); said = true

on Say(_, number)
    count += number; heard += 1

on input put(number: Int)
    count = number
",
    );
    let mut world = World::of(&code, 2);
    overwrite(&mut world, 1, "put", &[("number", (-50_i64).into())]);
    world.step();
    assert_eq!(resets(&world, 1), 1);
    assert_eq!(world.int(1, "heard"), 1);
    assert_eq!(world.int(1, "count"), 1);
}
