//! A run-time error stops the program of one robot, and the robot itself, and says where in the source it happened. The
//! others continue.

use crate::robot_support::{World, compile};

const INDEX: &str = "program Index

numbers: List[Int] = [1, 2, 3]
index: Int = 0
last: Int = 0

next()
    pre robot_name(me) == \"robot0\"
    eff index += 2

read()
    eff
        emit(\"reads\", index = index)
        last = numbers[index]

after()
    eff emit(\"after\")
";

#[test]
fn the_error_names_the_line_and_the_others_continue() {
    let mut world = World::of(&compile(INDEX), 2);
    world.steps(4);
    let reason = world.failure(0).unwrap_or_default();
    assert_eq!(reason, "index.starl:14:16: index 4 is out of range 0..3");
    assert_eq!(world.robots[0].travel.halts, 1);
    let names = |robot| {
        let emitted = world.emitted(robot);
        emitted
            .into_iter()
            .map(|(name, _)| name)
            .collect::<Vec<_>>()
    };
    // Nothing runs after the error, neither of this activation nor later.
    assert_eq!(names(0), ["reads", "after", "reads"]);
    assert_eq!(world.failure(1), None);
    assert_eq!(names(1).len(), 8);
}

const FAILS: &str = "program Fails

tries: Int = 0

attempt()
    eff
        tries += 1
        if tries == 2
            fail(\"no way\")
            tries = 100

other()
    eff emit(\"on\")
";

#[test]
fn a_program_that_fails_says_why_and_ends_there() {
    let mut world = World::of(&compile(FAILS), 1);
    world.steps(3);
    assert_eq!(world.failure(0), Some("no way"));
    assert_eq!(world.robots[0].travel.halts, 1);
    assert_eq!(world.int(0, "tries"), 2);
    assert_eq!(world.emitted(0).len(), 1);
}

#[test]
fn an_activation_that_does_not_end_is_an_error() {
    let endless = "program Endless

function spin(n: Int) -> Int
    return spin(n + 1)

x: Int = 0

turn()
    eff x = spin(0)
";
    let mut world = World::of(&compile(endless), 1);
    world.step();
    let reason = world.failure(0).unwrap_or_default();
    let expected = "endless.starl:4:12: functions call one another too deeply";
    assert_eq!(reason, expected);
}

#[test]
fn a_primitive_that_cannot_be_bound_so_is_an_error_at_its_binding() {
    let wrong = "program Wrong

param near: Float = 0m

motion = ReachAvoid(vicinity = near)

go()
    pre not motion.active
    eff motion.reach_avoid(Point(1.0, 1.0), obstacles())
";
    let world = World::of(&compile(wrong), 1);
    let reason = world.failure(0).unwrap_or_default();
    assert!(
        reason.ends_with("`vicinity` is not more than 0"),
        "{reason}"
    );
    assert!(reason.starts_with("wrong.starl:5:"), "{reason}");
    let twice = "program Twice

message M()

a = Broadcast(\"x\")
b = Unicast(\"x\")

go()
    eff
        a.broadcast(M())
        b.send(me, M())
";
    let world = World::of(&compile(twice), 1);
    let reason = world.failure(0).unwrap_or_default();
    let expected = "another primitive of the program has this name";
    assert!(reason.ends_with(expected), "{reason}");
}
