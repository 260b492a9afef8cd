//! ReachAvoid drives in a lane: along a line up to a limit that can be moved, and at a distance from the robots on it.

use crate::harness::pilot::{Bench, p};
use starl_core::sensor::{Detected, Detection};
use starl_core::{Duration, Input, Point, Random, RobotId};
use starl_primitives::reach_avoid::Options;

/// Ten metres to the east, then ten to the north.
const LANE: [[f64; 2]; 3] = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]];

fn lane() -> Vec<Point> {
    LANE.map(|[x, y]| p(x, y)).to_vec()
}

fn bench() -> Bench {
    let options = Options {
        gap: 0.75,
        ..Options::default()
    };
    Bench::new(options)
}

fn drive(bench: &mut Bench, until: f64) {
    bench.with(|motion, robot| motion.drive_lane(robot, &lane(), until));
}

/// The robot is at a place, sees a robot at each of the others, and is activated 100 ms later.
fn see(bench: &mut Bench, position: Point, others: &[Point]) {
    bench.at(position);
    bench.now += Duration::from_millis(100);
    let seen = others.iter().zip(1..).map(|(&position, id)| Detection {
        what: Detected::Robot(RobotId(id)),
        position,
    });
    bench.detections = seen.collect();
    bench.input(Input::Activate);
}

fn free(bench: &Bench, standing: Duration) -> f64 {
    bench.reach_avoid.free(bench.now, standing)
}

#[test]
fn it_drives_along_the_line_to_the_limit() {
    let mut bench = bench();
    drive(&mut bench, 12.0);
    assert_eq!(bench.tracked, Some((p(10.0, 0.0), Some(p(10.0, 2.0)))));
    assert_eq!(bench.flags(), (true, false, false));
    see(&mut bench, p(9.95, 0.0), &[]);
    see(&mut bench, p(10.0, 1.0), &[]);
    assert_eq!(bench.reach_avoid.along(), 11.0);
    see(&mut bench, p(10.0, 1.98), &[]);
    assert_eq!(bench.flags(), (false, true, false));
    assert!(bench.plans.is_empty());
}

#[test]
fn the_limit_moves_without_a_stop() {
    let mut bench = bench();
    drive(&mut bench, 5.0);
    see(&mut bench, p(4.0, 0.0), &[]);
    assert_eq!(bench.tracked, Some((p(5.0, 0.0), None)));
    drive(&mut bench, 9.0);
    assert_eq!(bench.tracked, Some((p(9.0, 0.0), None)));
    drive(&mut bench, 9.0);
    assert_eq!(bench.events, ["start", "path", "start", "path"]);
    drive(&mut bench, 4.5);
    assert_eq!(bench.tracked, Some((p(4.5, 0.0), None)), "and back");
    drive(&mut bench, 2.0);
    assert_eq!(bench.tracked, None, "it is beyond that");
}

#[test]
fn a_limit_beyond_the_end_is_the_end() {
    let mut bench = bench();
    see(&mut bench, p(10.0, 9.0), &[]);
    drive(&mut bench, 1e9);
    assert_eq!(bench.tracked, Some((p(10.0, 10.0), None)));
    see(&mut bench, p(10.0, 10.0), &[]);
    let events = bench.events.len();
    see(&mut bench, p(10.0, 10.0), &[]);
    assert_eq!(bench.events.len(), events);
    assert_eq!(bench.flags(), (false, true, false));
}

#[test]
fn it_stops_behind_another_robot_and_continues() {
    let mut bench = bench();
    drive(&mut bench, 8.0);
    see(&mut bench, p(2.0, 0.0), &[p(3.4, 0.0)]);
    assert!(bench.tracked.is_some(), "0.65 m are free");
    see(&mut bench, p(2.1, 0.0), &[p(3.4, 0.0)]);
    assert_eq!(bench.tracked, None);
    assert!(bench.reach_avoid.active(), "it waits");
    see(&mut bench, p(2.1, 0.0), &[p(3.6, 0.0)]);
    assert_eq!(bench.tracked, None, "0.75 m are free, and it takes 0.8 m");
    see(&mut bench, p(2.1, 0.0), &[p(3.7, 0.0)]);
    assert!(bench.tracked.is_some());
}

