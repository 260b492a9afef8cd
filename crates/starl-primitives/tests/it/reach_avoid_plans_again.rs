//! ReachAvoid plans again when it must, ignores outdated answers, and is never active for
//! ever.

use crate::harness::pilot::{AIR, Bench, block, p};
use starl_core::{Input, Point, Time};
use starl_primitives::reach_avoid::Options;

fn under_way() -> Bench {
    let mut bench = Bench::new(Options::default());
    bench.go(p(4.0, 0.0), [].into());
    bench.answer(Some(vec![p(2.0, 0.0), p(4.0, 0.0)]));
    bench
}

#[test]
fn when_it_is_pushed_off_its_path() {
    let mut bench = under_way();
    bench.at(p(1.0, 0.49));
    assert_eq!(bench.plans.len(), 1);
    bench.at(p(1.0, 0.51));
    assert_eq!(bench.plans.len(), 2);
    assert!(!bench.plans[1].around_robots);
    assert_ne!(bench.plans[0].ticket, bench.plans[1].ticket);
    assert_eq!(
        bench.tracked,
        Some((p(2.0, 0.0), Some(p(4.0, 0.0)))),
        "it moves on meanwhile"
    );
    bench.at(p(1.0, 0.6));
    assert_eq!(bench.plans.len(), 2, "one request is enough");
    bench.answer(Some(vec![p(4.0, 0.0)]));
    assert_eq!(bench.tracked, Some((p(4.0, 0.0), None)));
}

#[test]
fn when_a_new_obstacle_is_on_its_path_and_not_when_it_is_beside_it() {
    let mut bench = under_way();
    let beside = block(p(1.0, 0.3), p(2.0, 1.0));
    bench.known = [beside.clone()].into();
    bench.at(p(0.5, 0.0));
    assert_eq!(bench.plans.len(), 1);
    let ahead = block(p(2.5, 0.1), p(3.0, 1.0));
    bench.known = [beside.clone(), ahead.clone()].into();
    bench.at(p(0.6, 0.0));
    assert_eq!(bench.plans.len(), 2);
    assert_eq!(*bench.plans[1].unsafe_set, [beside, ahead]);
    assert_eq!(bench.tracked, None, "it does not drive into it meanwhile");
}

#[test]
fn when_it_makes_no_progress() {
    let mut bench = under_way();
    bench.at(p(0.5, 0.0));
    bench.time_out();
    assert_eq!(bench.plans.len(), 1, "half a metre is progress");
    bench.at(p(0.55, 0.0));
    bench.time_out();
    assert_eq!(bench.plans.len(), 2);
    assert!(bench.plans[1].around_robots);
    assert_ne!(bench.plans[0].seed, bench.plans[1].seed);
}

/// It was called stuck if it turned by less than 10 degrees per second.
#[test]
fn turning_round_is_progress_at_any_speed() {
    for degrees_per_second in [1, 5, 20] {
        let mut bench = Bench::new(Options::default());
        let mut degrees = 180;
        bench.heading = f64::from(degrees).to_radians();
        bench.go(p(4.0, 0.0), [].into());
        bench.answer(Some(vec![p(4.0, 0.0)]));
        while degrees > 0 {
            // In the 4 s of `stuck_after`.
            degrees = (degrees - 4 * degrees_per_second).max(0);
            bench.heading = f64::from(degrees).to_radians();
            bench.at(Point::ZERO);
            bench.time_out();
            let plans = bench.plans.len();
            assert_eq!(plans, 1, "at {degrees_per_second} degrees per second");
        }
        bench.time_out();
        assert_eq!(bench.plans.len(), 2, "now it has to drive");
    }
}

