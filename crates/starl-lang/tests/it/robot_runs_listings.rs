//! The programs of the language's listings run on robots with their primitives.

use crate::robot_support::{World, compile};
use starl_lang::machine::Value;

#[test]
fn race_is_run_to_its_end() {
    let code = compile(include_str!("../listings/race.starl"));
    let places = [(1.0, 0.0), (2.0, 1.0), (0.0, 3.0)];
    let mut world = World::of(&code, 3).with_way_points(&places);
    world.steps(20);
    for robot in 0..3 {
        assert_eq!(world.failure(robot), None);
        assert_eq!(world.int(robot, "currentIndex"), 3);
    }
    assert_eq!(world.actions(0)[..3], ["initialize", "pick", "wait"]);
}

#[test]
fn a_formation_forms_by_shared_positions() {
    let code = compile(include_str!("../listings/formation.starl"));
    let mut world = World::of(&code, 3);
    for (robot, x) in [(0, 0.0), (1, 2.0), (2, 1.0)] {
        world.put(robot, starl_core::Point::planar(x, 0.3 * x));
    }
    let before: Vec<_> = (0..3).map(|robot| world.position(robot)).collect();
    world.steps(60);
    for (robot, before) in before.iter().enumerate() {
        assert_eq!(world.failure(robot), None);
        assert_ne!(world.position(robot), *before, "robot {robot} stays");
    }
}

/// Figure 5.2: the vehicles of figure 5.3 register, and cross without two of them in one zone.
#[test]
fn registered_vehicles_cross_an_intersection() {
    let code = compile(include_str!("../listings/intersection.starl"));
    let mut world = World::of(&code, 4);
    // The zones of arrival C0, D0, B0 and A0; the destination of all is D1, to the right, ahead or left.
    for (robot, (x, y)) in [(-1.5, -0.5), (0.5, -1.5), (1.5, 0.5), (-0.5, 1.5)]
        .into_iter()
        .enumerate()
    {
        world.put(robot, starl_core::Point::planar(x, y));
    }
    let is_at = |world: &World, robot: usize, location: &str| {
        world.get(robot, "loc") == Value::Variant(location.into())
    };
    let (mut steps, mut listed) = (0, [false; 4]);
    while (0..4).any(|robot| !is_at(&world, robot, "s1")) {
        world.step();
        steps += 1;
        assert!(steps < 600, "they do not come through");
        for (robot, listed) in listed.iter_mut().enumerate() {
            assert_eq!(world.failure(robot), None);
            *listed |= is_at(&world, robot, "mov_wait");
        }
    }
    assert_eq!(listed, [true; 4]);
}
