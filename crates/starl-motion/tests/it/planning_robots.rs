//! Other robots as obstacles, where they stand and as high as they are.

use crate::planning_support::{self, Case, model};
use starl_core::{Obstacle, Point};
use starl_motion::{Neighbour, planning};

fn robot(x: f64, y: f64, z: f64, height: f64) -> Neighbour {
    let position = Point::new(x, y, z);
    Neighbour {
        position,
        velocity: Point::ZERO,
        radius: 0.2,
        height,
    }
}

fn case(around_robots: bool) -> Case {
    let mut case = Case::new(Point::ZERO, Point::planar(2.0, 0.0), Vec::<Obstacle>::new());
    case.request.around_robots = around_robots;
    case
}

#[test]
fn a_path_leads_round_a_robot_if_that_is_asked_for() {
    let model = model("create");
    let others = [robot(1.0, 0.05, 0.0, 0.1)];
    for around in [false, true] {
        let case = case(around);
        let path = planning::plan(&*model, &case.estimate(), &case.request, &others);
        let path = path.expect("a path");
        assert_eq!(path.len() > 1, around, "{path:?}");
        let whole = case.whole(&*model, &path);
        let disc = Obstacle::circle(others[0].position, 0.2);
        let gap = planning_support::least_gap(model.body(), &whole, &[disc]);
        assert_eq!(gap >= 0.0, around, "{gap}");
    }
}

#[test]
fn a_drone_overhead_is_not_in_the_way_on_the_floor_nor_a_robot_on_the_floor_in_the_air() {
    for (name, z) in [("create", 0.9), ("drone", 0.0)] {
        let model = model(name);
        let mut case = case(true);
        case.request.target = model.body().reachable(case.request.target);
        let path = planning::plan(
            &*model,
            &case.estimate(),
            &case.request,
            &[robot(1.0, 0.0, z, 0.1)],
        );
        assert_eq!(path, Some(vec![case.request.target]), "{name}");
    }
}

#[test]
fn a_target_occupied_by_a_robot_is_approached_within_the_vicinity() {
    let model = model("create");
    let others = [robot(2.0, 0.0, 0.0, 0.1)];
    let mut case = case(true);
    let path = planning::plan(&*model, &case.estimate(), &case.request, &others);
    assert_eq!(path, None);
    case.request.vicinity = 0.4;
    let path = planning::plan(&*model, &case.estimate(), &case.request, &others).expect("a path");
    let end = *path.last().expect("a waypoint");
    let apart = end.distance(others[0].position);
    assert!((0.365..=0.4).contains(&apart), "{apart}");
}
