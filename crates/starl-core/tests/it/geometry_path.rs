//! Obstacles against straight paths, swept bodies and rays, compared with slower ways to ask the same.

use crate::geometry_cases::Cases;
use starl_core::geometry::{ConvexPolygon, HeightSpan, Obstacle, Point};

const CASES: u64 = 20_000;

/// Answers may differ from the reference when it is this close to the limit, metres.
const BAND: f64 = 1e-9;

/// The least signed distance along a segment: the distance to a convex body is convex, so thirds can
/// be left out until nothing remains.
fn least_distance(obstacle: &Obstacle, a: Point, b: Point) -> f64 {
    let (mut start, mut end) = (0.0, 1.0);
    let at = |fraction: f64| obstacle.distance(a.lerp(b, fraction));
    for _ in 0..100 {
        let (first, second) = (start + (end - start) / 3.0, end - (end - start) / 3.0);
        if at(first) < at(second) {
            end = second
        } else {
            start = first
        }
    }
    at(start).min(at(end)).min(at(0.0)).min(at(1.0))
}

fn whole_point(cases: &mut Cases, reach: i64) -> [i64; 3] {
    [
        cases.whole(-reach, reach),
        cases.whole(-reach, reach),
        cases.whole(-reach, reach),
    ]
}

fn point(p: [i64; 3]) -> Point {
    Point::new(p[0] as f64, p[1] as f64, p[2] as f64)
}

/// Whether segment and box share a point, in whole numbers: the fractions of the way at which the
/// segment is within each slab are compared as quotients.
fn meets_exactly(a: [i64; 3], b: [i64; 3], low: [i64; 3], high: [i64; 3]) -> bool {
    let (mut start, mut end) = ((0, 1), (1, 1));
    for axis in 0..3 {
        let way = b[axis] - a[axis];
        let (mut enter, mut leave) = (low[axis] - a[axis], high[axis] - a[axis]);
        if way == 0 {
            if enter > 0 || leave < 0 {
                return false;
            }
            continue;
        }
        if way < 0 {
            (enter, leave) = (-leave, -enter);
        }
        if enter * start.1 > start.0 * way.abs() {
            start = (enter, way.abs());
        }
        if leave * end.1 < end.0 * way.abs() {
            end = (leave, way.abs());
        }
    }
    start.0 * end.1 <= end.0 * start.1
}

#[test]
fn touching_a_block_counts_exactly() {
    let mut blocked = 0;
    for seed in 0..200_000 {
        let mut cases = Cases::new(seed);
        let [a, b, c, d] = [(); 4].map(|()| whole_point(&mut cases, 4));
        let low = [0, 1, 2].map(|axis| c[axis].min(d[axis]));
        let high = [0, 1, 2].map(|axis| c[axis].max(d[axis]));
        let expected = meets_exactly(a, b, low, high);
        let cuboid = Obstacle::cuboid(point(low), point(high));
        assert_eq!(
            cuboid.blocks_segment(point(a), point(b), 0.0),
            expected,
            "seed {seed}"
        );
        blocked += u32::from(expected);
    }
    assert!((20_000..180_000).contains(&blocked), "{blocked}");
}

fn turn(a: [i64; 3], b: [i64; 3], c: [i64; 3]) -> i64 {
    ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).signum()
}

fn segments_meet(a: [i64; 3], b: [i64; 3], c: [i64; 3], d: [i64; 3]) -> bool {
    let between = |p: [i64; 3], q: [i64; 3], r: [i64; 3]| {
        turn(p, q, r) == 0
            && (0..2).all(|axis| p[axis].min(q[axis]) <= r[axis] && r[axis] <= p[axis].max(q[axis]))
    };
    turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0
        || between(a, b, c)
        || between(a, b, d)
        || between(c, d, a)
        || between(c, d, b)
}

