//! Robots drive round a robot that does not move, such as a crashed one.

use crate::avoidance_world::scenes::{AGILE, from_to, one_in_the_way};
use crate::avoidance_world::{self, EXACT, Scene, World, runs};

#[test]
fn a_halted_robot_is_driven_round() {
    for model in AGILE {
        for (positioning, seed) in runs(30) {
            let mut world = World::new(&one_in_the_way(model), positioning, seed);
            world.robots[1].halt();
            world.must_arrive(40.0);
        }
    }
}

#[test]
fn a_robot_that_halts_on_the_way_is_passed() {
    for model in AGILE {
        for seed in 0..30 {
            let scene = avoidance_world::scenes::head_on(model);
            let mut world = World::new(&scene, EXACT, seed);
            while world.robots[1].position().x > 3.0 {
                world.step();
            }
            world.robots[1].halt();
            world.must_arrive(90.0);
        }
    }
}

#[test]
fn a_robot_that_stands_on_the_goal_is_not_pushed() {
    for model in AGILE {
        for (positioning, seed) in runs(6) {
            let robots = vec![
                from_to(model, (0.0, 0.0), (2.0, 0.0)),
                from_to(model, (2.0, 0.0), (2.0, 0.0)),
            ];
            let scene = Scene {
                robots,
                ..Scene::default()
            };
            let mut world = World::new(&scene, positioning, seed);
            world.robots[1].halt();
            world.run_for(90.0);
            world.must_be_clear();
            assert!(!world.robots[0].arrived, "{model}: through another body");
        }
    }
}
