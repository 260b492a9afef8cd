//! A target too near to something: the nearest free point within the vicinity takes its place.

use crate::planning_support::{Case, PLANNERS, least_gap, model, rectangle, wall};
use starl_core::Point;
use starl_motion::planning::{self, Options};

fn case(vicinity: f64) -> Case {
    let obstacles = vec![rectangle((0.0, 0.0), (4.0, 1.0))];
    // 5 cm from the upper edge, on the side away from the start.
    let mut case = Case::new(
        Point::planar(2.0, -2.0),
        Point::planar(2.0, 1.05),
        obstacles,
    );
    case.request.vicinity = vicinity;
    case
}

#[test]
fn a_blocked_target_is_replaced_by_the_nearest_free_point_in_its_vicinity() {
    let model = model("create");
    let body = model.body();
    let clear = body.radius * (1.0 + Options::default().margin_radii);
    for planner in PLANNERS {
        let case = case(0.4).with(planner, 4);
        let path = case.plan(&*model).expect("a path to near the target");
        let end = *path.last().expect("a waypoint");
        assert!((end.y - (1.0 + clear)).abs() < 1e-4, "{end}");
        assert!((end.x - 2.0).abs() < 0.02, "{end}");
        let gap = least_gap(body, &case.whole(&*model, &path), &case.request.unsafe_set);
        assert!(gap >= 0.0, "{planner:?} {gap}");
    }
}

#[test]
fn too_small_a_vicinity_gives_no_path() {
    let model = model("create");
    for planner in PLANNERS {
        // The body alone needs another 0.115 m.
        assert_eq!(case(0.11).with(planner, 4).plan(&*model), None);
        assert_eq!(case(0.0).with(planner, 4).plan(&*model), None);
    }
}

#[test]
fn a_small_vicinity_reduces_the_margin() {
    let model = model("create");
    for planner in PLANNERS {
        let path = case(0.12).with(planner, 4).plan(&*model).expect("a path");
        let end = *path.last().expect("a waypoint");
        assert!(
            end.y >= 1.0 + model.body().radius && end.y <= 1.05 + 0.12,
            "{end}"
        );
    }
}

#[test]
fn a_free_target_in_the_margin_is_still_reached_exactly() {
    let model = model("create");
    let radius = model.body().radius;
    for planner in PLANNERS {
        let target = Point::planar(2.0, 1.0 + radius + 0.004);
        let obstacles = vec![rectangle((0.0, 0.0), (4.0, 1.0))];
        let case = Case::new(Point::planar(2.0, -2.0), target, obstacles).with(planner, 1);
        let path = case.plan(&*model).expect("a path");
        assert_eq!(path.last(), Some(&target));
    }
}

#[test]
fn a_target_pinched_by_two_walls_moves_to_where_both_leave_room() {
    let model = model("create");
    let obstacles = vec![wall((0.0, 0.0), (3.0, 0.0)), wall((0.0, 0.0), (0.0, 3.0))];
    let mut case = Case::new(
        Point::planar(2.0, 2.0),
        Point::planar(0.05, 0.05),
        obstacles,
    );
    case.request.vicinity = 0.5;
    let options = Options::default();
    let path = planning::plan_with(&options, &*model, &case.estimate(), &case.request, &[])
        .expect("a path");
    let clear = model.body().radius * (1.0 + options.margin_radii);
    let end = *path.last().expect("a waypoint");
    // The nearest free point is (clear, clear); it is found to within a hundredth of the distance.
    let best = Point::planar(0.05, 0.05).distance(Point::planar(clear, clear));
    assert!(
        Point::planar(0.05, 0.05).distance(end) <= 1.01 * best,
        "{end}"
    );
}