#[test]
fn touching_a_wall_or_polygon_counts_exactly() {
    for seed in 0..200_000 {
        let mut cases = Cases::new(seed);
        let count = cases.whole(2, 4) as usize;
        let corners: Vec<[i64; 3]> = (0..count).map(|_| whole_point(&mut cases, 4)).collect();
        let points: Vec<Point> = corners.iter().map(|&p| point(p)).collect();
        let Ok(base) = ConvexPolygon::new(&points) else {
            continue;
        };
        let (a, b) = (whole_point(&mut cases, 5), whole_point(&mut cases, 5));
        let mut expected = base.contains(point(a));
        for at in 0..count {
            expected |= segments_meet(a, b, corners[at], corners[(at + 1) % count]);
        }
        let obstacle = Obstacle::polygon(base);
        assert_eq!(
            obstacle.blocks_segment(point(a), point(b), 0.0),
            expected,
            "seed {seed}"
        );
    }
}

#[test]
fn segments_are_blocked_as_the_distance_along_them_says() {
    let (mut blocked, mut close) = (0, 0);
    for seed in 0..CASES {
        let mut cases = Cases::new(seed);
        let obstacle = cases.obstacle();
        let (a, b) = cases.segment(4.0);
        let clearance = if cases.whole(0, 3) == 0 {
            0.0
        } else {
            cases.number(0.0, 1.5)
        };
        let answer = obstacle.blocks_segment(a, b, clearance);
        let least = least_distance(&obstacle, a, b);
        if (least - clearance).abs() < BAND {
            close += 1;
        } else {
            assert_eq!(
                answer,
                least < clearance,
                "seed {seed}: {least} against {clearance}"
            );
        }
        assert_eq!(
            answer,
            obstacle.blocks_segment(b, a, clearance),
            "seed {seed}"
        );
        blocked += u64::from(answer);
        for at in 0..=20 {
            let p = a.lerp(b, f64::from(at) / 20.0);
            assert!(
                answer || obstacle.distance(p) > clearance - BAND,
                "seed {seed}"
            );
        }
    }
    assert!(blocked > CASES / 5 && blocked < CASES * 4 / 5, "{blocked}");
    assert!(close < CASES / 10, "{close}");
}

#[test]
fn a_path_at_exactly_the_clearance_is_free() {
    let shapes = [
        Obstacle::circle(Point::ZERO, 1.0),
        Obstacle::cuboid(Point::new(-1.0, -1.0, -1.0), Point::new(1.0, 1.0, 1.0)),
        Obstacle::polygon(
            ConvexPolygon::rectangle(Point::planar(-1.0, -1.0), Point::planar(1.0, 1.0)).unwrap(),
        ),
        Obstacle::polygon(
            ConvexPolygon::new(&[Point::planar(-1.0, 1.0), Point::planar(1.0, 1.0)]).unwrap(),
        ),
    ];
    for obstacle in shapes {
        let blocks = |y: f64, clearance: f64| {
            obstacle.blocks_segment(Point::planar(-5.0, y), Point::planar(5.0, y), clearance)
        };
        assert!(blocks(1.0, 0.0), "{obstacle:?}");
        assert!(!blocks(1.0 + 1e-12, 0.0), "{obstacle:?}");
        assert!(!blocks(1.5, 0.5), "{obstacle:?}");
        assert!(blocks(1.5 - 1e-12, 0.5), "{obstacle:?}");
    }
}

#[test]
fn a_path_over_an_obstacle_is_judged_in_space() {
    let low = Obstacle::circle(Point::ZERO, 1.0).with_height(HeightSpan::new(0.0, 1.0));
    let over = |z: f64, clearance: f64| {
        low.blocks_segment(Point::new(-4.0, 0.0, z), Point::new(4.0, 0.0, z), clearance)
    };
    assert!(over(0.5, 0.0) && over(1.0, 0.0) && !over(1.1, 0.0));
    assert!(over(1.1, 0.2) && !over(1.1, 0.05));
    // Past the rim, 0.3 m to the side and 0.4 m above: 0.5 m away.
    let (a, b) = (Point::new(1.3, -4.0, 1.4), Point::new(1.3, 4.0, 1.4));
    assert!(low.blocks_segment(a, b, 0.501) && !low.blocks_segment(a, b, 0.499));
    // Slanting down beside the rim.
    let (a, b) = (Point::new(1.0, 0.0, 2.0), Point::new(2.0, 0.0, 1.0));
    assert!(low.blocks_segment(a, b, 0.708) && !low.blocks_segment(a, b, 0.707));
}

