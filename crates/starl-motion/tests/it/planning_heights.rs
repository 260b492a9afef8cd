//! Heights: obstacles overhead do not block a robot on the floor, and low obstacles do not block one in the air.

use crate::planning_support::{Case, PLANNERS, least_gap, model, rectangle, room};
use starl_core::geometry::HeightSpan;
use starl_core::{Obstacle, Point};

/// A barrier across a hall; there is no way round it.
fn barrier(low: f64, high: f64) -> Vec<Obstacle> {
    let mut all = room(-2.0, 4.0);
    all.push(rectangle((1.0, -2.0), (1.2, 4.0)).with_height(HeightSpan::new(low, high)));
    all
}

#[test]
fn a_ground_robot_drives_under_a_high_obstacle() {
    let model = model("create");
    let case = |low| Case::new(Point::ZERO, Point::planar(2.0, 0.0), barrier(low, 3.0));
    for planner in PLANNERS {
        assert_eq!(
            case(0.1).with(planner, 1).plan(&*model),
            Some(vec![Point::planar(2.0, 0.0)])
        );
        // The body is 0.078 m high and cannot pass under 0.07 m.
        assert_eq!(case(0.07).with(planner, 1).plan(&*model), None);
    }
}

#[test]
fn a_floor_slab_stops_no_robot() {
    let slab = Obstacle::cuboid(Point::new(-9.0, -9.0, -1.0), Point::new(9.0, 9.0, 0.0));
    for name in ["create", "drone", "car"] {
        let model = model(name);
        let case = Case::new(Point::ZERO, Point::planar(2.0, 0.0), vec![slab.clone()]);
        assert!(
            case.plan(&*model).is_some_and(|path| path.len() == 1),
            "{name}"
        );
    }
}

#[test]
fn a_drone_flies_over_or_under() {
    let model = model("drone");
    let body = model.body();
    // It travels at 0.5 m and above: a barrier up to 0.3 m is not in the way, one up to 1.2 m is.
    let target = body.reachable(Point::planar(2.0, 0.0));
    for planner in PLANNERS {
        let low = Case::new(Point::ZERO, target, barrier(0.0, 0.3)).with(planner, 1);
        assert_eq!(low.plan(&*model), Some(vec![target]));
        let high = Case::new(Point::ZERO, target, barrier(0.0, 1.2)).with(planner, 1);
        let path = high.plan(&*model).expect("a way over");
        assert!(path.iter().any(|point| point.z > 1.2), "{path:?}");
        let whole = high.whole(&*model, &path);
        assert!(
            least_gap(body, &whole, &high.request.unsafe_set) >= 0.0,
            "{path:?}"
        );
        let above = Case::new(Point::ZERO, target, barrier(0.9, 9.0)).with(planner, 1);
        assert_eq!(above.plan(&*model), Some(vec![target]));
    }
}

#[test]
fn a_drone_never_goes_below_its_lowest_height() {
    let model = model("drone");
    let target = model.body().reachable(Point::planar(2.0, 0.0));
    // Open below 0.45 m, which is too low to travel at, and above 2 m.
    for planner in PLANNERS {
        let case = Case::new(Point::ZERO, target, barrier(0.45, 2.0)).with(planner, 1);
        let path = case.plan(&*model).expect("a way over");
        assert!(path.iter().all(|point| point.z >= target.z), "{path:?}");
    }
}
