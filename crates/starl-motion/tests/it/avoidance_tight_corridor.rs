//! A corridor that leaves 15 mm on each side, less than robots keep from obstacles, is passed: a path
//! leads through it.

use crate::avoidance_world::scenes::{AGILE, at, corridor, from_to};
use crate::avoidance_world::{EXACT, Scene, VICINITY, World};

#[test]
fn a_corridor_of_fifteen_millimetres_is_passed() {
    for model in AGILE {
        for seed in 0..30 {
            let scene = Scene {
                robots: vec![from_to(model, (-2.5, 0.0), (-1.0, 0.0))],
                obstacles: corridor(model, 0.015),
            };
            let mut world = World::new(&scene, EXACT, seed);
            for x in [-1.0, 0.0, 1.0, 2.5] {
                let goal = at(model, x, 0.0);
                world.robots[0].send(goal);
                while world.robots[0].position().planar_distance(goal) > VICINITY {
                    world.step();
                    assert!(
                        world.seconds() < 120.0,
                        "{model}, seed {seed}: stuck before {x}"
                    );
                }
            }
            world.must_be_clear();
        }
    }
}
