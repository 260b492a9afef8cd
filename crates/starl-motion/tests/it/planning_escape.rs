//! A robot that is already too near to something first moves away from it.

use crate::planning_support::{Case, PLANNERS, model, rectangle, wall};
use starl_core::{Obstacle, Point};
use starl_motion::Neighbour;
use starl_motion::planning;

#[test]
fn the_first_waypoint_leads_out_and_the_gap_never_shrinks_on_the_way() {
    for name in ["create", "drone"] {
        let model = model(name);
        let body = model.body();
        let block = rectangle((0.0, 0.0), (2.0, 2.0));
        for planner in PLANNERS {
            for (x, y) in [(1.0, -0.1), (2.05, 1.0), (2.08, 2.06), (-0.02, -0.05)] {
                let from = Point::planar(x, y);
                let target = Point::planar(-1.5, 3.0);
                let case = Case::new(from, target, vec![block.clone()]).with(planner, 1);
                let path = case.plan(&*model);
                let path = path.unwrap_or_else(|| panic!("{name} {planner:?} from {from}"));
                let whole = case.whole(&*model, &path);
                let gap = |at: Point| block.body_gap(at, body.radius, body.height);
                assert!(
                    gap(whole[0]) < 0.0 && gap(whole[1]) >= 0.0,
                    "{name} {planner:?}"
                );
                let mut before = gap(whole[0]);
                for step in 1..=50 {
                    let now = gap(whole[0].lerp(whole[1], f64::from(step) / 50.0));
                    assert!(now >= before - 1e-9, "{name} {planner:?} from {from}");
                    before = now;
                }
            }
        }
    }
}

#[test]
fn between_two_walls_the_way_out_is_along_them() {
    let model = model("create");
    // 0.2 m apart, the robot is 0.33 m wide: it has been set down or pushed where it does not fit.
    let walls = vec![wall((0.0, 0.0), (0.5, 0.0)), wall((0.0, 0.2), (0.5, 0.2))];
    let case = Case::new(
        Point::planar(0.4, 0.1),
        Point::planar(-2.0, 0.1),
        walls.clone(),
    );
    let path = case.plan(&*model).expect("a path");
    let first = path[0];
    assert!(first.x > 0.5, "{first}");
    for step in 0..=100 {
        let at = Point::planar(0.4, 0.1).lerp(first, f64::from(step) / 100.0);
        for wall in &walls {
            assert!(wall.distance(at) >= 0.1 - 1e-9, "{at}");
        }
    }
}

#[test]
fn a_robot_that_touches_another_moves_away_from_it() {
    let model = model("create");
    let other = Neighbour {
        position: Point::planar(0.3, 0.0),
        velocity: Point::ZERO,
        radius: 0.165,
        height: 0.078,
    };
    let mut case = Case::new(Point::ZERO, Point::planar(3.0, 0.0), Vec::<Obstacle>::new());
    case.request.around_robots = true;
    let path = planning::plan(&*model, &case.estimate(), &case.request, &[other]).expect("a path");
    assert!(path[0].x < 0.0 && path.len() > 2, "{path:?}");
    case.request.around_robots = false;
    let path = planning::plan(&*model, &case.estimate(), &case.request, &[other]).expect("a path");
    assert_eq!(path, [Point::planar(3.0, 0.0)]);
}
