//! Mutex in programs: figure 3.1 on several robots, and what a program gets wrong with it.

use crate::robot_support::{World, compile};
use starl_core::sensor::{Detected, Detection};
use starl_core::{Point, RobotId};

/// The thesis's figure 3.1, with what it leaves out: the use of the resources takes five activations.
const USAGE: &str = r#"
program MutexUsage

mux = Mutex("0", peers)
myreq: Set[String] = {"a", "b"}
asked: Bool = false
left: Int = 5
uses: Int = 0

start()
    pre not asked
    eff mux.acquire(myreq); asked = true

use()
    pre mux.held(myreq)
    eff
        left -= 1
        if left == 0
            mux.release(myreq)
            left = 5
            uses += 1
            asked = false

retry()
    pre mux.failed
    eff asked = false
"#;

/// The robots that use the resources now.
fn users(world: &World, robots: usize) -> usize {
    let uses = |&robot: &usize| world.int(robot, "left") < 5;
    (0..robots).filter(uses).count()
}

#[test]
fn one_robot_at_a_time_uses_them_and_all_have_their_turns() {
    let mut world = World::of(&compile(USAGE), 4);
    for _ in 0..300 {
        world.step();
        assert!(users(&world, 4) <= 1);
    }
    for robot in 0..4 {
        assert!(world.int(robot, "uses") >= 5, "robot {robot}");
    }
}

#[test]
fn lost_messages_delay_it_and_break_nothing() {
    let mut world = World::of(&compile(USAGE), 3);
    world.steps(20);
    let before: i64 = (0..3).map(|robot| world.int(robot, "uses")).sum();
    world.wire.loss = 1.0;
    for _ in 0..20 {
        world.step();
        assert!(users(&world, 3) <= 1);
    }
    world.wire.loss = 0.0;
    for _ in 0..200 {
        world.step();
        assert!(users(&world, 3) <= 1);
    }
    let after: i64 = (0..3).map(|robot| world.int(robot, "uses")).sum();
    assert!(after >= before + 10, "{before}, then {after}");
}

#[test]
fn a_holder_that_requests_more_gets_an_error() {
    let source = "program Greedy\nmux = Mutex(\"0\")\nfirst()\n    pre not mux.held({\"a\"})\n    \
                  eff mux.acquire({\"a\"})\nmore()\n    pre mux.held({\"a\"})\n    \
                  eff mux.acquire({\"b\"})\n";
    let mut world = World::of(&compile(source), 2);
    world.steps(20);
    let text = (0..2).find_map(|robot| world.failure(robot));
    let text = text.expect("a robot stops");
    assert!(text.contains("already holds resources"), "{text}");
}

const PLACES: &str = r#"
program Places

param patience: Duration = 30s

mux = Mutex("0", {}, places = {"gate": circle(Point(3.0, 0.0), 1m)}, patience = patience)
has: Bool = false

ask()
    pre not mux.waiting and not mux.held({"gate"})
    eff mux.acquire({"gate"})

note()
    pre has != mux.held({"gate"})
    eff has = not has
"#;

#[test]
fn a_place_is_held_while_no_other_robot_is_seen_there() {
    let mut world = World::of(&compile(PLACES), 1);
    world.steps(3);
    assert_eq!(world.get(0, "has").to_string(), "true");
    world.robots[0].detections = vec![Detection {
        what: Detected::Robot(RobotId(1)),
        position: Point::planar(2.5, 0.0),
    }];
    world.steps(1);
    assert_eq!(world.get(0, "has").to_string(), "false");
    world.robots[0].detections.clear();
    world.steps(2);
    assert_eq!(world.get(0, "has").to_string(), "true");
}
