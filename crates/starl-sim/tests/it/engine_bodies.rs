//! Bodies do not pass through each other or through obstacles, and feel what stops them.

use crate::engine_support::{Drive, Wander, count, obstacle, run, scenario, simulate};
use starl_core::event::Hit;
use starl_core::{Command, Event, Obstacle, Point, Pose, Program, Robot, RobotId};
use starl_sim::Simulation;

fn collisions(records: &[starl_core::Record]) -> Vec<(RobotId, Hit)> {
    let hits = records.iter().filter_map(|record| match record.event {
        Event::Collided { with } => Some((record.robot?, with)),
        _ => None,
    });
    hits.collect()
}

#[test]
fn robots_that_drive_at_each_other_stop_each_other() {
    let mut scenario = scenario("create", &[(0.0, 0.0), (2.0, 0.0)]);
    scenario.fleet.groups[0].starts[1].yaw = std::f64::consts::PI;
    let mut simulation = simulate(scenario, Drive(Command::Straight { speed: 0.25 }));
    let records = run(&mut simulation, 10.0);
    assert_eq!(
        collisions(&records),
        [
            (RobotId(0), Hit::Robot(RobotId(1))),
            (RobotId(1), Hit::Robot(RobotId(0)))
        ]
    );
    assert_eq!(simulation.tally().collisions, 1);
    let gap = simulation.state(RobotId(1)).pose.position.x
        - simulation.state(RobotId(0)).pose.position.x
        - 2.0 * simulation.scenario().fleet.groups[0].model.body().radius;
    assert!((0.0..0.03).contains(&gap), "gap {gap} m");
}

#[test]
fn a_wall_stops_a_robot_once() {
    let mut scenario = scenario("create", &[(0.0, 0.0)]);
    let (low, high) = (Point::new(1.0, -1.0, 0.0), Point::new(1.1, 1.0, 0.5));
    scenario
        .world
        .obstacles
        .push(obstacle(Obstacle::cuboid(low, high)));
    let mut simulation = simulate(scenario, Drive(Command::Straight { speed: 0.25 }));
    let records = run(&mut simulation, 10.0);
    assert_eq!(collisions(&records), [(RobotId(0), Hit::Obstacle(0))]);
    let reach = simulation.state(RobotId(0)).pose.position.x
        + simulation.scenario().fleet.groups[0].model.body().radius;
    assert!((0.97..=1.0).contains(&reach), "reaches {reach} m");
}

#[test]
fn the_bounds_of_the_world_hold_robots_in() {
    let mut scenario = scenario("create", &[(0.5, 0.5)]);
    let bounds = starl_sim::scenario::Bounds {
        low: Point::ZERO,
        high: Point::planar(1.0, 1.0),
    };
    scenario.world.bounds = Some(bounds);
    let mut simulation = simulate(scenario, Drive(Command::Straight { speed: 0.25 }));
    assert_eq!(collisions(&run(&mut simulation, 10.0)).len(), 1);
    assert!(simulation.state(RobotId(0)).pose.position.x < 0.84);
}

#[test]
fn a_body_passes_under_what_is_above_it() {
    let mut scenario = scenario("create", &[(0.0, 0.0)]);
    let (low, high) = (Point::new(1.0, -1.0, 0.4), Point::new(1.1, 1.0, 0.5));
    scenario
        .world
        .obstacles
        .push(obstacle(Obstacle::cuboid(low, high)));
    let mut simulation = simulate(scenario, Drive(Command::Straight { speed: 0.25 }));
    assert!(collisions(&run(&mut simulation, 10.0)).is_empty());
    assert!(simulation.state(RobotId(0)).pose.position.x > 2.0);
}

/// Reports its bumper.
#[derive(Clone)]
struct Feeler;

impl Program for Feeler {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        robot.drive(Command::Straight { speed: 0.25 });
        if let Some(contact) = robot.sensors().bumper {
            robot.emit(
                "felt",
                [
                    ("bearing", contact.bearing.into()),
                    ("left", contact.left().into()),
                    ("right", contact.right().into()),
                ],
            );
        }
    }
}

#[test]
fn the_bumper_tells_the_side_of_the_contact() {
    for (y, left, right) in [(0.12, true, false), (-0.12, false, true), (0.0, true, true)] {
        let mut scenario = scenario("create", &[(0.0, 0.0)]);
        let post = Obstacle::circle(Point::planar(1.0, y), 0.05);
        scenario.world.obstacles.push(obstacle(post));
        let records = run(&mut simulate(scenario, Feeler), 8.0);
        let felt = records.iter().find_map(|record| match &record.event {
            Event::Program { fields, .. } => Some(fields.clone()),
            _ => None,
        });
        let felt = felt.expect("it bumps");
        assert_eq!(felt[1].1, left.into(), "left, post at {y}");
        assert_eq!(felt[2].1, right.into(), "right, post at {y}");
    }
}

#[test]
fn bodies_of_a_crowd_never_overlap() {
    let places: Vec<(f64, f64)> = (0..300)
        .map(|i| (f64::from(i % 20) * 0.2, f64::from(i / 20) * 0.2))
        .collect();
    let mut scenario = scenario("differential", &places);
    let corner = Point::planar(4.0, 3.0);
    scenario.world.bounds = Some(starl_sim::scenario::Bounds {
        low: Point::planar(-0.2, -0.2),
        high: corner,
    });
    let mut simulation = simulate(scenario, Wander::default());
    for _ in 0..400 {
        simulation.step();
        assert_apart(&simulation);
    }
    assert!(simulation.tally().collisions > 50);
}

fn assert_apart(simulation: &Simulation) {
    let radius = simulation.scenario().fleet.groups[0].model.body().radius;
    let robots = simulation.robots();
    for &a in robots {
        let p = simulation.state(a).pose.position;
        assert!(p.x - radius >= -0.2 - 1e-9 && p.x + radius <= 4.0 + 1e-9);
        for &b in &robots[a.index() + 1..] {
            let apart = p.distance(simulation.state(b).pose.position);
            assert!(
                apart >= 2.0 * radius - 1e-9,
                "{a} and {b} are {apart} m apart"
            );
        }
    }
}

#[test]
fn bodies_pass_through_each_other_where_collisions_are_off() {
    let mut scenario = scenario("create", &[(0.0, 0.0), (1.0, 0.0)]);
    scenario.fleet.groups[0].starts[1] = Pose::level(Point::planar(1.0, 0.0), std::f64::consts::PI);
    scenario.physics.collisions = false;
    let mut simulation = simulate(scenario, Drive(Command::Straight { speed: 0.25 }));
    let records = run(&mut simulation, 10.0);
    assert_eq!(
        count(&records, |event| matches!(event, Event::Collided { .. })),
        0
    );
    assert!(simulation.state(RobotId(0)).pose.position.x > 1.0);
}
