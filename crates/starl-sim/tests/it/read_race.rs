//! The Race example is read as it is shipped: the original's world files, two robots of each kind, or
//! as many as the command line asks for.

#![allow(clippy::disallowed_methods)] // the test reads files

use crate::reading::Files;
use starl_core::{Point, Pose, RobotId};
use starl_sim::read::{self, Inputs, Override, Request, Resolved, Source};
use std::path::Path;

fn race(robots: Option<&str>, seed: u64) -> Resolved {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/race");
    let text = std::fs::read_to_string(folder.join("race.toml")).unwrap();
    let mut files = Files::default();
    for name in [
        "worlds/four.wpt",
        "worlds/Obstacles.wpt",
        "worlds/start.wpt",
    ] {
        files
            .0
            .insert(name.to_string(), std::fs::read(folder.join(name)).unwrap());
    }
    let request = Request {
        overrides: vec![Override::named("--seed", "seed", &seed.to_string())],
        robots: robots.map(str::to_string),
        ..Request::new(Source::new("race.toml", text))
    };
    read::scenario(&request, &files).unwrap_or_else(|problems| panic!("{problems}"))
}

#[test]
fn the_original_world_is_read_in_metres() {
    let scenario = race(None, 1).scenario;
    let way_points: Vec<(&str, Point)> = scenario
        .world
        .way_points
        .iter()
        .map(|way| (way.name.as_str(), way.position))
        .collect();
    let expected = [
        ("A", Point::planar(0.594, 0.508)),
        ("B", Point::planar(0.093, 1.43)),
        ("C", Point::planar(2.517, 2.734)),
        ("D", Point::planar(0.8, 1.65)),
    ];
    assert_eq!(way_points, expected);
    assert_eq!(scenario.world.obstacles.len(), 1);
    let bounds = scenario.world.obstacles[0].obstacle.bounds();
    assert_eq!(
        (bounds.low.x, bounds.low.y, bounds.high.x, bounds.high.y),
        (0.3, 1.0, 1.5, 1.2)
    );

    let names: Vec<String> = (0..4).map(|id| scenario.fleet.name(RobotId(id))).collect();
    assert_eq!(names, ["iRobot0", "iRobot1", "quadcopter0", "quadcopter1"]);
    let starts: Vec<Pose> = scenario
        .fleet
        .groups
        .iter()
        .flat_map(|group| group.starts.clone())
        .collect();
    let at = |x, y| Pose::level(Point::planar(x, y), 0.0);
    assert_eq!(
        starts,
        [at(0.7, -0.5), at(3.0, 2.5), at(0.0, 0.0), at(1.5, 2.0)]
    );
    let models: Vec<&str> = scenario
        .fleet
        .groups
        .iter()
        .map(|group| group.model.name())
        .collect();
    assert_eq!(models, ["create", "drone"]);
}

#[test]
fn twelve_robots_fit_with_every_seed() {
    let original = race(None, 1).scenario;
    for seed in 0..200 {
        let scenario = race(Some("create=6,drone=6"), seed).scenario;
        let bodies: Vec<(Point, f64)> = (scenario.fleet.groups.iter())
            .flat_map(|group| {
                let radius = group.model.body().radius;
                group
                    .starts
                    .iter()
                    .map(move |start| (start.position, radius))
            })
            .collect();
        assert_eq!(bodies.len(), 12);
        for (index, (a, radius_a)) in bodies.iter().enumerate() {
            for (b, radius_b) in &bodies[..index] {
                let gap = a.planar_distance(*b) - radius_a - radius_b;
                assert!(gap > 0.099, "seed {seed}: two robots are {gap} m apart");
            }
            for obstacle in &scenario.world.obstacles {
                assert!(
                    obstacle.obstacle.body_gap(*a, *radius_a, 0.1) > 0.0,
                    "seed {seed}"
                );
            }
        }
        // Those that the world file names stay where they are.
        for (group, original) in scenario.fleet.groups.iter().zip(&original.fleet.groups) {
            assert_eq!(group.starts[..2], original.starts[..]);
            for start in &group.starts[2..] {
                let Point { x, y, .. } = start.position;
                assert!((0.0..=5.0).contains(&x) && (0.0..=3.0).contains(&y));
            }
        }
    }
}

#[test]
fn a_smaller_fleet_leaves_starts_unused_and_a_new_model_gets_places() {
    let scenario = race(Some("drone=1,car=2"), 3).scenario;
    let names: Vec<String> = (0..scenario.fleet.len() as u32)
        .map(|id| scenario.fleet.name(RobotId(id)))
        .collect();
    assert_eq!(names, ["quadcopter0", "car0", "car1"]);
    // The starts of robots that do not take part are not waypoints either.
    assert_eq!(scenario.world.way_points.len(), 4);
    assert!(
        scenario
            .fleet
            .groups
            .iter()
            .all(|group| group.program == "race.starl")
    );
}

#[test]
fn recorded_inputs_give_the_same_scenario() {
    let resolved = race(Some("create=3,drone=2"), 9);
    let recorded = serde_json::to_string(&resolved.inputs).unwrap();
    let inputs: Inputs = serde_json::from_str(&recorded).unwrap();
    assert_eq!(inputs, resolved.inputs);
    assert_eq!(inputs.files.len(), 3);
    let again = read::again(&inputs).unwrap_or_else(|problems| panic!("{problems}"));
    assert_eq!(
        format!("{:?}", again.scenario),
        format!("{:?}", resolved.scenario)
    );
    assert_eq!(again.inputs, inputs);
}

#[test]
fn hosts_blame_fields_where_they_are_written() {
    let resolved = race(None, 1);
    let problem = resolved.problem("program", "there is no program \"race\"", None);
    assert_eq!(
        problem.to_string(),
        "race.toml:5:11: program: there is no program \"race\""
    );
    // A field that is not written is blamed on the table around it.
    let problem = resolved.problem("robots.1.parameters.speed", "is missing", Some("give it"));
    assert_eq!(
        problem.to_string(),
        "race.toml:22:1: robots.1.parameters.speed: is missing; give it"
    );
    let seed = resolved.problem("seed", "is odd", None);
    assert_eq!(seed.to_string(), "--seed: is odd");
}