/// It has to turn at each waypoint, however well it was aligned to the one before.
#[test]
fn turning_at_a_waypoint_is_progress() {
    let mut bench = Bench::new(Options::default());
    bench.go(p(2.0, 2.0), [].into());
    bench.answer(Some(vec![p(2.0, 0.0), p(2.0, 2.0)]));
    bench.at(p(1.8, 0.0));
    bench.time_out();
    // It passes the waypoint 5 cm on, and begins to turn left.
    bench.at(p(1.86, 0.0));
    assert_eq!(bench.tracked, Some((p(2.0, 2.0), None)));
    bench.heading = 10.0_f64.to_radians();
    bench.at(p(1.86, 0.0));
    bench.time_out();
    assert_eq!(bench.plans.len(), 1);
}

#[test]
fn turning_to_and_fro_is_no_progress() {
    let mut bench = under_way();
    bench.heading = 40.0_f64.to_radians();
    bench.at(p(0.5, 0.0));
    bench.time_out();
    for (degrees, plans) in [(30.0_f64, 1), (20.0, 1), (40.0, 2)] {
        bench.heading = degrees.to_radians();
        bench.at(p(0.5, 0.0));
        bench.time_out();
        assert_eq!(bench.plans.len(), plans, "at {degrees} degrees");
    }
    bench.answer(Some(vec![p(4.0, 0.0)]));
    bench.heading = 50.0_f64.to_radians();
    bench.at(p(0.5, 0.0));
    bench.time_out();
    assert_eq!(bench.plans.len(), 3, "it turns away");
}

#[test]
fn a_robot_that_flies_makes_no_progress_by_turning() {
    let mut bench = Bench::new(Options::default());
    bench.body = AIR;
    bench.heading = 3.0;
    bench.go(Point::new(4.0, 0.0, 0.5), [].into());
    bench.answer(Some(vec![Point::new(4.0, 0.0, 0.5)]));
    bench.at(Point::new(0.0, 0.0, 0.5));
    bench.time_out();
    bench.answer(Some(vec![Point::new(4.0, 0.0, 0.5)]));
    let plans = bench.plans.len();
    bench.heading = 0.0;
    bench.time_out();
    assert_eq!(bench.plans.len(), plans + 1);
}

#[test]
fn taking_off_is_progress() {
    let mut bench = Bench::new(Options::default());
    bench.body = AIR;
    bench.go(Point::new(4.0, 0.0, 0.5), [].into());
    bench.answer(Some(vec![Point::new(4.0, 0.0, 0.5)]));
    bench.at(Point::new(0.0, 0.0, 0.3));
    bench.time_out();
    assert_eq!(bench.plans.len(), 1);
}

#[test]
fn answers_to_earlier_requests_are_ignored() {
    let mut bench = Bench::new(Options::default());
    bench.go(p(4.0, 0.0), [].into());
    let stale = bench.plans[0].ticket;
    bench.go(p(0.0, 4.0), [].into());
    bench.input(Input::Planned {
        ticket: stale,
        path: Some(vec![p(4.0, 0.0)]),
    });
    assert_eq!(bench.tracked, None);
    bench.answer(Some(vec![p(0.0, 4.0)]));
    assert_eq!(bench.tracked, Some((p(0.0, 4.0), None)));
    // The same answer a second time, when it is on its way.
    bench.at(p(0.0, 1.0));
    bench.answer(Some(vec![p(9.0, 9.0)]));
    assert_eq!(bench.tracked, Some((p(0.0, 4.0), None)));
}

#[test]
fn answers_of_other_instances_are_ignored() {
    let mut bench = Bench::new(Options::default());
    bench.go(p(4.0, 0.0), [].into());
    bench.input(Input::Planned {
        ticket: 1,
        path: Some(vec![p(4.0, 0.0)]),
    });
    assert_eq!(bench.tracked, None);
}

#[test]
fn an_invalid_path_counts_as_none() {
    for path in [vec![], vec![p(f64::NAN, 0.0)]] {
        let mut bench = Bench::new(Options {
            most_plan_failures: 1,
            ..Options::default()
        });
        bench.go(p(4.0, 0.0), [].into());
        bench.answer(Some(path));
        assert_eq!(bench.flags(), (false, false, false));
    }
}

