//! A robot that crashed starts again with a fresh copy of its program; the others hear it.

use crate::robot_support::{World, compile};
use starl_core::Input;
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
fn a_restarted_program_keeps_its_parameters_and_is_heard() {
    let code = compile(COUNTER);
    let program = |step| RobotProgram::new(&code, &[("step", Value::Int(step))]).unwrap();
    let mut world = World::new(vec![program(5), program(1)]);
    world.steps(2);
    assert_eq!(world.int(0, "count"), 10);
    let fresh = program(5);
    assert!(!fresh.has_started());
    world.restart(0, fresh);
    assert!(world.program(0).has_started());
    assert_eq!(world.int(0, "count"), 0);
    world.steps(2);
    assert_eq!(world.get(1, "heard").to_string(), "[5, 10, 5, 10]");
}

#[test]
fn starting_the_same_program_again_resets_it() {
    let mut world = World::of(&compile(COUNTER), 2);
    world.steps(3);
    world.input(0, &Input::Start);
    assert_eq!(world.failure(0), None);
    assert_eq!(world.int(0, "count"), 0);
    world.steps(1);
    assert_eq!(world.get(1, "heard").to_string(), "[1, 2, 3, 1]");
}

#[test]
fn copies_go_their_own_ways() {
    let mut world = World::of(&compile(COUNTER), 1);
    world.steps(2);
    let copy = world.robots[0].node.clone();
    world.steps(3);
    assert_eq!(world.int(0, "count"), 5);
    world.robots[0].node = copy;
    assert_eq!(world.int(0, "count"), 2);
}
