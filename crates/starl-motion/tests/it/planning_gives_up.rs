//! A target that cannot be reached: planners give up, and soon.

use crate::planning_support::{self, Case, PLANNERS, hall, model, room};
use starl_core::{Obstacle, Point};

#[test]
fn a_sealed_room_cannot_be_entered() {
    for name in ["create", "drone"] {
        let model = model(name);
        for planner in PLANNERS {
            let mut obstacles = room(-4.0, 4.0);
            obstacles.extend(room(-1.0, 1.0));
            let mut case = Case::new(Point::planar(3.0, 3.0), Point::planar(0.0, 0.0), obstacles);
            // A tree without bound would never end here.
            case.request.most_nodes = 300;
            assert_eq!(
                case.with(planner, 5).plan(&*model),
                None,
                "{name} {planner:?}"
            );
        }
    }
}

#[test]
fn a_gap_too_narrow_for_the_body_is_closed() {
    let model = model("create");
    let radius = model.body().radius;
    let gap = |width: f64| {
        vec![
            planning_support::wall((-9.0, 0.0), (-width / 2.0, 0.0)),
            planning_support::wall((width / 2.0, 0.0), (9.0, 0.0)),
            planning_support::wall((-9.0, -3.0), (9.0, -3.0)),
            planning_support::wall((-9.0, 3.0), (9.0, 3.0)),
            planning_support::wall((-9.0, -3.0), (-9.0, 3.0)),
            planning_support::wall((9.0, -3.0), (9.0, 3.0)),
        ]
    };
    for planner in PLANNERS {
        for (width, passes) in [(1.98 * radius, false), (6.0 * radius, true)] {
            let (a, b) = (Point::planar(-4.0, -1.5), Point::planar(5.0, 1.5));
            let mut case = Case::new(a, b, gap(width)).with(planner, 2);
            // ReachAvoid requests this number.
            case.request.most_nodes = 20_000;
            assert_eq!(case.plan(&*model).is_some(), passes, "{planner:?} {width}");
        }
    }
}

#[test]
fn a_target_inside_an_obstacle_is_refused() {
    let model = model("create");
    for planner in PLANNERS {
        let case = Case::new(Point::planar(0.3, 0.3), Point::planar(4.6, 3.4), hall());
        assert_eq!(case.with(planner, 1).plan(&*model), None);
    }
}

#[test]
fn a_robot_whose_centre_is_in_an_obstacle_gets_no_path() {
    let model = model("create");
    for planner in PLANNERS {
        let disc = Obstacle::circle(Point::planar(0.0, 0.0), 1.0);
        let case = Case::new(Point::planar(0.5, 0.0), Point::planar(4.0, 0.0), vec![disc]);
        assert_eq!(case.with(planner, 1).plan(&*model), None);
    }
}
