//! Shared variables: the writes of one robot reach the others.

use crate::robot_support::{World, compile};
use starl_core::{Duration, Event, Port, Time};
use starl_lang::machine::Value;

const SHARED: &str = r#"
program Shared

record Place {name: String, at: Point}

allread places[RobotId]: Place
allwrite counter: Int = 7
allwrite note: String

known: Int = 0
other: String = ""
count: Int = 0
last: String = ""

tell()
    pre places[me] == none
    eff
        places[me] = Place(robot_name(me), Point(1.0, 2.0))
        if robot_name(me) == "robot1"
            counter = 100
            note = "written"

look()
    eff
        known = places.size()
        count = counter
        last = note ?? "nothing"
        for r, place in places
            if r != me
                other = place.name
"#;

#[test]
fn an_initial_value_is_read_before_any_write() {
    let mut world = World::of(&compile(SHARED), 1);
    world.step();
    assert_eq!(world.int(0, "count"), 7);
    assert_eq!(world.get(0, "last"), Value::Text("nothing".into()));
    assert_eq!(world.int(0, "known"), 1);
}

#[test]
fn a_robot_reads_the_writes_of_another() {
    let mut world = World::of(&compile(SHARED), 2);
    world.steps(3);
    for robot in 0..2 {
        assert_eq!(world.int(robot, "count"), 100);
        assert_eq!(world.get(robot, "last"), Value::Text("written".into()));
        assert_eq!(world.int(robot, "known"), 2);
    }
    assert_eq!(world.get(0, "other"), Value::Text("robot1".into()));
    assert_eq!(world.get(1, "other"), Value::Text("robot0".into()));
}

#[test]
fn lost_writes_are_repaired() {
    let mut world = World::of(&compile(SHARED), 2);
    world.wire.loss = 1.0;
    world.steps(5);
    assert_eq!(world.int(0, "known"), 1);
    assert_eq!(world.int(0, "count"), 7);
    world.wire.loss = 0.0;
    world.steps(100);
    assert_eq!(world.int(0, "known"), 2);
    assert_eq!(world.int(0, "count"), 100);
}

#[test]
fn all_shared_variables_are_one_memory_and_go_out_together() {
    let mut world = World::of(&compile(SHARED), 2);
    world.run_before(Time::ZERO + Duration::from_millis(1));
    let before = world.records.len();
    world.step();
    let port = Port::named("Shared/shared");
    let sent = world.records[before..].iter();
    let writes = sent.filter(|(_, from, event)| {
        from.0 == 1 && matches!(event, Event::Sent { port: to, .. } if *to == port)
    });
    // One datagram holds all three writes.
    assert_eq!(writes.count(), 1);
}
