//! Paths keep the whole margin but near an end that has less of it, and nowhere touch.

mod planning_support;

use planning_support::{Case, PLANNERS, model, rectangle, wall};
use starl_core::motion::{Path, Planner};
use starl_core::{Obstacle, Point};
use starl_motion::Model;
use starl_motion::planning::Options;

/// The margin that is asked for, metres.
fn margin(model: &dyn Model) -> f64 {
    Options::default().margin_radii * model.body().radius
}

/// The least gaps of the path near an end, which is within two margins of it, and elsewhere.
fn gaps(model: &dyn Model, case: &Case, path: &Path) -> (f64, f64) {
    let body = model.body();
    let whole = case.whole(model, path);
    let ends = [whole[0], whole[whole.len() - 1]];
    let (mut near, mut elsewhere) = (f64::INFINITY, f64::INFINITY);
    for pair in whole.windows(2) {
        let steps = (pair[0].distance(pair[1]) / 0.002).ceil().max(1.0) as u32;
        for step in 0..=steps {
            let at = pair[0].lerp(pair[1], f64::from(step) / f64::from(steps));
            let is_near = ends
                .iter()
                .any(|end| end.distance(at) <= 2.0 * margin(model));
            let least = if is_near { &mut near } else { &mut elsewhere };
            for obstacle in case.request.unsafe_set.iter() {
                *least = least.min(obstacle.body_gap(at, body.radius, body.height));
            }
        }
    }
    (near, elsewhere)
}

/// Both ends beside one block, each on another side of it, with these gaps.
fn round_a_corner(model: &dyn Model, start_gap: f64, target_gap: f64) -> Case {
    let radius = model.body().radius;
    let block = rectangle((0.0, 0.0), (2.0, 2.0));
    let from = Point::planar(-radius - start_gap, 1.0);
    let target = Point::planar(1.0, 2.0 + radius + target_gap);
    Case::new(from, model.body().reachable(target), vec![block])
}

#[test]
fn the_margin_shrinks_near_an_end_that_has_less_and_only_there() {
    for name in ["create", "drone"] {
        let model = model(name);
        for planner in PLANNERS {
            for (start_gap, target_gap) in [(0.01, 0.02), (0.5, 0.002), (0.002, 0.5), (0.4, 0.4)] {
                for seed in 0..5 {
                    let case = round_a_corner(&*model, start_gap, target_gap).with(planner, seed);
                    let path = case.plan(&*model).expect("a path");
                    assert_eq!(path.last(), Some(&case.request.target), "{name}");
                    let (near, elsewhere) = gaps(&*model, &case, &path);
                    let least = 0.5 * margin(&*model).min(start_gap).min(target_gap);
                    assert!(near >= least - 1e-6, "{name} {planner:?} {near}");
                    assert!(
                        elsewhere >= margin(&*model) - 1e-6,
                        "{name} {planner:?} {elsewhere} {path:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_straight_way_within_the_margin_of_a_wall_is_not_taken() {
    let model = model("create");
    let side = 0.165 + 0.01;
    let obstacles = vec![wall((-1.0, 0.0), (4.0, 0.0))];
    let (from, to) = (Point::planar(0.0, side), Point::planar(3.0, side));
    let case = Case::new(from, to, obstacles);
    let path = case.plan(&*model).expect("a path");
    assert!(path.len() >= 3, "{path:?}");
    let (_, elsewhere) = gaps(&*model, &case, &path);
    assert!(elsewhere >= margin(&*model) - 1e-6, "{elsewhere}");
}

#[test]
fn a_passage_too_narrow_for_the_margin_but_not_for_the_body_is_gone_through() {
    let model = model("create");
    let radius = model.body().radius;
    for planner in [Planner::RrtConnect, Planner::RrtStar] {
        // Between two walls a metre long; there is no other way.
        for (half, share) in [(1.16, 0.5), (1.08, 0.25), (1.04, 0.125)] {
            let y = half * radius;
            let mut obstacles: Vec<Obstacle> = Vec::new();
            for side in [-1.0, 1.0] {
                obstacles.push(wall((0.0, side * y), (1.0, side * y)));
                obstacles.push(wall((0.0, side * y), (0.0, side * 9.0)));
            }
            let far = wall((-1.0, -9.0), (-1.0, 9.0));
            obstacles.extend([far, wall((-1.0, 9.0), (0.0, 9.0))]);
            obstacles.push(wall((-1.0, -9.0), (0.0, -9.0)));
            let case = Case::new(Point::planar(-0.5, 3.0), Point::planar(2.0, 1.0), obstacles);
            let mut case = case.with(planner, 7);
            case.request.most_nodes = 20_000;
            let path = case.plan(&*model).expect("a path");
            let (near, elsewhere) = gaps(&*model, &case, &path);
            let least = share * margin(&*model) - 1e-6;
            assert!(near.min(elsewhere) >= least, "{planner:?} {half}");
        }
    }
}

#[test]
fn a_start_and_a_target_in_a_narrow_passage_are_gone_between() {
    let model = model("create");
    let y = 1.1 * model.body().radius;
    let walls = vec![wall((0.0, -y), (5.0, -y)), wall((0.0, y), (5.0, y))];
    for planner in PLANNERS {
        let case = Case::new(
            Point::planar(1.0, 0.0),
            Point::planar(4.0, 0.0),
            walls.clone(),
        );
        let path = case.with(planner, 1).plan(&*model);
        assert_eq!(path, Some(vec![Point::planar(4.0, 0.0)]), "{planner:?}");
    }
}
