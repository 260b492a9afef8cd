//! A grown obstacle is exactly the set of points within its radius, measured along segments.

use starl_core::geometry::{ConvexPolygon, Obstacle};
use starl_core::{Point, Random};
use starl_motion::planning::free_space::FreeSpace;
use starl_motion::planning::grown::GrownList;
use starl_motion::planning::space::Space;
use starl_motion::planning::vector::{self, Vector};

fn point<const D: usize>(random: &mut Random, low: f64, high: f64) -> Vector<D> {
    core::array::from_fn(|_| random.between(low, high))
}

/// A shape grown by a radius, and the same as an obstacle of the world.
fn shapes() -> Vec<(Vec<[f64; 2]>, f64, Obstacle)> {
    let polygon = |corners: &[[f64; 2]]| {
        let points: Vec<Point> = corners.iter().map(|c| Point::planar(c[0], c[1])).collect();
        Obstacle::polygon(ConvexPolygon::new(&points).expect("convex"))
    };
    let triangle = vec![[0.0, 0.0], [2.0, 0.5], [0.5, 1.5]];
    let wall = vec![[-1.0, 0.0], [1.0, 1.0]];
    let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let disc = Obstacle::circle(Point::ZERO, 0.0);
    vec![
        (triangle.clone(), 0.4, polygon(&triangle)),
        (triangle.clone(), 0.0, polygon(&triangle)),
        (wall.clone(), 0.3, polygon(&wall)),
        (square.clone(), 0.5, polygon(&square)),
        (vec![[0.0, 0.0]], 0.7, disc),
    ]
}

#[test]
fn a_grown_shape_is_entered_and_left_where_the_distance_says() {
    let mut random = Random::keyed(3, &[]);
    for (corners, radius, obstacle) in shapes() {
        let mut list = GrownList::<2>::new();
        list.push_round(corners.iter().copied(), radius, (0.0, 0.0));
        let space = FreeSpace::new([-9.0; 2], [9.0; 2], list);
        let mut met = 0;
        for _ in 0..2_000 {
            let (a, b) = (
                point::<2>(&mut random, -2.0, 3.0),
                point::<2>(&mut random, -2.0, 3.0),
            );
            let within = |fraction: f64| {
                let at = vector::between(&a, &b, fraction);
                obstacle.distance(Point::planar(at[0], at[1])) - radius
            };
            let mut part = None;
            space.for_each_met(&a, &b, |_, enter, leave| part = Some((enter, leave)));
            let least = (0..=400)
                .map(|step| within(f64::from(step) / 400.0))
                .fold(9.0, f64::min);
            match part {
                None => assert!(least > 0.0, "{corners:?} {a:?} {b:?}: {least}"),
                Some((enter, leave)) => {
                    met += 1;
                    assert!(enter <= leave && (0.0..=1.0).contains(&enter) && leave <= 1.0);
                    // At its ends the part is on the surface, unless the segment ends inside.
                    let ends = [(enter, enter == 0.0), (leave, leave == 1.0)];
                    for (at, cut) in ends {
                        let on = within(at).abs() < 1e-9 || (cut && within(at) < 0.0);
                        assert!(on, "{corners:?} {a:?} {b:?} {at}: {}", within(at));
                    }
                    assert!(within(0.5 * (enter + leave)) <= 1e-9);
                }
            }
            assert_eq!(space.sees(&a, &b), part.is_none());
        }
        assert!(met > 400, "{met}");
    }
}

#[test]
fn the_reachable_part_is_free_and_ends_at_a_surface() {
    let mut random = Random::keyed(4, &[]);
    for (corners, radius, obstacle) in shapes() {
        let mut list = GrownList::<2>::new();
        list.push_round(corners.iter().copied(), radius, (0.0, 0.0));
        let space = FreeSpace::new([-9.0; 2], [9.0; 2], list);
        let mut slid = 0;
        for _ in 0..2_000 {
            let (a, b) = (
                point::<2>(&mut random, -2.0, 3.0),
                point::<2>(&mut random, -2.0, 3.0),
            );
            let reach = space.reach(&a, &b);
            let end = vector::between(&a, &b, reach.free);
            assert!(reach.free == 0.0 || space.sees(&a, &end));
            let Some(wall) = reach.wall else { continue };
            if !space.is_free(&a) {
                continue;
            }
            slid += 1;
            assert!((vector::dot(&wall, &wall) - 1.0).abs() < 1e-9);
            // Straight away from the wall the distance grows by as much as one moves.
            let sign = -vector::dot(&wall, &vector::difference(&a, &b)).signum();
            let gap = |x: f64, y: f64| obstacle.distance(Point::planar(x, y));
            let here = gap(end[0], end[1]);
            let off = 1e-4 * sign;
            let across = gap(end[0] + off * wall[0], end[1] + off * wall[1]) - here;
            assert!(
                (across - 1e-4).abs() < 1e-5,
                "{corners:?} {a:?} {b:?} {across}"
            );
        }
        assert!(slid > 300, "{slid}");
    }
}
