//! The programs of the language's listings run, as far as robots have the primitives for them.
#![cfg(feature = "compiler")]

mod robot_support;

use robot_support::{World, compile};

#[test]
fn race_is_run_to_its_end() {
    let code = compile(include_str!("listings/race.starl"));
    let places = [(1.0, 0.0), (2.0, 1.0), (0.0, 3.0)];
    let mut world = World::of(&code, 3).with_way_points(&places);
    world.steps(20);
    for robot in 0..3 {
        assert_eq!(world.nodes[robot].failed, None);
        assert_eq!(world.int(robot, "currentIndex"), 3);
    }
    assert_eq!(world.actions(0)[..3], ["initialize", "pick", "wait"]);
}

#[test]
fn a_formation_forms_by_shared_positions() {
    let code = compile(include_str!("listings/formation.starl"));
    let mut world = World::of(&code, 3);
    for (robot, x) in [(0, 0.0), (1, 2.0), (2, 1.0)] {
        world.nodes[robot].position = starl_core::Point::planar(x, 0.3 * x);
    }
    let before: Vec<_> = world.nodes.iter().map(|node| node.position).collect();
    world.steps(60);
    for (robot, before) in before.iter().enumerate() {
        assert_eq!(world.nodes[robot].failed, None);
        assert_ne!(world.nodes[robot].position, *before, "robot {robot} stays");
    }
}
