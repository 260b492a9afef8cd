//! The flags of ReachAvoid are those of the thesis, section 3.2.1: active while it is under way, done
//! at the target, failed in the unsafe set, and none of them once it has given up.

use crate::harness::pilot::{AIR, Bench, block, p};
use starl_core::event::moving::Trouble;
use starl_core::{Input, Point};
use starl_primitives::reach_avoid::Options;

const ACTIVE: (bool, bool, bool) = (true, false, false);
const DONE: (bool, bool, bool) = (false, true, false);
const FAILED: (bool, bool, bool) = (false, false, true);
const NONE: (bool, bool, bool) = (false, false, false);

fn bench() -> Bench {
    Bench::new(Options::default())
}

#[test]
fn it_is_active_from_the_call_until_it_is_done() {
    let mut bench = bench();
    assert_eq!(bench.flags(), NONE);
    bench.go(p(2.0, 0.0), [].into());
    assert_eq!(bench.flags(), ACTIVE);
    bench.answer(Some(vec![p(1.0, 0.0), p(2.0, 0.0)]));
    assert_eq!(bench.tracked, Some((p(1.0, 0.0), Some(p(2.0, 0.0)))));
    bench.at(p(1.0, 0.0));
    assert_eq!(bench.tracked, Some((p(2.0, 0.0), None)));
    bench.at(p(1.92, 0.0));
    assert_eq!(bench.flags(), ACTIVE);
    bench.at(p(1.93, 0.0));
    assert_eq!(bench.flags(), DONE);
    assert_eq!(
        bench.tracked,
        Some((p(2.0, 0.0), None)),
        "it comes to rest at the target"
    );
    bench.at(p(5.0, 5.0));
    assert_eq!(bench.flags(), DONE, "it has been there");
    assert_eq!(bench.events, ["start", "path", "done"]);
    assert_eq!(bench.timer, None);
}

#[test]
fn the_vicinity_is_tunable() {
    let mut bench = Bench::new(Options {
        vicinity: 0.5,
        ..Options::default()
    });
    bench.go(p(2.0, 0.0), [].into());
    assert_eq!(bench.plans[0].vicinity, 0.5);
    bench.at(p(1.49, 0.0));
    assert_eq!(bench.flags(), ACTIVE);
    bench.at(p(1.51, 0.0));
    assert_eq!(bench.flags(), DONE);
}

#[test]
fn ground_robots_leave_the_height_out_and_flying_ones_do_not() {
    let target = Point::new(1.0, 0.0, 0.8);
    let mut ground = bench();
    ground.go(target, [].into());
    assert_eq!(ground.plans[0].target, p(1.0, 0.0));
    ground.at(p(1.0, 0.0));
    assert_eq!(ground.flags(), DONE);

    let mut air = bench();
    air.body = AIR;
    air.go(target, [].into());
    assert_eq!(air.plans[0].target, target);
    air.at(target.at_height(0.5));
    assert_eq!(air.flags(), ACTIVE);
    air.at(target.at_height(0.75));
    assert_eq!(air.flags(), DONE);
}

#[test]
fn it_fails_when_the_robot_enters_the_unsafe_set() {
    let mut bench = bench();
    let wall = block(p(1.0, 1.0), p(2.0, 2.0));
    bench.go(p(3.0, 0.0), [wall].into());
    bench.answer(Some(vec![p(3.0, 0.0)]));
    bench.at(p(1.5, 0.99));
    assert!(!bench.reach_avoid.failed());
    bench.at(p(1.5, 1.0));
    assert_eq!(bench.flags(), FAILED);
    assert_eq!(bench.tracked, None, "it stops");
    assert_eq!(bench.events.last().unwrap(), "failed");
}

#[test]
fn it_fails_at_once_when_called_in_the_unsafe_set() {
    let mut bench = bench();
    let here = block(p(-1.0, -1.0), p(1.0, 1.0));
    bench.go(p(3.0, 0.0), [here].into());
    assert_eq!(bench.flags(), FAILED);
    assert_eq!(bench.plans, [], "there is nothing to plan");
}