#[test]
fn robots_beside_the_lane_or_behind_are_not_in_the_way() {
    let mut bench = bench();
    drive(&mut bench, 8.0);
    see(
        &mut bench,
        p(2.0, 0.0),
        &[p(1.5, 0.0), p(2.5, 0.8), p(5.0, 0.0)],
    );
    assert!(bench.tracked.is_some());
    assert!((free(&bench, Duration::ZERO) - 4.25).abs() < 1e-9);
}

#[test]
fn the_way_round_a_corner_is_looked_at() {
    let mut bench = bench();
    drive(&mut bench, 20.0);
    see(&mut bench, p(9.8, 0.0), &[p(10.0, 1.0)]);
    assert_eq!(bench.tracked, None);
    assert!((free(&bench, Duration::ZERO) - 10.25).abs() < 1e-9);
}

#[test]
fn standing_robots_are_distinguished_from_moving_ones() {
    let mut bench = bench();
    let second = Duration::from_seconds(1);
    drive(&mut bench, 8.0);
    see(&mut bench, p(1.0, 0.0), &[p(5.0, 0.0)]);
    assert_eq!(free(&bench, second), 4.25, "it was never seen to move");
    see(&mut bench, p(1.0, 0.0), &[p(5.2, 0.0)]);
    assert_eq!(free(&bench, second), 20.0);
    (0..10).for_each(|_| see(&mut bench, p(1.0, 0.0), &[p(5.25, 0.0)]));
    assert_eq!(free(&bench, second), 4.5);
    assert_eq!(free(&bench, Duration::ZERO), 4.5);
}

#[test]
fn it_tells_for_how_long_it_has_stood() {
    let mut bench = bench();
    let stood = |bench: &Bench| bench.reach_avoid.stood(bench.now);
    assert_eq!(stood(&bench), Duration::ZERO);
    drive(&mut bench, 8.0);
    (0..5).for_each(|_| see(&mut bench, p(0.02, 0.0), &[p(0.5, 0.0)]));
    assert_eq!(stood(&bench), Duration::from_millis(500));
    see(&mut bench, p(0.2, 0.0), &[]);
    assert_eq!(stood(&bench), Duration::ZERO);
}

#[test]
fn other_commands_end_it() {
    let mut bench = bench();
    drive(&mut bench, 8.0);
    bench.with(|motion, robot| motion.stop(robot));
    assert_eq!(bench.flags(), (false, false, false));
    see(&mut bench, p(1.0, 0.0), &[]);
    assert_eq!(bench.tracked, None);
    drive(&mut bench, 8.0);
    bench.with(|motion, robot| motion.follow(robot, &[p(0.0, 3.0)], [].into()));
    see(&mut bench, p(0.0, 0.0), &[p(0.0, 0.5)]);
    assert_eq!(bench.tracked, Some((p(0.0, 3.0), None)));
    assert_eq!(bench.reach_avoid.along(), 0.0);
}

#[test]
fn a_line_without_points_or_with_nan_is_a_stop() {
    let mut bench = bench();
    for (line, until) in [
        (vec![], 1.0),
        (vec![p(0.0, 0.0), p(f64::NAN, 0.0)], 1.0),
        (lane(), f64::NAN),
    ] {
        drive(&mut bench, 8.0);
        bench.with(|motion, robot| motion.drive_lane(robot, &line, until));
        assert_eq!(bench.tracked, None);
        assert_eq!(bench.flags(), (false, false, false));
    }
    bench.with(|motion, robot| motion.drive_lane(robot, &[p(1.0, 0.0)], 1.0));
    see(&mut bench, p(0.0, 0.0), &[]);
    assert_eq!(
        bench.reach_avoid.along(),
        0.0,
        "a single point has no length"
    );
}

#[test]
fn it_recovers_from_any_state() {
    for seed in 0..200 {
        let mut bench = bench();
        drive(&mut bench, 8.0);
        see(&mut bench, p(1.0, 0.0), &[]);
        bench.reach_avoid.corrupt(&mut Random::keyed(seed, &[]));
        bench.plans.clear();
        for _ in 0..3 {
            see(&mut bench, p(1.0, 0.0), &[p(3.0, 0.0)]);
            drive(&mut bench, 8.0);
        }
        assert!(
            bench.reach_avoid.active() && bench.reach_avoid.along() == 1.0,
            "{seed}: {:?}",
            bench.reach_avoid
        );
    }
}
