//! A robot that crashed starts again with a fresh copy of its program; the others hear it.

use crate::robot_support::{World, compile};
use starl_core::{Agent, Input, Random};
use starl_lang::machine::Value;
use starl_lang::robot::RobotProgram;

const COUNTER: &str = r#"
program Counter

message Count(number: Int)

param step: Int = 1

radio = Broadcast()
allwrite board: Int = 0
count: Int = 0
heard: List[Int] = []

tick()
    eff
        count += step
        radio.broadcast(Count(count))

on Count(from, number)
    heard.add(number)
"#;

#[test]
fn it_begins_anew_with_its_parameters_and_is_heard() {
    let code = compile(COUNTER);
    let program = |step| RobotProgram::new(&code, &[("step", Value::Int(step))]).unwrap();
    let mut world = World::new(vec![program(5), program(1)]);
    world.steps(2);
    assert_eq!(world.int(0, "count"), 10);
    let fresh = Agent::new(Box::new(program(5)), Random::keyed(7, &[0]));
    world.nodes[0].agent = fresh;
    assert!(!world.program(0).has_started());
    world.feed(0, &Input::Start);
    assert!(world.program(0).has_started());
    assert_eq!(world.int(0, "count"), 0);
    world.steps(2);
    assert_eq!(world.get(1, "heard").to_string(), "[5, 10, 5, 10]");
}

#[test]
fn starting_the_same_program_again_is_starting_anew() {
    let mut world = World::of(&compile(COUNTER), 2);
    world.steps(3);
    world.feed(0, &Input::Start);
    assert_eq!(world.nodes[0].failed, None);
    assert_eq!(world.int(0, "count"), 0);
    world.steps(1);
    assert_eq!(world.get(1, "heard").to_string(), "[1, 2, 3, 1]");
}

#[test]
fn copies_go_their_own_ways() {
    let mut world = World::of(&compile(COUNTER), 1);
    world.steps(2);
    let copy = world.nodes[0].agent.clone();
    world.steps(3);
    assert_eq!(world.int(0, "count"), 5);
    world.nodes[0].agent = copy;
    assert_eq!(world.int(0, "count"), 2);
}
