//! Robots without a start are placed at random: apart from each other and from obstacles, the same
//! for the same seed, and a million of them too.

use crate::reading;
use starl_core::{Point, Pose};
use starl_sim::Scenario;

fn swarm(count: usize, seed: u64) -> Scenario {
    // The density of a swarm: 1.6 square metres a robot.
    let side = (1.6 * count as f64).sqrt();
    let text = format!(
        "program = \"diffusion\"\nseed = {seed}\n[world]\nbounds = {{ low = [0, 0], high = [{side}, {side}] }}\n\
         [[robots]]\nmodel = \"differential\"\ncount = {count}\n"
    );
    reading::read(&text, &[])
        .unwrap_or_else(|problems| panic!("{problems}"))
        .scenario
}

fn starts(scenario: &Scenario) -> Vec<Pose> {
    scenario
        .fleet
        .groups
        .iter()
        .flat_map(|group| group.starts.clone())
        .collect()
}

/// The smallest distance between two of the points, found by sorting along x.
fn least_distance(poses: &[Pose]) -> f64 {
    let mut points: Vec<Point> = poses.iter().map(|pose| pose.position).collect();
    points.sort_by(|a, b| a.x.total_cmp(&b.x));
    let mut least = f64::INFINITY;
    for (index, a) in points.iter().enumerate() {
        for b in &points[index + 1..] {
            if b.x - a.x >= least {
                break;
            }
            least = least.min(a.distance(*b));
        }
    }
    least
}

#[test]
fn a_swarm_is_spread_evenly_and_apart() {
    let scenario = swarm(10_000, 7);
    let starts = starts(&scenario);
    assert_eq!(starts.len(), 10_000);
    let least = least_distance(&starts);
    assert!(
        (0.27..0.28).contains(&least),
        "bodies of 85 mm, 100 mm apart: {least}"
    );
    // As many in each quarter as chance would have it: within five standard deviations.
    let middle = (1.6 * 10_000.0_f64).sqrt() / 2.0;
    for (east, north) in [(false, false), (false, true), (true, false), (true, true)] {
        let here =
            |pose: &&Pose| (pose.position.x > middle, pose.position.y > middle) == (east, north);
        let count = starts.iter().filter(here).count();
        assert!(count.abs_diff(2500) < 217, "{count} of 10000 in a quarter");
    }
    let (sin, cos) = starts.iter().fold((0.0, 0.0), |(sin, cos), pose| {
        (
            sin + starl_core::math::sin(pose.yaw),
            cos + starl_core::math::cos(pose.yaw),
        )
    });
    assert!(
        starl_core::math::hypot(sin, cos) < 500.0,
        "headings point every way"
    );
}

#[test]
fn a_million_robots_are_placed() {
    let scenario = swarm(1_000_000, 1);
    assert_eq!(scenario.fleet.len(), 1_000_000);
    assert!(least_distance(&starts(&scenario)) >= 0.27);
}

#[test]
fn the_seed_decides() {
    assert_eq!(starts(&swarm(50, 3)), starts(&swarm(50, 3)));
    assert_ne!(starts(&swarm(50, 3)), starts(&swarm(50, 4)));
}

#[test]
fn more_robots_leave_the_places_of_the_first() {
    let text = "program = \"race\"\n[world]\nstart_area = { low = [0, 0], high = [9, 9] }\n\
        [[robots]]\nmodel = \"create\"\ncount = 5\n[[robots]]\nmodel = \"drone\"\ncount = 2\n";
    let few = starts(&reading::read(text, &[]).unwrap().scenario);
    let more = starts(&reading::read(text, &["robots.1.count=6"]).unwrap().scenario);
    assert_eq!(few[..5], more[..5]);
    assert!(few[5..].iter().all(|start| more[5..].contains(start)));
}

#[test]
fn robots_with_neighbouring_numbers_stand_near_each_other() {
    let starts = starts(&swarm(10_000, 1));
    let steps = starts
        .windows(2)
        .map(|pair| pair[0].position.distance(pair[1].position));
    // The floor has 1.6 square metres a robot, and is 126 metres wide.
    assert!(steps.sum::<f64>() / 9_999.0 < 2.5);
}

#[test]
fn robots_keep_clear_of_obstacles_and_inside_their_area() {
    let text = "program = \"race\"\n\
        [[world.obstacle]]\nrectangle = { low = [1, 1], high = [3, 3] }\n\
        [[robots]]\nmodel = \"create\"\ncount = 12\nspacing = \"50mm\"\n\
        area = { low = [0, 0], high = [4, 4] }\n";
    for seed in 0..50 {
        let read = reading::read(text, &[&format!("seed={seed}")])
            .unwrap()
            .scenario;
        let obstacle = &read.world.obstacles[0].obstacle;
        for pose in starts(&read) {
            let Point { x, y, .. } = pose.position;
            assert!(obstacle.body_gap(pose.position, 0.165, 0.1) >= 0.05);
            assert!((0.165..=3.835).contains(&x) && (0.165..=3.835).contains(&y));
        }
        assert!(least_distance(&starts(&read)) >= 0.38);
    }
}

#[test]
fn in_an_empty_world_all_robots_have_room_around_its_origin() {
    for (model, count) in [("create", 1), ("create", 50), ("drone", 3000)] {
        let text =
            format!("program = \"race\"\n[[robots]]\nmodel = \"{model}\"\ncount = {count}\n");
        let read = reading::read(&text, &[]).unwrap_or_else(|problems| panic!("{problems}"));
        let starts = starts(&read.scenario);
        assert_eq!(starts.len(), count);
        // Each has at most 4 square metres.
        let side = (4.0 * count as f64).sqrt();
        assert!(
            starts
                .iter()
                .all(|start| start.position.planar_length() <= side)
        );
    }
}

#[test]
fn without_an_area_robots_are_placed_around_the_world() {
    let text = "program = \"race\"\n[[world.way_point]]\nname = \"A\"\nposition = [5, 5]\n\
        [[world.way_point]]\nname = \"B\"\nposition = [6, 5]\n[[robots]]\nmodel = \"create\"\ncount = 4\n";
    for pose in starts(&reading::read(text, &[]).unwrap().scenario) {
        let Point { x, y, .. } = pose.position;
        assert!(
            (4.0..=7.0).contains(&x) && (4.0..=6.0).contains(&y),
            "{}",
            pose.position
        );
    }
}
