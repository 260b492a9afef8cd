//! Distances, gaps and bounds of obstacles, and the areas that share their arithmetic.

use crate::geometry_cases::Cases;
use starl_core::geometry::{Area, Bounds, ConvexPolygon, HeightSpan, Obstacle, Point};

const CASES: u64 = 4000;

fn block() -> Obstacle {
    Obstacle::cuboid(Point::new(2.0, 2.0, 1.0), Point::new(0.0, 0.0, 0.0))
}

#[test]
fn distances_to_a_block() {
    let at = |x: f64, y: f64, z: f64| block().distance(Point::new(x, y, z));
    assert_eq!(at(1.0, 1.0, 0.5), -0.5);
    assert_eq!(at(1.0, 0.25, 0.5), -0.25);
    assert_eq!(at(5.0, 6.0, 0.5), 5.0);
    assert_eq!(at(1.0, 1.0, 3.0), 2.0);
    assert_eq!(at(5.0, 1.0, 5.0), 5.0);
    assert_eq!(at(2.0, 1.0, 0.5), 0.0);
}

#[test]
fn shapes_of_the_same_region_agree() {
    let (low, high) = (Point::new(-1.0, 0.5, -1.0), Point::new(2.0, 1.5, 2.0));
    let cuboid = Obstacle::cuboid(low, high);
    let prism = Obstacle::polygon(ConvexPolygon::rectangle(low, high).unwrap())
        .with_height(HeightSpan::new(low.z, high.z));
    for seed in 0..CASES {
        let mut cases = Cases::new(seed);
        let (a, b) = cases.segment(3.0);
        let clearance = cases.number(0.0, 1.0);
        assert!(
            (cuboid.distance(a) - prism.distance(a)).abs() < 1e-12,
            "seed {seed}"
        );
        assert_eq!(cuboid.contains(a), prism.contains(a), "seed {seed}");
        for clearance in [0.0, clearance] {
            assert_eq!(
                cuboid.blocks_segment(a, b, clearance),
                prism.blocks_segment(a, b, clearance),
                "seed {seed}"
            );
        }
        assert_eq!(
            cuboid.blocks_body(a, b, clearance, 0.4),
            prism.blocks_body(a, b, clearance, 0.4),
            "seed {seed}"
        );
        let direction = Point::polar(1.0, cases.number(0.0, 6.3));
        match (cuboid.ray(a, direction, 4.0), prism.ray(a, direction, 4.0)) {
            (Some(a), Some(b)) => assert!((a - b).abs() < 1e-12, "seed {seed}"),
            (a, b) => assert_eq!(a, b, "seed {seed}"),
        }
    }
}

#[test]
fn sign_of_the_distance_agrees_with_contains() {
    for seed in 0..CASES {
        let mut cases = Cases::new(seed);
        let (obstacle, p) = (cases.obstacle(), cases.point(5.0));
        assert!(obstacle.is_valid());
        assert_eq!(
            obstacle.contains(p),
            obstacle.distance(p) <= 0.0,
            "seed {seed}"
        );
        let nearest = obstacle.nearest_point(p);
        let flat = obstacle.body_gap(p, 0.0, 0.0);
        if obstacle.height().is_none() {
            assert!(
                (nearest.distance(p) - obstacle.distance(p).abs()).abs() < 1e-12,
                "seed {seed}"
            );
        }
        if obstacle.height().is_none_or(|span| span.contains(p.z)) {
            assert!(
                (nearest.distance(p) - flat.abs()).abs() < 1e-12,
                "seed {seed}"
            );
        }
    }
}

#[test]
fn distance_changes_no_faster_than_the_point_moves() {
    for seed in 0..CASES {
        let mut cases = Cases::new(seed);
        let (obstacle, a, b) = (cases.obstacle(), cases.point(4.0), cases.point(4.0));
        let change = (obstacle.distance(a) - obstacle.distance(b)).abs();
        assert!(change <= a.distance(b) + 1e-12, "seed {seed}");
    }
}

#[test]
fn bounds_are_tight() {
    for seed in 0..CASES {
        let mut cases = Cases::new(seed);
        let obstacle = cases.obstacle();
        let bounds = obstacle.bounds();
        for _ in 0..50 {
            let p = cases.point(6.0);
            assert!(!obstacle.contains(p) || bounds.contains(p), "seed {seed}");
            let distance = obstacle.distance(p);
            assert!(
                distance < 0.0
                    || bounds
                        .inflated(distance + 1e-12)
                        .overlaps(&Bounds::of_segment(p, p))
            );
        }
    }
    let wall = [Point::planar(3.0, -1.0), Point::planar(1.0, 4.0)];
    let bounds = Obstacle::polygon(ConvexPolygon::new(&wall).unwrap()).bounds();
    assert_eq!(bounds.low, Point::new(1.0, -1.0, f64::NEG_INFINITY));
    assert_eq!(bounds.high, Point::new(3.0, 4.0, f64::INFINITY));
}

