//! A robot that lands on another, which drives away under it, is stopped like any other: their bodies do not overlap,
//! although their centres move apart.

use crate::engine_support::{scenario, simulate};
use starl_core::motion::Body;
use starl_core::{Command, Point, Pose, Primitives, Program, Robot, RobotId};
use starl_motion::models;

/// Robots on the floor drive straight on, those in the air land.
#[derive(Clone, Primitives)]
struct LandOrLeave;

impl Program for LandOrLeave {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        robot.drive(match robot.body().flies() {
            true => Command::Land,
            false => Command::Straight { speed: 0.3 },
        });
    }
}

/// How deep two bodies overlap, sideways or in height, whichever is less; negative if they do not.
fn overlap((a, here): (&Body, Point), (b, there): (&Body, Point)) -> f64 {
    let sideways = a.radius + b.radius - here.planar_distance(there);
    let in_height = (here.z + a.height).min(there.z + b.height) - here.z.max(there.z);
    sideways.min(in_height)
}

#[test]
fn a_drone_that_lands_on_a_departing_robot_does_not_enter_it() {
    let mut stopped = 0;
    for centimetres in 0..50 {
        let mut scenario = scenario("create", &[(0.0, 0.0)]);
        let mut flying = scenario.fleet.groups[0].clone();
        flying.name = "drone".into();
        flying.model = models::by_name("drone").expect("a model");
        let above = Point::new(-f64::from(centimetres) / 100.0, 0.0, 0.5);
        flying.starts = vec![Pose::level(above, 0.0)];
        scenario.fleet.groups.push(flying);
        let bodies = [0, 1].map(|group| scenario.fleet.groups[group].model.body());
        let mut simulation = simulate(scenario, LandOrLeave);
        for _ in 0..200 {
            simulation.step();
            let at = |robot| simulation.state(RobotId(robot)).pose.position;
            let depth = overlap((&bodies[0], at(0)), (&bodies[1], at(1)));
            assert!(depth < 0.001, "{centimetres} cm: {depth} m deep");
        }
        stopped += simulation.tally().collisions;
    }
    assert!(stopped > 0, "some of them met");
}
