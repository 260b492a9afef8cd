//! A robot that is alone, with exact positions, follows its path round a pillar without touching it, with or without
//! avoidance: paths keep the body's radius clear, and the robot follows them.

use crate::engine_support::{self, obstacle, scenario, simulate};
use starl_core::{Event, Obstacle, Point, Primitives, Program, Robot};
use starl_primitives::ReachAvoid;

/// Goes to the other side.
#[derive(Clone, Default, Primitives)]
struct Passer(ReachAvoid);

impl Program for Passer {
    fn start(&mut self, robot: &mut Robot<'_>) {
        let target = Point::planar(5.0, 0.0);
        self.0.reach_avoid(robot, target, robot.obstacles());
    }

    fn activate(&mut self, robot: &mut Robot<'_>) {
        if self.0.done() {
            robot.finish();
        }
    }
}

/// Collisions on the way round a pillar of this radius in metres, and whether it arrived.
fn pass(model: &str, radius: f64, seed: u64, avoids: bool) -> (usize, bool) {
    let mut scenario = scenario(model, &[(-0.5, 0.0)]);
    scenario.seed = seed;
    let pillar = Obstacle::circle(Point::planar(2.0, 0.0), radius);
    scenario.world.obstacles.push(obstacle(pillar));
    if !avoids {
        scenario.motion.avoidance = None;
    }
    let mut simulation = simulate(scenario, Passer::default());
    let records = engine_support::run(&mut simulation, 60.0);
    let collided = |event: &Event| matches!(event, Event::Collided { .. });
    let arrived = engine_support::count(&records, |event| *event == Event::Finished) == 1;
    (engine_support::count(&records, collided), arrived)
}

#[test]
fn every_model_arrives_untouched() {
    for model in ["create", "differential", "holonomic", "car", "drone"] {
        for decimetres in [2, 4, 6, 8, 10, 13] {
            for (seed, avoids) in [(1, true), (1, false), (2, true), (2, false)] {
                let radius = f64::from(decimetres) / 10.0;
                let passed = pass(model, radius, seed, avoids);
                let told = format!("{model}, pillar of {radius} m, seed {seed}, avoids: {avoids}");
                assert_eq!(passed, (0, true), "{told}: collisions, arrived");
            }
        }
    }
}
