//! Sensors read the true world, in range and line of sight.

use crate::engine_support::{obstacle, run, scenario, simulate};
use starl_core::sensor::Detected;
use starl_core::{
    Command, ConvexPolygon, Duration, Event, Obstacle, Point, Primitives, Program, Record, Robot,
    RobotId, Time,
};
use starl_sim::Scenario;
use starl_sim::scenario::{Detector, Proximity, Thing};

/// Reports what it senses.
#[derive(Clone, Primitives)]
struct Watcher(Command);

impl Program for Watcher {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        robot.drive(self.0);
        for ray in robot.sensors().proximity {
            if ray.nearness > 0.0 {
                let (bearing, distance) = (ray.bearing.into(), ray.distance.into());
                robot.emit("ray", [("bearing", bearing), ("distance", distance)]);
            }
        }
        for detection in robot.sensors().detections {
            match detection.what {
                Detected::Thing(thing) => robot.emit("thing", [("index", thing.into())]),
                Detected::Robot(other) => robot.emit("robot", [("id", other.into())]),
            }
        }
        let known = robot.obstacles().len() as u32;
        robot.emit("known", [("obstacles", known.into())]);
    }
}

fn named<'a>(records: &'a [Record], wanted: &str) -> Vec<(RobotId, &'a starl_core::Fields)> {
    let events = records.iter().filter_map(|record| match &record.event {
        Event::Program { name, fields } if name == wanted => Some((record.robot?, fields)),
        _ => None,
    });
    events.collect()
}

fn number(value: &starl_core::Value) -> f64 {
    match value {
        starl_core::Value::Float(number) => *number,
        starl_core::Value::Int(number) => *number as f64,
        other => panic!("{other:?} is no number"),
    }
}

fn still(scenario: Scenario) -> Vec<Record> {
    run(&mut simulate(scenario, Watcher(Command::Stop)), 0.05)
}

#[test]
fn rays_measure_from_the_bodys_edge_to_robots_and_walls() {
    let mut scenario = scenario("differential", &[(0.0, 0.0), (0.22, 0.0)]);
    scenario.fleet.groups[0].sensors.proximity = Some(Proximity {
        rays: 4,
        range: 0.1,
    });
    let wall = [Point::planar(-1.0, 0.125), Point::planar(1.0, 0.125)];
    scenario.world.obstacles.push(obstacle(Obstacle::polygon(
        ConvexPolygon::new(&wall).unwrap(),
    )));
    let records = still(scenario);
    let rays: Vec<(f64, f64)> = named(&records, "ray")
        .iter()
        .filter(|(robot, _)| *robot == RobotId(0))
        .map(|(_, fields)| (number(&fields[0].1), number(&fields[1].1)))
        .collect();
    // Ahead the other robot at 0.22 - 2 * 0.085, to the left the wall at 0.125 - 0.085.
    assert_eq!(rays.len(), 2);
    assert!(
        rays[0].0 == 0.0 && (rays[0].1 - 0.05).abs() < 1e-12,
        "{rays:?}"
    );
    assert!(
        (rays[1].0 - std::f64::consts::FRAC_PI_2).abs() < 1e-12,
        "{rays:?}"
    );
    assert!((rays[1].1 - 0.04).abs() < 1e-12, "{rays:?}");
}

#[test]
fn a_detector_sees_things_and_robots_in_range_and_line_of_sight() {
    let mut scenario = scenario("create", &[(0.0, 0.0), (0.0, 0.9), (0.0, -0.9)]);
    scenario.fleet.groups[0].sensors.detector = Some(Detector { range: 1.0 });
    let wall = [Point::planar(-0.3, -0.4), Point::planar(0.3, -0.4)];
    scenario.world.obstacles.push(obstacle(Obstacle::polygon(
        ConvexPolygon::new(&wall).unwrap(),
    )));
    for (name, x) in [("near", 0.8), ("far", 1.2)] {
        scenario.world.things.push(Thing {
            name: name.into(),
            position: Point::planar(x, 0.0),
        });
    }
    let records = still(scenario);
    let by_first = |kind: &str| -> Vec<_> {
        let seen = named(&records, kind);
        seen.iter()
            .filter(|(robot, _)| *robot == RobotId(0))
            .map(|(_, f)| f[0].1.clone())
            .collect()
    };
    assert_eq!(by_first("thing"), [0u32.into()]);
    assert_eq!(by_first("robot"), [RobotId(1).into()]);
}

