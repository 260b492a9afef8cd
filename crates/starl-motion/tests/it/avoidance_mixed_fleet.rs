//! Robots of all models, of unequal size and speed, on random ways through each other.

use crate::avoidance_world::scenes::{place_for, strewn};
use crate::avoidance_world::{EXACT, Positioning, VICINITY, World, runs};
use starl_core::Random;

/// Radii from 0.085 to 0.34 m, speeds from 0.2 to 1.5 m/s.
const FLEET: [&str; 5] = ["create", "car", "holonomic", "differential", "drone"];

#[test]
fn a_mixed_fleet_never_collides() {
    for (positioning, seed) in runs(30) {
        let mut world = World::new(&strewn(&FLEET, 12, &[], seed), positioning, seed);
        let mut random = Random::keyed(seed, &[3]);
        // A robot that has arrived drives to another place, occupied or not.
        for _ in 0..90 {
            world.run_for(1.0);
            for robot in &mut world.robots {
                if robot.position().planar_distance(robot.goal) < VICINITY {
                    let place = place_for(robot.model.name(), &mut random, &[]);
                    robot.send(place);
                }
            }
        }
        world.must_be_clear();
    }
}

#[test]
fn a_mixed_fleet_gets_where_it_wants() {
    let agile = ["create", "holonomic", "differential", "drone"];
    for (positioning, seed) in runs(25) {
        World::new(&strewn(&agile, 10, &[], seed), positioning, seed).must_arrive(180.0);
    }
}

/// A car stood for ever between robots that were at their goals. It backed straight out and came straight in again, and
/// where it had room in one direction only it did not drive at all.
#[test]
fn a_car_gets_out_from_between_robots_that_stand() {
    let stuck = [
        (31, 0.005),
        (51, 0.0),
        (95, 0.0),
        (95, 0.005),
        (95, 0.01),
        (119, 0.0),
        (136, 0.0),
    ];
    for (seed, noise) in stuck {
        let scene = strewn(&FLEET, 10, &[], seed);
        let positioning = Positioning { noise, ..EXACT };
        World::new(&scene, positioning, seed).must_arrive(900.0);
    }
}
