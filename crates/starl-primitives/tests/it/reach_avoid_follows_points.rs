//! ReachAvoid follows points that it is given: it drives on through them without a stop, and plans a path
//! only where the way over them is not free.

use crate::harness::pilot::{Bench, block, p};
use starl_core::Point;
use starl_core::motion::Obstacles;
use starl_primitives::reach_avoid::Options;

fn follow(bench: &mut Bench, points: &[Point], unsafe_set: Obstacles) {
    bench.with(|reach_avoid, robot| reach_avoid.follow(robot, points, unsafe_set));
}

fn bench() -> Bench {
    Bench::new(Options::default())
}

#[test]
fn it_goes_from_each_point_to_the_next() {
    let mut bench = bench();
    follow(&mut bench, &[p(1.0, 0.0), p(1.0, 1.0)], [].into());
    assert_eq!(bench.flags(), (true, false, false));
    assert_eq!(bench.tracked, Some((p(1.0, 0.0), Some(p(1.0, 1.0)))));
    bench.at(p(0.9, 0.0));
    assert_eq!(bench.tracked, Some((p(1.0, 1.0), None)));
    bench.at(p(1.0, 0.95));
    assert_eq!(bench.flags(), (false, true, false));
    assert!(bench.plans.is_empty(), "nothing was left to plan");
    assert_eq!(bench.events, ["start", "path", "done"]);
}

#[test]
fn a_robot_under_way_drives_on() {
    let mut bench = bench();
    bench.velocity = p(1.0, 0.0);
    follow(&mut bench, &[p(2.0, 0.0)], [].into());
    bench.at(p(1.0, 0.0));
    follow(&mut bench, &[p(3.0, 0.0), p(4.0, 1.0)], [].into());
    assert_eq!(bench.tracked, Some((p(3.0, 0.0), Some(p(4.0, 1.0)))));
    assert!(bench.plans.is_empty());
}

#[test]
fn if_the_way_is_not_free_a_path_to_the_last_point_is_planned() {
    let wall = block(p(0.8, 0.2), p(1.2, 0.6));
    let points = [p(1.0, 0.0), p(1.0, 1.0)];
    for known in [true, false] {
        let mut bench = bench();
        let walls: Obstacles = [wall.clone()].into();
        if known {
            bench.known = walls.clone();
            follow(&mut bench, &points, [].into());
        } else {
            follow(&mut bench, &points, walls);
        }
        assert_eq!(bench.tracked, None);
        assert_eq!(bench.plans.len(), 1);
        assert_eq!(bench.plans[0].target, p(1.0, 1.0));
    }
}

#[test]
fn a_path_that_is_planned_again_leads_to_the_last_point() {
    let mut bench = bench();
    follow(&mut bench, &[p(1.0, 0.0), p(1.0, 1.0)], [].into());
    bench.at(p(0.2, 0.7));
    assert_eq!(bench.plans.len(), 1, "it is off the path");
    assert_eq!(bench.plans[0].target, p(1.0, 1.0));
}

#[test]
fn without_points_or_with_one_at_infinity_it_gives_up_or_plans() {
    let mut bench = bench();
    follow(&mut bench, &[p(1.0, 0.0)], [].into());
    follow(&mut bench, &[], [].into());
    assert_eq!(bench.flags(), (false, false, false));
    assert_eq!(bench.tracked, None);
    assert_eq!(bench.events, ["start", "path", "give_up"]);
    follow(&mut bench, &[p(f64::NAN, 0.0), p(1.0, 0.0)], [].into());
    assert_eq!(bench.plans.len(), 1, "only the last point must be finite");
    follow(&mut bench, &[p(1.0, f64::INFINITY)], [].into());
    assert_eq!(bench.flags(), (false, false, false));
}
