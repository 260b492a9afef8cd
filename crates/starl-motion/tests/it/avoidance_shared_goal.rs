//! All robots have the same target, as in Race: the first robot gets there, repeatedly, without
//! collisions, and the second waits at a distance.

use crate::avoidance_world::scenes::{AGILE, at, from_to, radius, shared_goal};
use crate::avoidance_world::{EXACT, Scene, VICINITY, World, runs};

/// Where the waypoints of a lap are, metres.
const LAP: [(f64, f64); 4] = [(0.0, 0.0), (1.5, 1.0), (-1.5, 1.0), (0.0, -1.8)];

/// Sends all to the waypoints of a lap in turn; at each, the first to arrive sets off the next leg.
fn race(model: &'static str, count: u32, bound: f64) {
    for (positioning, seed) in runs(12) {
        let mut world = World::new(&shared_goal(model, count, seed), positioning, seed);
        for (x, y) in LAP {
            let goal = at(model, x, y);
            let start = world.seconds();
            world.robots.iter_mut().for_each(|robot| robot.send(goal));
            let there = |world: &World| {
                let mut robots = world.robots.iter();
                robots.any(|robot| robot.position().planar_distance(goal) < VICINITY)
            };
            while !there(&world) {
                world.step();
                let leg = world.seconds() - start;
                assert!(
                    leg < bound,
                    "{model}, {count}, {positioning:?}, seed {seed}: {leg} s"
                );
            }
        }
        world.must_be_clear();
    }
}

#[test]
fn the_first_of_six_arrives_at_each_waypoint() {
    for model in AGILE {
        race(model, 6, 40.0);
    }
}

#[test]
fn the_first_of_twelve_arrives_at_each_waypoint() {
    for model in ["create", "holonomic", "differential"] {
        race(model, 12, 60.0);
    }
}

#[test]
fn the_second_leaves_the_first_room_to_go() {
    for model in AGILE {
        let scene = Scene {
            robots: vec![
                from_to(model, (0.0, 0.0), (0.0, 0.0)),
                from_to(model, (-1.5, 0.0), (0.0, 0.0)),
            ],
            ..Scene::default()
        };
        let mut world = World::new(&scene, EXACT, 0);
        let touching = 2.0 * radius(model);
        // It takes 8 s at most to get near, and waits for 6 s at least.
        while world.robots[1].position().planar_length() > touching + 0.3 {
            world.step();
            assert!(world.seconds() < 20.0, "{model}: does not come");
        }
        for _ in 0..300 {
            world.step();
            let gap = world.robots[0].gap(&world.robots[1]);
            assert!(gap > 0.1, "{model}: {gap} m at {} s", world.seconds());
        }
    }
}