#[test]
fn only_the_unsafe_set_of_the_call_counts() {
    let mut bench = bench();
    let wall = block(p(1.0, -1.0), p(2.0, 1.0));
    bench.go(p(3.0, 0.0), [wall.clone()].into());
    bench.with(|reach_avoid, robot| reach_avoid.stop(robot));
    // The wall is known, so planners avoid it, but this call does not call it unsafe.
    bench.known = [wall.clone()].into();
    bench.go(p(3.0, 0.0), [].into());
    assert_eq!(*bench.plans[1].unsafe_set, [wall]);
    bench.at(p(1.5, 0.0));
    assert_eq!(bench.flags(), ACTIVE);
}

#[test]
fn planners_avoid_the_unsafe_set_and_known_obstacles_each_once() {
    let (a, b) = (
        block(p(1.0, 1.0), p(2.0, 2.0)),
        block(p(3.0, 3.0), p(4.0, 4.0)),
    );
    let mut bench = bench();
    bench.known = [a.clone(), b.clone()].into();
    bench.go(p(9.0, 0.0), [a.clone()].into());
    assert_eq!(*bench.plans[0].unsafe_set, [a, b]);
}

#[test]
fn it_gives_up_when_there_is_no_path() {
    let mut bench = bench();
    bench.go(p(2.0, 0.0), [].into());
    for _ in 1..Options::default().most_plan_failures {
        bench.answer(None);
        assert_eq!(bench.flags(), ACTIVE);
        bench.time_out(); // the pause is over
    }
    bench.answer(None);
    assert_eq!(bench.flags(), NONE);
    assert_eq!((bench.tracked, &bench.timer), (None, &None));
    assert_eq!(bench.events.last().unwrap(), "give_up");
    let seeds: std::collections::BTreeSet<u64> = bench.plans.iter().map(|plan| plan.seed).collect();
    assert_eq!(seeds.len(), 3, "each time with another seed");
}

#[test]
fn a_target_that_is_not_a_place_is_refused() {
    for target in [p(f64::NAN, 0.0), p(0.0, f64::INFINITY)] {
        let mut bench = bench();
        bench.go(target, [].into());
        assert_eq!(bench.flags(), NONE);
        assert_eq!(bench.plans, []);
        assert_eq!(bench.events, ["start", "give_up"]);
    }
}

#[test]
fn stopping_clears_the_flags() {
    let mut bench = bench();
    bench.go(p(2.0, 0.0), [].into());
    bench.answer(Some(vec![p(2.0, 0.0)]));
    bench.with(|reach_avoid, robot| reach_avoid.stop(robot));
    assert_eq!(bench.flags(), NONE);
    assert_eq!((bench.tracked, &bench.timer), (None, &None));
    bench.at(p(2.0, 0.0));
    assert_eq!(bench.flags(), NONE);
}

#[test]
fn a_new_call_replaces_the_one_under_way() {
    let mut bench = bench();
    bench.go(p(2.0, 0.0), [].into());
    bench.answer(Some(vec![p(2.0, 0.0)]));
    bench.go(p(0.0, 2.0), [].into());
    assert_eq!(bench.flags(), ACTIVE);
    assert_eq!(bench.tracked, None, "it does not go on to the old target");
    bench.at(p(2.0, 0.0));
    assert_eq!(bench.flags(), ACTIVE);
    bench.at(p(0.0, 2.0));
    assert_eq!(bench.flags(), DONE);
}

/// A robot that had arrived was blown away, and was still `done`.
#[test]
fn wind_that_blows_it_off_the_target_that_it_holds_is_a_failure() {
    let mut bench = bench();
    bench.input(Input::Overpowered);
    assert_eq!(bench.flags(), NONE, "it was sent nowhere");
    bench.go(p(2.0, 0.0), [].into());
    bench.at(p(2.0, 0.0));
    assert_eq!(bench.flags(), DONE);
    bench.input(Input::Overpowered);
    assert_eq!(bench.flags(), FAILED);
    assert_eq!(bench.reach_avoid.reason(), Some(Trouble::Wind));
    bench.input(Input::Overpowered);
    assert_eq!(bench.events, ["start", "done", "give_up"]);
}