#[test]
fn bodies_are_blocked_as_the_gap_along_the_way_says() {
    const STEPS: u32 = 400;
    let mut blocked = 0;
    for seed in 0..CASES / 4 {
        let mut cases = Cases::new(seed);
        let obstacle = cases.obstacle();
        let (a, b) = cases.segment(4.0);
        let (radius, height) = (cases.number(0.0, 1.0), cases.number(0.0, 1.5));
        let answer = obstacle.blocks_body(a, b, radius, height);
        let step = a.distance(b) / f64::from(STEPS) + BAND;
        let (mut reached, mut nearly) = (false, false);
        for at in 0..=STEPS {
            let p = a.lerp(b, f64::from(at) / f64::from(STEPS));
            reached |= obstacle.body_gap(p, radius, height) < -BAND;
            let lowered = p.at_height(p.z - step);
            nearly |= obstacle.body_gap(lowered, radius + step, height + 2.0 * step) < 0.0;
        }
        assert!(answer || !reached, "seed {seed}");
        assert!(!answer || nearly, "seed {seed}");
        assert_eq!(
            answer,
            obstacle.blocks_body(b, a, radius, height),
            "seed {seed}"
        );
        blocked += u64::from(answer);
    }
    assert!(blocked > CASES / 20, "{blocked}");
}

#[test]
fn rays_end_at_the_first_boundary() {
    let mut hits = 0;
    for seed in 0..CASES {
        let mut cases = Cases::new(seed);
        let (obstacle, origin) = (cases.obstacle(), cases.point(4.0));
        let (direction, range) = (
            Point::polar(1.0, cases.number(0.0, 6.3)),
            cases.number(0.1, 6.0),
        );
        let end = origin + direction * range;
        let answer = obstacle.ray(origin, direction, range);
        if let Some(distance) = answer {
            hits += 1;
            assert!((0.0..=range).contains(&distance), "seed {seed}");
            let hit = origin + direction * distance;
            let inside = obstacle.contains(origin);
            assert_eq!(inside, distance == 0.0, "seed {seed}");
            assert!(
                inside || obstacle.body_gap(hit, 0.0, 0.0).abs() < BAND,
                "seed {seed}"
            );
        }
        for at in 0..100 {
            let along = answer.unwrap_or(range) * f64::from(at) / 100.0;
            let p = origin + direction * along;
            assert!(answer == Some(0.0) || !obstacle.contains(p), "seed {seed}");
        }
        if obstacle.bounds().inflated(BAND).contains(origin) || answer.is_some() {
            assert!(
                answer.is_none() || obstacle.blocks_segment(origin, end, BAND),
                "seed {seed}"
            );
        }
        assert!(
            answer.is_some() || !obstacle.blocks_segment(origin, end, 0.0),
            "seed {seed}"
        );
    }
    assert!(hits > CASES / 20, "{hits}");
}

#[test]
fn rays_along_and_into_a_wall() {
    let wall = ConvexPolygon::new(&[Point::planar(2.0, 0.0), Point::planar(5.0, 0.0)]).unwrap();
    let wall = Obstacle::polygon(wall).with_height(HeightSpan::new(0.0, 1.0));
    let ray = |x: f64, y: f64, z: f64, angle_x: f64, angle_y: f64| {
        wall.ray(Point::new(x, y, z), Point::planar(angle_x, angle_y), 10.0)
    };
    assert_eq!(ray(0.0, 0.0, 0.0, 1.0, 0.0), Some(2.0));
    assert_eq!(ray(9.0, 0.0, 0.0, -1.0, 0.0), Some(4.0));
    assert_eq!(ray(9.0, 0.0, 0.0, 1.0, 0.0), None);
    assert_eq!(ray(3.0, 0.0, 0.0, 1.0, 0.0), Some(0.0));
    assert_eq!(ray(3.0, 2.0, 1.0, 0.0, -1.0), Some(2.0));
    assert_eq!(ray(3.0, 2.0, 1.1, 0.0, -1.0), None);
    assert_eq!(ray(3.0, 12.5, 1.0, 0.0, -1.0), None);
    assert_eq!(ray(5.5, 2.0, 1.0, 0.0, -1.0), None);
}