#[test]
fn hidden_obstacles_become_known_to_the_robot_that_meets_them() {
    let mut scenario = scenario("create", &[(0.0, 0.0), (0.0, 5.0)]);
    let mut post = obstacle(Obstacle::circle(Point::planar(2.0, 0.0), 0.1));
    post.hidden = true;
    scenario.world.obstacles.push(post);
    let mut simulation = simulate(scenario, Watcher(Command::Straight { speed: 0.25 }));
    let records = run(&mut simulation, 8.0);
    let met: Vec<&Record> = records
        .iter()
        .filter(|record| matches!(record.event, Event::Discovered(_)))
        .collect();
    assert_eq!(met.len(), 1);
    assert_eq!(met[0].robot, Some(RobotId(0)));
    // It sees 0.6 m beyond its edge: at x = 2 - 0.1 - 0.6 - its radius.
    let radius = simulation.scenario().fleet.groups[0].model.body().radius;
    let expected = (2.0 - 0.1 - 0.6 - radius) / 0.25;
    assert!(
        (met[0].at.seconds() - expected).abs() < 0.1,
        "met at {}",
        met[0].at
    );
    let known = |robot| {
        let last = named(&records, "known")
            .into_iter()
            .rev()
            .find(|(id, _)| *id == robot);
        last.map(|(_, fields)| fields[0].1.clone())
    };
    assert_eq!(known(RobotId(0)), Some(1u32.into()));
    assert_eq!(known(RobotId(1)), Some(0u32.into()));
}

/// Of two that are at one distance, as their nearest points are one, neither hides the other; what is behind them
/// they hide.
#[test]
fn both_walls_of_a_corner_are_seen() {
    let mut scenario = scenario("create", &[(0.0, 0.0)]);
    for (a, b) in [
        ((0.4, 0.0), (1.4, 1.0)),
        ((0.4, 0.0), (1.4, -1.0)),
        ((0.5, -0.05), (0.5, 0.05)),
    ] {
        let ends = [Point::planar(a.0, a.1), Point::planar(b.0, b.1)];
        let mut wall = obstacle(Obstacle::polygon(ConvexPolygon::new(&ends).unwrap()));
        wall.hidden = true;
        scenario.world.obstacles.push(wall);
    }
    let mut simulation = simulate(scenario, Watcher(Command::Straight { speed: 0.0 }));
    let records = run(&mut simulation, 1.0);
    let known = named(&records, "known").last().map(|(_, f)| f[0].1.clone());
    assert_eq!(known, Some(2u32.into()));
}

#[test]
fn an_expired_obstacle_is_removed_from_the_world_and_from_all_maps() {
    let mut scenario = scenario("create", &[(0.0, 0.0)]);
    for (hidden, y) in [(false, 0.0), (true, 0.3)] {
        let mut post = obstacle(Obstacle::circle(Point::planar(0.6, y), 0.1));
        post.hidden = hidden;
        post.expires = Time::ZERO + Duration::from_seconds(5);
        scenario.world.obstacles.push(post);
    }
    let mut simulation = simulate(scenario, Watcher(Command::Straight { speed: 0.25 }));
    let before = run(&mut simulation, 4.9);
    let known = |records: &[Record]| named(records, "known").last().map(|(_, f)| f[0].1.clone());
    assert_eq!(known(&before), Some(2u32.into()));
    assert!(simulation.state(RobotId(0)).pose.position.x < 0.5);
    let after = run(&mut simulation, 4.0);
    assert_eq!(known(&after), Some(0u32.into()));
    assert!(simulation.state(RobotId(0)).pose.position.x > 0.9);
}
