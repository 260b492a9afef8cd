//! The definition of a convex polygon, and distances to one.

use crate::geometry_cases::Cases;
use starl_core::geometry::{ConvexPolygon, Point, PolygonError};

fn polygon(points: &[(f64, f64)]) -> Result<ConvexPolygon, PolygonError> {
    let points: Vec<Point> = points.iter().map(|&(x, y)| Point::planar(x, y)).collect();
    ConvexPolygon::new(&points)
}

fn square() -> ConvexPolygon {
    ConvexPolygon::rectangle(Point::planar(0.0, 0.0), Point::planar(2.0, 2.0)).unwrap()
}

#[test]
fn either_orientation_gives_the_same_polygon() {
    let given = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)];
    let turned = [given[0], given[3], given[2], given[1]];
    assert_eq!(polygon(&given), polygon(&turned));
    for seed in 0..500 {
        let mut cases = Cases::new(seed);
        let mut corners = cases.corners();
        let left = ConvexPolygon::new(&corners).unwrap();
        assert_eq!(left.vertices(), corners, "seed {seed}");
        corners[1..].reverse();
        assert_eq!(ConvexPolygon::new(&corners).unwrap(), left, "seed {seed}");
    }
}

#[test]
fn points_on_a_straight_edge_are_left_out() {
    let with = polygon(&[
        (1.0, 0.0),
        (2.0, 0.0),
        (2.0, 2.0),
        (2.0, 1.0),
        (0.0, 2.0),
        (0.0, 0.0),
    ]);
    assert_eq!(with, Err(PolygonError::NotConvex { index: 2 }));
    let with = polygon(&[
        (1.0, 0.0),
        (2.0, 0.0),
        (2.0, 1.0),
        (2.0, 2.0),
        (0.0, 2.0),
        (0.0, 0.0),
    ]);
    let corners: Vec<(f64, f64)> = with
        .unwrap()
        .vertices()
        .iter()
        .map(|p| (p.x, p.y))
        .collect();
    assert_eq!(corners, [(2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (0.0, 0.0)]);
}

#[test]
fn rounding_does_not_make_an_edge_hollow() {
    // Thirds of an edge that is not along an axis never lie on it exactly.
    for seed in 0..2000 {
        let corners = Cases::new(seed).corners();
        let mut points = Vec::new();
        for (at, &corner) in corners.iter().enumerate() {
            let next = corners[(at + 1) % corners.len()];
            points.extend([
                corner,
                corner.lerp(next, 1.0 / 3.0),
                corner.lerp(next, 2.0 / 3.0),
            ]);
        }
        assert_eq!(
            ConvexPolygon::new(&points).unwrap().vertices(),
            corners,
            "seed {seed}"
        );
    }
}

#[test]
fn lists_that_are_not_convex_polygons_are_refused() {
    use PolygonError::*;
    assert_eq!(polygon(&[]), Err(TooFew));
    assert_eq!(polygon(&[(1.0, 1.0)]), Err(TooFew));
    assert_eq!(
        polygon(&[(1.0, 1.0), (1.0, 1.0)]),
        Err(Repeated {
            first: 0,
            second: 1
        })
    );
    assert_eq!(
        polygon(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (-0.0, 0.0)]),
        Err(Repeated {
            first: 0,
            second: 3
        })
    );
    assert_eq!(
        polygon(&[(0.0, 0.0), (f64::NAN, 0.0)]),
        Err(NotFinite { index: 1 })
    );
    assert_eq!(
        polygon(&[(0.0, f64::INFINITY), (1.0, 0.0)]),
        Err(NotFinite { index: 0 })
    );
    assert_eq!(
        polygon(&[(0.0, 1e200), (1.0, 0.0)]),
        Err(NotFinite { index: 0 })
    );
    assert_eq!(
        polygon(&[(0.0, 0.0), (1.0, 1.0), (3.0, 3.0)]),
        Err(Degenerate)
    );
    assert_eq!(
        polygon(&[(0.0, 0.0), (0.1, 0.3), (0.2, 0.6), (0.7, 2.1)]),
        Err(Degenerate)
    );
    // An arrowhead, hollow at its third point, in both orientations.
    assert_eq!(
        polygon(&[(0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (0.0, 4.0)]),
        Err(NotConvex { index: 2 })
    );
    assert_eq!(
        polygon(&[(0.0, 0.0), (0.0, 4.0), (1.0, 1.0), (4.0, 0.0)]),
        Err(NotConvex { index: 2 })
    );
    // A bow tie, a spike and a star.
    let bow = polygon(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)]);
    assert!(matches!(bow, Err(NotConvex { .. })), "{bow:?}");
    let spike = polygon(&[(0.0, 0.0), (2.0, 0.0), (4.0, 0.0), (2.0, 2.0), (3.0, 1.0)]);
    assert!(matches!(spike, Err(NotConvex { .. })), "{spike:?}");
    let star: Vec<(f64, f64)> = (0..5)
        .map(|at| f64::from(at * 2) * 1.256_637)
        .map(|a| (starl_core::math::cos(a), starl_core::math::sin(a)))
        .collect();
    assert_eq!(polygon(&star), Err(SelfCrossing));
    for error in [
        TooFew,
        NotFinite { index: 3 },
        Degenerate,
        NotConvex { index: 2 },
        SelfCrossing,
    ] {
        assert!(error.to_string().len() > 40);
    }
}

