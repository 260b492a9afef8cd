//! Every planner guarantees, for every kind of robot: a path starts at the robot, ends at the
//! target, is free everywhere, and depends only on the request.

use crate::planning_support::{Case, PLANNERS, hall, least_gap, model};
use starl_core::Point;
use starl_core::motion::Planner;

const CORNERS: [(f64, f64); 5] = [(0.3, 0.3), (2.4, 0.4), (5.8, 0.4), (5.7, 5.8), (0.4, 5.6)];

fn cases() -> Vec<Case> {
    let mut all = Vec::new();
    for (index, &(x, y)) in CORNERS.iter().enumerate() {
        for &(to_x, to_y) in CORNERS.iter().skip(index + 1) {
            all.push(Case::new(
                Point::planar(x, y),
                Point::planar(to_x, to_y),
                hall(),
            ));
        }
    }
    all
}

#[test]
fn paths_end_at_the_target_and_keep_clear() {
    for name in ["create", "drone", "holonomic", "differential"] {
        let model = model(name);
        let body = model.body();
        for planner in PLANNERS {
            let mut searched = 0;
            for case in cases() {
                for seed in 0..3 {
                    let case = case.clone().with(planner, seed);
                    let path = case.plan(&*model);
                    let path = path.unwrap_or_else(|| panic!("{name} {planner:?}: {case:?}"));
                    assert_eq!(path.last(), Some(&body.reachable(case.request.target)));
                    let gap = least_gap(body, &case.whole(&*model, &path), &hall());
                    assert!(gap >= 0.0, "{name} {planner:?} {gap}: {case:?} {path:?}");
                    searched += usize::from(path.len() > 1);
                }
            }
            assert!(
                searched >= 12,
                "{name} {planner:?}: only {searched} paths had a corner"
            );
        }
    }
}

#[test]
fn the_same_request_gives_the_same_path_and_another_seed_another() {
    for planner in PLANNERS {
        let model = model("create");
        let case = Case::new(Point::planar(0.3, 0.3), Point::planar(5.7, 5.8), hall());
        let mut different = 0;
        let first = case.clone().with(planner, 0).plan(&*model);
        for seed in 0..8 {
            let case = case.clone().with(planner, seed);
            assert_eq!(case.plan(&*model), case.plan(&*model));
            different += u32::from(case.plan(&*model) != first);
        }
        assert!(different >= 4, "{planner:?}");
    }
}

#[test]
fn a_free_straight_way_is_the_path() {
    for name in ["create", "drone", "car"] {
        for planner in [Planner::Auto].into_iter().chain(PLANNERS) {
            let model = model(name);
            let case = Case::new(Point::planar(0.0, 5.6), Point::planar(2.6, 5.5), hall());
            let path = case.with(planner, 3).plan(&*model);
            let target = model.body().reachable(Point::planar(2.6, 5.5));
            assert_eq!(path, Some(vec![target]), "{name} {planner:?}");
        }
    }
}

#[test]
fn numbers_that_are_not_usable_give_no_path() {
    let model = model("create");
    for planner in PLANNERS {
        for bad in [f64::NAN, f64::INFINITY] {
            let good = Point::planar(1.0, 1.0);
            let case = Case::new(Point::planar(bad, 0.0), good, hall()).with(planner, 1);
            assert_eq!(case.plan(&*model), None);
            let case = Case::new(good, Point::planar(0.0, bad), hall()).with(planner, 1);
            assert_eq!(case.plan(&*model), None);
        }
    }
}
