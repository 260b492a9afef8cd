//! The planners' geometry against the plain way to compute the same: every box, every point, every
//! place along a segment looked at.

mod planning_support;

use starl_core::geometry::{ConvexPolygon, Obstacle};
use starl_core::{Point, Random};
use starl_motion::planning::box_tree::{BoxTree, Ray};
use starl_motion::planning::free_space::FreeSpace;
use starl_motion::planning::grown::GrownList;
use starl_motion::planning::nearest::Nearest;
use starl_motion::planning::shorten::shorten;
use starl_motion::planning::space::Space;
use starl_motion::planning::vector::{self, Vector};

fn point<const D: usize>(random: &mut Random, low: f64, high: f64) -> Vector<D> {
    core::array::from_fn(|_| random.between(low, high))
}

fn boxes<const D: usize>(random: &mut Random, count: usize) -> Vec<(Vector<D>, Vector<D>)> {
    let mut one = || {
        let low: Vector<D> = point(random, 0.0, 10.0);
        (
            low,
            core::array::from_fn(|axis| low[axis] + random.between(0.0, 2.0)),
        )
    };
    (0..count).map(|_| one()).collect()
}

fn tree_finds_what_a_list_does<const D: usize>() {
    let mut random = Random::keyed(1, &[]);
    let mut met = 0;
    for count in [0, 1, 7, 8, 9, 40, 64, 65, 513, 700] {
        let boxes = boxes::<D>(&mut random, count);
        let tree = BoxTree::new(boxes.iter().copied());
        for turn in 0..200 {
            let a = point::<D>(&mut random, -1.0, 13.0);
            let mut b = point::<D>(&mut random, -1.0, 13.0);
            if turn % 4 == 0 {
                b[0] = a[0]; // Along a face's direction.
            }
            if turn % 10 == 0 {
                b = a;
            }
            let ray = Ray::new(&a, &b);
            let mut found = Vec::new();
            tree.cast(&ray, 1.0, |number, _, _, limit| {
                found.push(number);
                limit
            });
            found.sort_unstable();
            let all = (0..count as u32).filter(|&number| {
                let (low, high) = &boxes[number as usize];
                ray.clip(low, high, 1.0).is_some()
            });
            let all: Vec<u32> = all.collect();
            assert_eq!(found, all);
            met += found.len();
        }
    }
    assert!(met > 1_000);
}

#[test]
fn the_tree_of_boxes_finds_what_a_list_does() {
    tree_finds_what_a_list_does::<2>();
    tree_finds_what_a_list_does::<3>();
}

#[test]
fn a_segment_along_a_face_touches_the_box() {
    let (low, high) = ([1.0, 1.0], [2.0, 3.0]);
    for (a, b, touches) in [
        ([1.0, 0.0], [1.0, 4.0], true),
        ([0.0, 3.0], [1.0, 3.0], true),
        ([0.0, 3.1], [1.0, 3.1], false),
        ([0.9, 0.0], [0.9, 4.0], false),
        ([2.0, 3.0], [2.0, 3.0], true),
        ([1.5, 2.0], [1.5, 2.0], true),
    ] {
        assert_eq!(
            Ray::new(&a, &b).clip(&low, &high, 1.0).is_some(),
            touches,
            "{a:?} {b:?}"
        );
    }
}

fn nearest_is_nearest<const D: usize>() {
    let mut random = Random::keyed(2, &[]);
    let mut set = Nearest::<D>::new();
    let mut points: Vec<Vector<D>> = Vec::new();
    for count in 1..=1_500 {
        // Some lie on a grid, so that coordinates and whole points repeat.
        let mut next = point::<D>(&mut random, 0.0, 4.0);
        if count % 3 == 0 {
            next = next.map(f64::floor);
        }
        set.add(&next);
        points.push(next);
        let place = point::<D>(&mut random, -1.0, 5.0);
        let found = &points[set.nearest(&place) as usize];
        let least = points
            .iter()
            .map(|p| vector::distance_squared(p, &place))
            .fold(f64::INFINITY, f64::min);
        assert_eq!(vector::distance_squared(found, &place), least);
        if count % 50 == 0 && count < 800 {
            let mut near = Vec::new();
            set.for_each_within(&place, 1.0, &mut |number, squared| {
                assert_eq!(
                    vector::distance_squared(&points[number as usize], &place),
                    squared
                );
                near.push(number);
            });
            near.sort_unstable();
            let all = (0..count as u32)
                .filter(|&n| vector::distance_squared(&points[n as usize], &place) < 1.0);
            assert_eq!(near, all.collect::<Vec<u32>>());
        }
    }
}

#[test]
fn the_nearest_point_found_is_the_nearest() {
    nearest_is_nearest::<2>();
    nearest_is_nearest::<3>();
}

#[test]
fn many_points_at_one_place_are_no_trouble() {
    let mut set = Nearest::<2>::new();
    for _ in 0..100 {
        set.add(&[1.0, 2.0]);
    }
    set.add(&[1.0, 2.5]);
    assert_eq!(set.nearest(&[5.0, 9.0]), 100);
    assert!(set.nearest(&[1.0, 1.0]) < 100);
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
fn how_far_one_reaches_is_free_and_what_stops_one_lies_across() {
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

#[test]
fn shortening_keeps_the_ends_stays_free_and_never_lengthens() {
    let mut random = Random::keyed(5, &[]);
    let mut list = GrownList::<2>::new();
    for _ in 0..30 {
        let low = point::<2>(&mut random, 0.0, 10.0);
        list.push_box(low, [low[0] + 0.8, low[1] + 0.8]);
    }
    let space = FreeSpace::new([0.0; 2], [11.0; 2], list);
    let mut shortened = 0;
    for _ in 0..200 {
        let mut path = vec![point::<2>(&mut random, 0.0, 11.0)];
        for _ in 0..200 {
            let next = point::<2>(&mut random, 0.0, 11.0);
            if space.sees(&path[path.len() - 1], &next) && path.len() < 12 {
                path.push(next);
            }
        }
        let before = path.clone();
        shorten(&space, &mut path, 8);
        let (old, new) = (vector::length(&before), vector::length(&path));
        assert_eq!((path.first(), path.last()), (before.first(), before.last()));
        assert!(new <= old * (1.0 + 1e-12) && path.len() <= before.len());
        assert!(path.windows(2).all(|ends| space.sees(&ends[0], &ends[1])));
        shortened += u32::from(new < 0.9 * old);
    }
    assert!(shortened > 100, "{shortened}");
}

#[test]
fn a_path_round_a_block_becomes_taut() {
    let mut list = GrownList::<2>::new();
    list.push_box([3.0, 1.0], [7.0, 8.0]);
    let space = FreeSpace::new([0.0; 2], [10.0; 2], list);
    let mut path = vec![[0.0, 5.0], [0.0, 10.0], [10.0, 10.0], [10.0, 5.0]];
    shorten(&space, &mut path, 20);
    let shortest = 2.0 * 3.0 * core::f64::consts::SQRT_2 + 4.0;
    assert!(vector::length(&path) < 1.005 * shortest, "{path:?}");
}