#[test]
fn rectangles_take_any_two_opposite_corners() {
    let (a, b) = (Point::planar(0.0, 2.0), Point::planar(2.0, 0.0));
    assert_eq!(ConvexPolygon::rectangle(a, b).unwrap().vertices().len(), 4);
    assert_eq!(
        ConvexPolygon::rectangle(a, b)
            .unwrap()
            .signed_distance(Point::planar(1.0, 1.0)),
        -1.0
    );
    assert!(
        ConvexPolygon::rectangle(a, Point::planar(0.0, 5.0))
            .unwrap()
            .is_wall()
    );
    assert!(ConvexPolygon::rectangle(a, a).is_err());
}

#[test]
fn the_boundary_belongs_to_the_polygon() {
    let square = square();
    for (x, y) in [(0.0, 0.0), (2.0, 1.0), (1.0, 2.0), (1.0, 1.0), (0.0, 0.3)] {
        assert!(square.contains(Point::new(x, y, 9.0)), "({x}, {y})");
    }
    assert!(!square.contains(Point::planar(2.0 + 1e-15, 1.0)));
    assert_eq!(square.signed_distance(Point::planar(0.5, 1.0)), -0.5);
    assert_eq!(square.signed_distance(Point::planar(5.0, 6.0)), 5.0);
    assert!(
        square
            .signed_distance(Point::planar(0.0, 1.0))
            .is_sign_positive()
    );
}

#[test]
fn a_wall_has_no_inside() {
    let wall = polygon(&[(0.0, 0.0), (4.0, 0.0)]).unwrap();
    assert!(wall.is_wall());
    assert!(wall.contains(Point::planar(1.0, 0.0)) && wall.contains(Point::planar(4.0, 0.0)));
    assert!(!wall.contains(Point::planar(4.5, 0.0)) && !wall.contains(Point::planar(1.0, 0.1)));
    assert_eq!(wall.signed_distance(Point::planar(1.0, -3.0)), 3.0);
    assert_eq!(wall.signed_distance(Point::planar(7.0, 4.0)), 5.0);
    assert_eq!(
        wall.nearest_boundary_point(Point::new(1.0, 2.0, 3.0)),
        Point::new(1.0, 0.0, 3.0)
    );
}

#[test]
fn sign_of_the_distance_agrees_with_contains() {
    for seed in 0..2000 {
        let mut cases = Cases::new(seed);
        let polygon = ConvexPolygon::new(&cases.corners()).unwrap();
        let p = cases.point(5.0);
        let distance = polygon.signed_distance(p);
        assert_eq!(polygon.contains(p), distance <= 0.0, "seed {seed}");
        let nearest = polygon.nearest_boundary_point(p);
        assert_eq!(nearest.z, p.z);
        assert!(
            (nearest.planar_distance(p) - distance.abs()).abs() < 1e-12,
            "seed {seed}"
        );
        assert!(
            polygon.signed_distance(nearest).abs() < 1e-12,
            "seed {seed}"
        );
        // No corner or middle of an edge is nearer.
        for (a, b) in polygon.edges() {
            assert!(a.lerp(b, cases.number(0.0, 1.0)).planar_distance(p) >= distance.abs() - 1e-12);
        }
    }
}

#[test]
fn a_stored_polygon_is_checked_when_it_is_read() {
    let bytes = postcard::to_allocvec(&square()).unwrap();
    assert_eq!(
        postcard::from_bytes::<ConvexPolygon>(&bytes).unwrap(),
        square()
    );
    let hollow = [(0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (0.0, 4.0)].map(|(x, y)| Point::planar(x, y));
    let bytes = postcard::to_allocvec(&hollow.to_vec()).unwrap();
    assert!(postcard::from_bytes::<ConvexPolygon>(&bytes).is_err());
}