#[test]
fn a_planner_that_never_answers_does_not_hold_it_up_for_ever() {
    let mut bench = Bench::new(Options::default());
    bench.go(p(4.0, 0.0), [].into());
    let mut time_outs = 0;
    while bench.reach_avoid.active() {
        bench.time_out();
        time_outs += 1;
        assert!(time_outs < 10);
    }
    assert_eq!(bench.flags(), (false, false, false));
}

#[test]
fn a_robot_that_is_blocked_for_good_gives_up() {
    let mut bench = under_way();
    let mut time_outs = 0;
    while bench.reach_avoid.active() {
        bench.time_out();
        if bench.reach_avoid.active() {
            bench.answer(Some(vec![p(4.0, 0.0)]));
        }
        time_outs += 1;
        assert!(time_outs <= 31);
    }
    assert_eq!(time_outs, 31, "after the last of thirty re-plans");
    assert_eq!(bench.flags(), (false, false, false));
    assert_eq!(bench.tracked, None);
}

#[test]
fn waypoints_are_cut_short_only_where_the_rest_is_free() {
    // A corner: the short cut from (1.93, 0) to (2, 2) would graze the block.
    let corner = block(p(1.0, 0.25), p(1.75, 2.0));
    for (unsafe_set, cut_at) in [(vec![], 1.86), (vec![corner], 1.95)] {
        let mut bench = Bench::new(Options::default());
        bench.go(p(2.0, 2.0), unsafe_set.into());
        bench.answer(Some(vec![p(2.0, 0.0), p(2.0, 2.0)]));
        bench.at(p(cut_at - 0.02, 0.0));
        assert_eq!(bench.tracked, Some((p(2.0, 0.0), Some(p(2.0, 2.0)))));
        bench.at(p(cut_at, 0.0));
        assert_eq!(bench.tracked, Some((p(2.0, 2.0), None)));
    }
}

#[test]
fn an_overshot_waypoint_is_passed() {
    let mut bench = under_way();
    bench.at(p(2.1, 0.25));
    assert_eq!(bench.tracked, Some((p(4.0, 0.0), None)));
}

#[test]
fn a_path_that_begins_where_the_robot_is_sends_it_to_the_next_point() {
    let mut bench = Bench::new(Options::default());
    bench.go(p(4.0, 0.0), [].into());
    bench.answer(Some(vec![p(0.0, 0.0), p(0.05, 0.0), p(4.0, 0.0)]));
    assert_eq!(bench.tracked, Some((p(4.0, 0.0), None)));
}

#[test]
fn a_robot_on_the_move_brakes_before_it_asks_for_a_path() {
    let mut bench = Bench::new(Options::default());
    bench.velocity = p(0.5, 0.0);
    bench.go(p(4.0, 0.0), [].into());
    assert_eq!(bench.flags(), (true, false, false));
    assert_eq!((bench.plans.len(), bench.tracked), (0, None));
    bench.at(p(0.1, 0.0));
    assert_eq!(bench.plans.len(), 0);
    bench.velocity = p(0.1, 0.0);
    bench.at(p(0.2, 0.0));
    assert_eq!(bench.plans.len(), 1);
}

#[test]
fn a_robot_that_never_stops_still_asks() {
    let mut bench = Bench::new(Options::default());
    bench.velocity = p(0.5, 0.0);
    bench.go(p(4.0, 0.0), [].into());
    bench.time_out();
    assert_eq!(bench.plans.len(), 1);
}

#[test]
fn when_the_way_to_the_next_point_is_not_free_where_it_was_pushed_to() {
    let wall = block(p(1.0, 0.45), p(2.0, 0.9));
    let mut bench = Bench::new(Options::default());
    bench.go(p(4.0, 0.0), [wall].into());
    bench.answer(Some(vec![p(4.0, 0.0)]));
    bench.now = Time(600_000_000);
    bench.at(p(0.5, 0.2));
    assert_eq!(
        bench.plans.len(),
        1,
        "the body passes the wall within the positioning accuracy"
    );
    bench.at(p(0.5, 0.45));
    assert_eq!(bench.plans.len(), 2);
}
