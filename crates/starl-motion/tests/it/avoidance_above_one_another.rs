//! Robots above one another need not avoid each other in the plane, and do not climb or sink into each
//! other.

use crate::avoidance_world::scenes::from_to;
use crate::avoidance_world::{EXACT, Placed, Scene, World, runs};
use starl_core::Point;

/// A drone that goes from one place in the air to another.
fn drone(start: (f64, f64, f64), goal: (f64, f64, f64)) -> Placed {
    Placed {
        model: "drone",
        start: Point::new(start.0, start.1, start.2),
        goal: Point::new(goal.0, goal.1, goal.2),
    }
}

fn scene(robots: Vec<Placed>) -> Scene {
    Scene {
        robots,
        ..Scene::default()
    }
}

#[test]
fn drones_at_different_heights_fly_straight_on() {
    let alone = scene(vec![drone((0.0, 0.0, 0.6), (4.0, 0.0, 0.6))]);
    let alone = World::new(&alone, EXACT, 0).run(30.0).expect("alone");
    let both = scene(vec![
        drone((0.0, 0.0, 0.6), (4.0, 0.0, 0.6)),
        drone((4.0, 0.0, 1.2), (0.0, 0.0, 1.2)),
    ]);
    for (positioning, seed) in runs(20) {
        let mut world = World::new(&both, positioning, seed);
        world.must_arrive(alone + 0.5);
    }
}

#[test]
fn a_ground_robot_drives_under_a_hovering_drone() {
    let robots = vec![
        from_to("create", (0.0, 0.0), (2.0, 0.0)),
        drone((1.0, 0.0, 0.6), (1.0, 0.0, 0.6)),
    ];
    for (positioning, seed) in runs(20) {
        World::new(&scene(robots.clone()), positioning, seed).must_arrive(20.0);
    }
}

#[test]
fn a_drone_does_not_sink_onto_another() {
    for (positioning, seed) in runs(20) {
        let robots = vec![
            drone((0.0, 0.0, 0.6), (0.0, 0.0, 0.6)),
            drone((0.05, 0.0, 1.5), (0.05, 0.0, 0.6)),
        ];
        let mut world = World::new(&scene(robots), positioning, seed);
        world.run_for(20.0);
        world.must_be_clear();
        let free = world.robots[1].position().z - world.robots[0].position().z - 0.13;
        assert!(free > 0.05, "seed {seed}: {free} m between them");
    }
}

#[test]
fn a_drone_does_not_climb_into_one_above() {
    for (positioning, seed) in runs(20) {
        let robots = vec![
            drone((0.0, 0.0, 1.5), (0.0, 0.0, 1.5)),
            drone((0.05, 0.0, 0.6), (0.05, 0.0, 1.5)),
        ];
        let mut world = World::new(&scene(robots), positioning, seed);
        world.run_for(20.0);
        world.must_be_clear();
    }
}

#[test]
fn a_drone_does_not_take_off_under_another() {
    for (positioning, seed) in runs(20) {
        let robots = vec![
            drone((0.0, 0.0, 0.55), (0.0, 0.0, 0.55)),
            drone((0.1, 0.0, 0.0), (3.0, 0.0, 0.5)),
        ];
        let mut world = World::new(&scene(robots), positioning, seed);
        world.robots[0].halt();
        world.run_for(10.0);
        world.must_be_clear();
        let up = world.robots[1].position().z;
        assert!(up == 0.0, "seed {seed}: at {up} m");
    }
}

#[test]
fn drones_that_change_heights_and_places_never_collide() {
    for (positioning, seed) in runs(30) {
        let corner = |index: u32, high: bool| {
            let (x, y) = [(-1.5, -1.5), (1.5, -1.5), (1.5, 1.5), (-1.5, 1.5)][index as usize % 4];
            (x, y, if high { 1.5 } else { 0.5 })
        };
        let robots = (0..8).map(|index| {
            let high = index >= 4;
            drone(corner(index, high), corner(index + 2, !high))
        });
        let mut world = World::new(&scene(robots.collect()), positioning, seed);
        world.run_for(60.0);
        world.must_be_clear();
    }
}
