//! Paths keep the whole margin but near an end that has less of it, and nowhere touch.

use crate::planning_support::{Case, PLANNERS, least_gap, model, rectangle, wall};
use starl_core::motion::{Path, Planner};
use starl_core::{Obstacle, Point};
use starl_motion::planning::{self, Options};
use starl_motion::{Model, Neighbour};

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

/// Two walls a metre long, a passage of so many metres between them, and no other way to behind them.
fn passage(width: f64) -> Case {
    let y = 0.5 * width;
    let mut obstacles: Vec<Obstacle> = Vec::new();
    for side in [-1.0, 1.0] {
        obstacles.push(wall((0.0, side * y), (1.0, side * y)));
        obstacles.push(wall((0.0, side * y), (0.0, side * 9.0)));
    }
    let far = wall((-1.0, -9.0), (-1.0, 9.0));
    obstacles.extend([far, wall((-1.0, 9.0), (0.0, 9.0))]);
    obstacles.push(wall((-1.0, -9.0), (0.0, -9.0)));
    let mut case = Case::new(Point::planar(-0.5, 3.0), Point::planar(2.0, 1.0), obstacles);
    case.request.most_nodes = 20_000;
    case
}

#[test]
fn a_narrow_passage_is_passed_with_a_smaller_margin() {
    let model = model("create");
    let radius = model.body().radius;
    for planner in [Planner::RrtConnect, Planner::RrtStar] {
        for (room, least) in [
            (1.2 * margin(&*model), margin(&*model)),
            (0.03, 0.02),
            (0.022, 0.02),
        ] {
            let case = passage(2.0 * (radius + room)).with(planner, 7);
            let path = case.plan(&*model).expect("a path");
            let (near, elsewhere) = gaps(&*model, &case, &path);
            assert!(near.min(elsewhere) >= least - 1e-6, "{planner:?} {room}");
        }
    }
}

#[test]
fn a_passage_narrower_than_position_errors_is_closed() {
    let model = model("create");
    let radius = model.body().radius;
    let plan = |options: &Options, room: f64| {
        let case = passage(2.0 * (radius + room)).with(Planner::RrtConnect, 7);
        planning::plan_with(options, &*model, &case.estimate(), &case.request, &[])
    };
    let exact = Options {
        least_margin: 0.0,
        ..Options::default()
    };
    for room in [0.007, 0.012, 0.019] {
        assert!(plan(&exact, room).is_some(), "{room}");
        assert_eq!(plan(&Options::default(), room), None, "{room}");
    }
    // Positions that err by more need more room.
    assert!(plan(&Options::with_accuracy(0.005), 0.03).is_some());
    assert_eq!(plan(&Options::with_accuracy(0.01), 0.03), None);
}

#[test]
fn no_robot_squeezes_past_a_robot_in_a_door() {
    // A door of one metre, a crashed robot beside one of its posts, 6 mm more than the body on either side; round the
    // end of the wall is another way.
    let model = model("create");
    let posts = vec![wall((-3.0, 0.0), (0.0, 0.0)), wall((1.0, 0.0), (4.0, 0.0))];
    let dead = Neighbour {
        position: Point::planar(1.0 - 2.0 * 0.171 - 0.165, 0.0),
        velocity: Point::ZERO,
        radius: 0.165,
        height: 0.078,
    };
    let disc = Obstacle::circle(dead.position, dead.radius);
    for planner in [Planner::RrtConnect, Planner::RrtStar] {
        for seed in 0..20 {
            let ends = (Point::planar(0.8, -0.6), Point::planar(0.8, 0.6));
            let mut case = Case::new(ends.0, ends.1, posts.clone()).with(planner, seed);
            case.request.around_robots = true;
            // The last of its paths would be found with this number.
            case.request.most_nodes = 1_000;
            let estimate = case.estimate();
            let path = planning::plan(&*model, &estimate, &case.request, &[dead]);
            let path = path.expect("a path round the wall");
            let all: Vec<Obstacle> = posts.iter().cloned().chain([disc.clone()]).collect();
            let gap = least_gap(model.body(), &case.whole(&*model, &path), &all);
            assert!(gap >= 0.02 - 1e-6, "{planner:?} {seed}: {gap} {path:?}");
        }
    }
}

#[test]
fn a_robot_leaves_a_narrow_passage_but_enters_no_other() {
    let model = model("create");
    let radius = model.body().radius;
    for room in [0.019, 0.006, 0.001] {
        for planner in PLANNERS {
            for (door, is_way) in [(0.03, true), (0.018, false)] {
                // It stands a little to the side; its target is behind a door four metres farther.
                let mut case = passage(2.0 * (radius + room)).with(planner, 3);
                case.from = Point::planar(0.5, 0.2 * room);
                case.request.target = Point::planar(6.0, 0.0);
                let half = radius + door;
                let ends = [(5.0, -9.0), (5.0, -half), (5.0, half), (5.0, 9.0)];
                let mut obstacles = case.request.unsafe_set.to_vec();
                obstacles.extend([wall(ends[0], ends[1]), wall(ends[2], ends[3])]);
                obstacles.extend([-9.0, 9.0].map(|y| wall((0.0, y), (5.0, y))));
                case.request.unsafe_set = obstacles.into();
                let path = case.plan(&*model);
                assert_eq!(path.is_some(), is_way, "{planner:?} {room} {door}");
                if let Some(path) = path {
                    let all = &case.request.unsafe_set;
                    let gap = least_gap(model.body(), &case.whole(&*model, &path), all);
                    assert!(gap >= 0.9 * 0.8 * room - 1e-6, "{planner:?} {room} {gap}");
                }
            }
        }
    }
}

#[test]
fn start_and_target_may_be_in_one_narrow_passage() {
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
