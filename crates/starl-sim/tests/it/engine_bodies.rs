//! Bodies do not pass through each other or through obstacles, and feel what stops them.

use crate::engine_support::{Drive, Wander, count, obstacle, run, scenario, simulate};
use starl_core::event::Hit;
use starl_core::{Command, Event, Obstacle, Point, Pose, Primitives, Program, Robot, RobotId};
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
fn a_body_passes_under_an_obstacle_above_it() {
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
#[derive(Clone, Primitives)]
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
fn the_bumper_shows_the_side_of_the_contact() {
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

/// Holonomic robots that drive at `speed`, faster than their default allows.
fn fast(places: &[(f64, f64)], speed: f64) -> starl_sim::scenario::Scenario {
    let mut scenario = scenario("holonomic", places);
    let parameters = starl_motion::models::HolonomicParameters {
        speed: 100.0,
        ..Default::default()
    };
    let model = starl_motion::models::Holonomic::new(parameters).expect("a valid model");
    scenario.fleet.groups[0].model = std::sync::Arc::new(model);
    scenario.physics.step = starl_core::Duration::from_millis(25);
    assert!(speed <= 100.0);
    scenario
}

/// Drives its robot along x at a speed, those with an odd number the other way.
#[derive(Clone, Primitives)]
struct Oncoming(f64);

impl Program for Oncoming {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        let speed = if robot.id().0.is_multiple_of(2) {
            self.0
        } else {
            -self.0
        };
        robot.drive(Command::Velocity {
            velocity: Point::planar(speed, 0.0),
            yaw_rate: 0.0,
        });
    }
}

#[test]
fn fast_robots_that_drive_at_each_other_stop_where_they_touch() {
    for speed in [0.5, 2.0, 20.0, 100.0] {
        for start in 0..10 {
            let apart = 0.6 * speed + 1.0 + 0.037 * f64::from(start);
            let aside = 0.025 * f64::from(start);
            let scenario = fast(&[(0.0, 0.0), (apart, aside)], speed);
            let radius = scenario.fleet.groups[0].model.body().radius;
            let mut simulation = simulate(scenario, Oncoming(speed));
            let records = run(&mut simulation, 2.0);
            assert_eq!(simulation.tally().collisions, 1, "{speed} m/s, {start}");
            assert_eq!(collisions(&records).len(), 2);
            let place = |robot| simulation.state(RobotId(robot)).pose.position;
            let gap = place(0).distance(place(1)) - 2.0 * radius;
            assert!(
                (0.0..1e-3).contains(&gap),
                "{speed} m/s, {start}: gap {gap} m"
            );
            assert!(
                place(0).x < place(1).x,
                "{speed} m/s, {start}: passed through"
            );
        }
    }
}

#[test]
fn fast_robots_do_not_pass_through_a_thin_wall() {
    for speed in [0.5, 2.0, 20.0, 100.0] {
        for start in 0..10 {
            let wall_at = speed + 1.0 + 0.037 * f64::from(start);
            let mut scenario = fast(&[(0.0, 0.0)], speed);
            let ends = [Point::planar(wall_at, -1.0), Point::planar(wall_at, 1.0)];
            let wall = starl_core::geometry::ConvexPolygon::new(&ends).expect("a wall");
            scenario
                .world
                .obstacles
                .push(obstacle(Obstacle::polygon(wall)));
            let radius = scenario.fleet.groups[0].model.body().radius;
            let mut simulation = simulate(scenario, Oncoming(speed));
            let records = run(&mut simulation, 5.0);
            assert_eq!(collisions(&records), [(RobotId(0), Hit::Obstacle(0))]);
            let gap = wall_at - simulation.state(RobotId(0)).pose.position.x - radius;
            assert!(
                (0.0..1e-3).contains(&gap),
                "{speed} m/s, {start}: gap {gap} m"
            );
        }
    }
}

#[test]
fn fast_bodies_of_a_crowd_never_overlap_on_the_way() {
    // Rows that drive through each other's places at 20 m/s, half a metre a step, in a box.
    let places: Vec<(f64, f64)> = (0..120)
        .map(|i| (f64::from(i % 12) * 0.8, f64::from(i / 12) * 0.31))
        .collect();
    let mut scenario = fast(&places, 20.0);
    scenario.world.bounds = Some(starl_sim::scenario::Bounds {
        low: Point::planar(-3.0, -1.0),
        high: Point::planar(12.0, 6.0),
    });
    let mut simulation = simulate(scenario, Rebound::default());
    let radius = simulation.scenario().fleet.groups[0].model.body().radius;
    for _ in 0..200 {
        simulation.step();
        let now: Vec<Point> = (simulation.robots().iter())
            .map(|&robot| simulation.state(robot).pose.position)
            .collect();
        for (a, p) in now.iter().enumerate() {
            for (b, q) in now.iter().enumerate().skip(a + 1) {
                let gap = p.distance(*q) - 2.0 * radius;
                assert!(gap >= -1e-9, "{a} and {b} overlap by {gap} m");
            }
        }
    }
    assert!(simulation.tally().collisions > 100);
}

/// Drives fast in a direction of its own, and in another one after a contact.
#[derive(Clone, Default, Primitives)]
struct Rebound {
    turns: u32,
}

impl Program for Rebound {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if robot.sensors().bumper.is_some() {
            self.turns += 1;
        }
        let heading = f64::from(robot.id().0 * 7 + self.turns * 3);
        robot.drive(Command::Velocity {
            velocity: Point::polar(20.0, heading),
            yaw_rate: 0.0,
        });
    }
}

/// A robot on a circle of 2 m touches a wall at its far side. Only the straight line from the start to the end of a step
/// was looked at, which does not reach the wall.
#[test]
fn fast_robots_in_a_curve_do_not_pass_through_a_wall_beside_their_chord() {
    for speed in [2.0, 5.0, 20.0, 50.0] {
        for millis in [1, 25, 100, 1000] {
            for wall_at in [1.9, 2.0, 2.1, 2.16] {
                let mut scenario = scenario("create", &[(0.0, 0.0)]);
                let parameters = starl_motion::models::CreateParameters {
                    wheel_speed: 100.0,
                    ..Default::default()
                };
                let model = starl_motion::models::Create::new(parameters).expect("a valid model");
                scenario.fleet.groups[0].model = std::sync::Arc::new(model);
                scenario.physics.step = starl_core::Duration::from_millis(millis);
                let ends = [Point::planar(wall_at, -5.0), Point::planar(wall_at, 9.0)];
                let wall = starl_core::geometry::ConvexPolygon::new(&ends).expect("a wall");
                let wall = obstacle(Obstacle::polygon(wall));
                scenario.world.obstacles.push(wall);
                let curve = Command::Curve { speed, radius: 2.0 };
                let mut simulation = simulate(scenario, Drive(curve));
                let records = run(&mut simulation, 6.0);
                let told = format!("{speed} m/s, steps of {millis} ms, wall at {wall_at} m");
                let hit = (RobotId(0), Hit::Obstacle(0));
                assert!(collisions(&records).contains(&hit), "{told}");
                for record in &records {
                    if let Event::Moved(pose) = &record.event {
                        assert!(pose.position.x + 0.165 <= wall_at, "{told}: {pose:?}");
                    }
                }
            }
        }
    }
}
