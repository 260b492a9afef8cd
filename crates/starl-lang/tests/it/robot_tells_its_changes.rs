//! The version of a program's variables is another one whenever they may have changed.

use crate::robot_support::{self, World, compile};
use starl_core::Random;

const CHANGES: &str = "program Changes

message Add(number: Int)

radio = Broadcast()
count: Int = 0

add()
    pre count < 2 and robot_name(me) == \"robot0\"
    eff count += 1; radio.broadcast(Add(count))

on Add(from, number)
    count += number
";

#[test]
fn it_changes_exactly_with_each_change_of_the_state() {
    let mut world = World::of(&compile(CHANGES), 2);
    let versions = |world: &World| [0, 1].map(|robot| world.program(robot).version());
    let started = versions(&world);
    world.steps(3);
    let later = versions(&world);
    assert_ne!(later[0], started[0]);
    assert_ne!(later[1], started[1]);
    assert_eq!((world.int(0, "count"), world.int(1, "count")), (2, 3));
    world.steps(3);
    assert_eq!(versions(&world), later);
    world.corrupt(0, &mut Random::keyed(1, &[]));
    assert_ne!(versions(&world)[0], later[0]);
}

#[test]
fn a_run_after_a_crash_has_versions_of_its_own() {
    let code = compile(CHANGES);
    let mut world = World::of(&code, 2);
    let mut seen = vec![world.program(0).version()];
    world.step();
    seen.push(world.program(0).version());
    world.restart(0, robot_support::program(&code));
    assert!(!seen.contains(&world.program(0).version()));
}