#[test]
fn a_body_beside_above_and_below() {
    let gap = |x: f64, z: f64| block().body_gap(Point::new(x, 1.0, z), 0.5, 1.0);
    assert_eq!(gap(5.0, 0.0), 2.5);
    assert_eq!(gap(1.0, 0.5), -1.5);
    assert_eq!(gap(1.0, 3.0), 2.0);
    assert_eq!(gap(1.0, -4.0), 3.0);
    assert_eq!(gap(5.5, 5.0), 5.0);
}

#[test]
fn a_body_may_stand_on_an_obstacle_but_not_in_it() {
    let slab = Obstacle::cuboid(Point::new(-9.0, -9.0, -1.0), Point::new(9.0, 9.0, 0.0));
    let (a, b) = (Point::ZERO, Point::planar(5.0, 0.0));
    assert_eq!(slab.body_gap(a, 0.2, 0.3), 0.0);
    assert!(!slab.blocks_body(a, b, 0.2, 0.3));
    assert!(slab.blocks_body(a, b.at_height(-0.1), 0.2, 0.3));
    // A mark on the floor stops a robot even if both have the height 0.
    let mark = Obstacle::cuboid(Point::ZERO, Point::planar(1.0, 1.0));
    assert!(mark.body_gap(Point::planar(0.5, 0.5), 0.2, 0.0) < 0.0);
    assert!(mark.blocks_body(a, b, 0.2, 0.0));
}

#[test]
fn each_kind_of_invalid_obstacle_is_reported() {
    let (p, nan) = (Point::ZERO, Point::planar(f64::NAN, 0.0));
    assert!(Obstacle::circle(p, 0.0).is_valid());
    assert!(!Obstacle::circle(p, -1.0).is_valid());
    assert!(!Obstacle::circle(nan, 1.0).is_valid());
    assert!(!Obstacle::cuboid(p, nan).is_valid());
    assert!(
        !Obstacle::cuboid(p, p)
            .with_height(HeightSpan::new(1.0, 0.0))
            .is_valid()
    );
    assert!(
        !Obstacle::circle(p, 1.0)
            .with_height(HeightSpan::new(0.0, f64::INFINITY))
            .is_valid()
    );
}

#[test]
fn areas_measure_from_their_edge() {
    let circle = Area::Circle {
        center: Point::planar(1.0, 0.0),
        radius: 2.0,
    };
    assert!(circle.contains(Point::new(3.0, 0.0, 50.0)));
    assert_eq!(circle.distance(Point::new(6.0, 0.0, 50.0)), 3.0);
    let room = Area::Box {
        low: Point::ZERO,
        high: Point::new(1.0, 1.0, 1.0),
    };
    assert!(room.contains(Point::new(1.0, 0.0, 1.0)));
    assert!(!room.contains(Point::new(1.0, 0.0, 1.1)));
    assert_eq!(room.distance(Point::new(4.0, 5.0, 1.0)), 5.0);
    assert_eq!(room.distance(Point::new(0.5, 0.5, 3.0)), 2.0);
    let yard =
        Area::Polygon(ConvexPolygon::rectangle(Point::ZERO, Point::planar(1.0, 1.0)).unwrap());
    assert_eq!(yard.distance(Point::new(0.5, 3.0, 7.0)), 2.0);
    assert!(circle.is_valid() && room.is_valid() && yard.is_valid());
    assert!(
        !Area::Circle {
            center: Point::ZERO,
            radius: -1.0
        }
        .is_valid()
    );
    assert!(
        !Area::Box {
            low: Point::planar(1.0, 0.0),
            high: Point::ZERO
        }
        .is_valid()
    );
}

#[test]
fn distance_to_an_area_is_zero_only_inside() {
    for seed in 0..CASES {
        let mut cases = Cases::new(seed);
        let bounds = Bounds::of_segment(cases.point(3.0), cases.point(3.0));
        let areas = [
            Area::Circle {
                center: cases.point(3.0),
                radius: cases.number(0.0, 3.0),
            },
            Area::Polygon(ConvexPolygon::new(&cases.corners()).unwrap()),
            Area::Box {
                low: bounds.low,
                high: bounds.high,
            },
        ];
        let p = cases.point(4.0);
        for area in areas {
            assert_eq!(
                area.contains(p),
                area.distance(p) == 0.0,
                "seed {seed}, {area:?}"
            );
        }
    }
}
