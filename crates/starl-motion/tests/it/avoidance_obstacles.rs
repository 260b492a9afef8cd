//! No robot touches an obstacle, with any target: inertia and overshooting are taken into account.

use crate::avoidance_world::scenes::{AGILE, at, from_to, place_for, radius, strewn};
use crate::avoidance_world::{EXACT, Placed, Positioning, Scene, VICINITY, World};
use starl_core::{Obstacle, Point, Random};

/// The half-plane beyond x = 0, as a wall.
fn wall() -> Obstacle {
    Obstacle::cuboid(Point::new(0.0, -3.0, 0.0), Point::new(0.3, 3.0, 3.0))
}

/// Estimates: exact, and with noise of 5 mm, for so many seeds.
fn runs(seeds: u64) -> impl Iterator<Item = (Positioning, u64)> {
    (0..seeds).flat_map(|seed| [0.0, 0.005].map(|noise| (Positioning { noise, ..EXACT }, seed)))
}

fn models() -> impl Iterator<Item = &'static str> {
    AGILE.into_iter().chain(["car"])
}

fn alone(robot: Placed, obstacles: &[Obstacle]) -> Scene {
    Scene {
        robots: vec![robot],
        obstacles: obstacles.to_vec(),
    }
}

#[test]
fn driven_straight_at_a_wall_it_stops_before_it() {
    for model in models() {
        for (positioning, seed) in runs(20) {
            // A waypoint behind the wall, which no planner would give.
            let robot = from_to(model, (-3.0, 0.2), (3.0, 0.0));
            let mut world = World::new(&alone(robot, &[wall()]), positioning, seed);
            world.run_for(20.0);
            world.must_be_clear();
            let gap = -world.robots[0].position().x - radius(model);
            assert!(gap < 0.3, "{model}, seed {seed}: gave up {gap} m before it");
        }
    }
}

#[test]
fn without_avoidance_it_would_hit_the_wall() {
    for model in AGILE {
        let robot = from_to(model, (-3.0, 0.2), (3.0, 0.0));
        let mut world = World::with_options(&alone(robot, &[wall()]), EXACT, 0, None);
        world.run_for(20.0);
        assert!(
            world.least_obstacle_gap < 0.0,
            "{model}: this shows nothing"
        );
    }
}

#[test]
fn along_a_wall_it_keeps_off_and_arrives() {
    for model in AGILE {
        let beside = -radius(model) - 0.05;
        for (positioning, seed) in runs(20) {
            let robot = from_to(model, (beside, -2.5), (beside, 2.5));
            World::new(&alone(robot, &[wall()]), positioning, seed).must_arrive(60.0);
        }
    }
}

#[test]
fn round_a_corner_it_does_not_cut() {
    for model in AGILE {
        let off = radius(model) + 0.03;
        for (positioning, seed) in runs(20) {
            let robot = from_to(model, (-off, 0.0), (-off, 3.0 + off));
            let mut world = World::new(&alone(robot, &[wall()]), positioning, seed);
            // It sets out for the second as soon as it is near the first, beside the corner.
            for (x, y) in [(-off, 3.0 + off), (2.0, 3.0 + off)] {
                let goal = at(model, x, y);
                world.robots[0].send(goal);
                while world.robots[0].position().planar_distance(goal) > VICINITY {
                    world.step();
                    assert!(world.seconds() < 60.0, "{model}, seed {seed}: stuck");
                }
            }
            world.must_be_clear();
        }
    }
}

#[test]
fn halted_beside_a_wall_it_does_not_drift_into_it() {
    for model in models() {
        for (positioning, seed) in runs(40) {
            let robot = from_to(model, (-2.0, -2.5), (3.0, 2.0));
            let mut world = World::new(&alone(robot, &[wall()]), positioning, seed);
            // Any moment from cruising to sliding along the wall.
            world.run_for(0.5 + seed as f64 * 0.1);
            world.robots[0].halt();
            world.run_for(5.0);
            world.must_be_clear();
        }
    }
}

#[test]
fn a_target_one_centimetre_from_a_wall_is_reached() {
    for model in AGILE {
        for seed in 0..5 {
            let robot = from_to(model, (-2.0, 0.5), (-radius(model) - 0.01, 0.0));
            World::new(&alone(robot, &[wall()]), EXACT, seed).must_arrive(40.0);
        }
    }
}

#[test]
fn among_pillars_and_each_other_they_never_touch_anything() {
    let pillar = |x: f64, y: f64| Obstacle::circle(Point::planar(x, y), 0.2);
    let pillars = [pillar(-1.0, -1.0), pillar(1.0, 0.8), wall()];
    for model in models() {
        for (positioning, seed) in runs(15) {
            let mut world = World::new(&strewn(&[model], 5, &pillars, seed), positioning, seed);
            let mut random = Random::keyed(seed, &[4]);
            for _ in 0..60 {
                world.run_for(1.0);
                for robot in &mut world.robots {
                    if robot.position().planar_distance(robot.goal) < VICINITY {
                        robot.send(place_for(model, &mut random, &pillars));
                    }
                }
            }
            world.must_be_clear();
        }
    }
}
