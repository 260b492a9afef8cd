//! Race on two robots: the first at a waypoint tells the other, both continue and finish.

use crate::robot_support::{World, load, race::RACE};
use starl_core::{Point, Value};

#[test]
fn both_robots_visit_all_waypoints_and_finish() {
    let places = [(1.0, 0.0), (2.0, 1.0), (0.0, 3.0)];
    let mut world = World::of(&load(RACE), 2).with_way_points(&places);
    world.steps(20);
    for robot in 0..2 {
        assert_eq!(world.int(robot, "currentIndex"), 3);
        assert!(world.robots[robot].node.condition().finished);
        assert_eq!(world.failure(robot), None);
    }
    let actions = world.actions(0);
    assert_eq!(&actions[..3], ["initialize", "pick", "wait"]);
    assert_eq!(actions.last().map(String::as_str), Some("finish"));
    let (name, fields) = &world.emitted(0)[0];
    assert_eq!(name, "arrived");
    assert_eq!(fields[..], [("index".to_string(), Value::Int(0))]);
    assert_eq!(world.position(0), Point::planar(0.0, 3.0));
}
