//! The index answers as a look at every obstacle would, however the obstacles lie.

use crate::geometry_cases::Cases;
use core::ops::ControlFlow;
use starl_core::geometry::{Bounds, ConvexPolygon, HeightSpan, Obstacle, ObstacleIndex, Point};
use starl_core::math;

/// Worlds of many kinds; `reach` of the places worth asking about comes with each.
fn world(cases: &mut Cases) -> (Vec<Obstacle>, f64) {
    let count = [0, 1, 2, 7, 40, 150, 900][cases.whole(0, 6) as usize];
    let reach = [0.5, 10.0, 60.0, 1e4][cases.whole(0, 3) as usize];
    let layout = cases.whole(0, 5);
    let obstacles = (0..count)
        .map(|at| {
            let mut p = cases.point(reach);
            match layout {
                // Along a line, on one spot, in two far apart crowds.
                0 => p.y = 3.0,
                1 => p = Point::ZERO,
                2 => p.x += if at % 2 == 0 { 1e7 } else { -1e7 },
                _ => {}
            }
            if layout == 3 && at % 20 == 0 {
                p = p * 1e12;
            }
            let size = cases.number(0.01, 1.0) * if cases.whole(0, 9) == 0 { reach } else { 1.0 };
            let way = cases.point(size);
            match cases.whole(0, 3) {
                0 => Obstacle::circle(p, size),
                1 => Obstacle::cuboid(p, p + way),
                2 => Obstacle::polygon(ConvexPolygon::new(&[p, p + way]).unwrap_or_else(|_| {
                    ConvexPolygon::new(&[Point::ZERO, Point::planar(1.0, 0.0)]).unwrap()
                })),
                _ => Obstacle::circle(p, size).with_height(HeightSpan::new(p.z, p.z + size)),
            }
        })
        .collect();
    (obstacles, reach)
}

fn each_once(mut found: Vec<u32>, seed: u64) -> Vec<u32> {
    let count = found.len();
    found.sort_unstable();
    found.dedup();
    assert_eq!(found.len(), count, "seed {seed}: one was reported twice");
    found
}

#[test]
fn every_obstacle_near_is_found_once() {
    for seed in 0..300 {
        let mut cases = Cases::new(seed);
        let (obstacles, reach) = world(&mut cases);
        let index = ObstacleIndex::new(&obstacles);
        for _ in 0..60 {
            let way = math::pow(cases.number(0.0, 1.0), 4.0) * reach;
            let p = cases.point(reach * 1.5);
            let bounds = Bounds::of_segment(p, p + cases.point(way));
            let bounds = if cases.whole(0, 3) == 0 {
                bounds.planar()
            } else {
                bounds
            };
            let mut found = Vec::new();
            let _ = index.for_each_near(&bounds, |index| {
                found.push(index);
                ControlFlow::<()>::Continue(())
            });
            let expected: Vec<u32> = (0..obstacles.len() as u32)
                .filter(|&at| obstacles[at as usize].bounds().overlaps(&bounds))
                .collect();
            assert_eq!(each_once(found, seed), expected, "seed {seed}");
            assert_eq!(index.near(&bounds), expected, "seed {seed}");
            assert_eq!(index.any_near(&bounds, |_| true), !expected.is_empty());
            assert!(!index.any_near(&bounds, |_| false));
        }
    }
}

#[test]
fn paths_bodies_and_rays_get_the_same_results_without_an_index() {
    for seed in 0..300 {
        let mut cases = Cases::new(seed);
        let (obstacles, reach) = world(&mut cases);
        let index = ObstacleIndex::new(&obstacles);
        for _ in 0..60 {
            let way = math::pow(cases.number(0.0, 1.0), 3.0) * reach * 2.0;
            let a = cases.point(reach * 1.2);
            let mut b = a + cases.point(way);
            match cases.whole(0, 5) {
                0 => b.y = a.y,
                1 => b.x = a.x,
                2 => b.y = a.y + 1e-12,
                _ => {}
            }
            let margin = if cases.whole(0, 1) == 0 {
                0.0
            } else {
                cases.number(0.0, 2.0)
            };
            let mut found = Vec::new();
            let _ = index.for_each_near_segment(a, b, margin, |index| {
                found.push(index);
                ControlFlow::<()>::Continue(())
            });
            let found = each_once(found, seed);
            for (at, obstacle) in obstacles.iter().enumerate() {
                let near = obstacle.blocks_segment(a, b, margin);
                assert!(
                    !near || found.contains(&(at as u32)),
                    "seed {seed}, obstacle {at}"
                );
            }
            let any = |test: &dyn Fn(&Obstacle) -> bool| obstacles.iter().any(test);
            assert_eq!(
                index.blocks_segment(a, b, margin),
                any(&|o| o.blocks_segment(a, b, margin)),
                "seed {seed}"
            );
            assert_eq!(
                index.blocks_body(a, b, margin, 0.5),
                any(&|o| o.blocks_body(a, b, margin, 0.5)),
                "seed {seed}"
            );
            let direction = Point::polar(1.0, cases.number(0.0, 6.3));
            let mut first = None;
            for (at, obstacle) in obstacles.iter().enumerate() {
                if let Some(distance) = obstacle.ray(a, direction, reach)
                    && first.is_none_or(|(_, least)| distance < least)
                {
                    first = Some((at as u32, distance));
                }
            }
            assert_eq!(index.ray(a, direction, reach), first, "seed {seed}");
        }
    }
}

#[test]
fn a_visit_can_be_ended() {
    let obstacles = vec![Obstacle::circle(Point::ZERO, 1.0); 50];
    let index = ObstacleIndex::new(&obstacles);
    let mut visits = 0;
    let flow = index.for_each_near(&obstacles[0].bounds(), |at| {
        visits += 1;
        if visits == 3 {
            ControlFlow::Break(at)
        } else {
            ControlFlow::Continue(())
        }
    });
    assert!(flow.is_break());
    assert_eq!(visits, 3);
}

#[test]
fn obstacles_without_usable_numbers_do_no_harm() {
    let bad = [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::MAX,
        1e300,
        -1e300,
    ];
    let mut obstacles = vec![Obstacle::circle(Point::planar(1.0, 1.0), 0.5)];
    for number in bad {
        obstacles.push(Obstacle::circle(Point::planar(number, 0.0), 1.0));
        obstacles.push(Obstacle::circle(Point::ZERO, number));
        obstacles.push(Obstacle::cuboid(
            Point::new(number, number, number),
            Point::ZERO,
        ));
    }
    let index = ObstacleIndex::new(&obstacles);
    let here = Point::planar(1.2, 1.0);
    assert!(index.near(&Bounds::of_segment(here, here)).contains(&0));
    for number in bad {
        let there = Point::new(number, -number, number);
        let _ = index.near(&Bounds::of_segment(here, there));
        let _ = index.blocks_segment(here, there, 0.1);
        let _ = index.blocks_segment(there, here, number);
        let _ = index.blocks_body(there, there, 0.1, number);
        let _ = index.ray(here, there, number);
    }
    assert!(index.blocks_segment(Point::ZERO, Point::planar(2.0, 2.0), 0.0));
}

#[test]
fn the_same_obstacles_are_reported_in_the_same_order() {
    let mut cases = Cases::new(7);
    let obstacles: Vec<Obstacle> = (0..400)
        .map(|_| Obstacle::circle(cases.point(30.0), cases.number(0.1, 3.0)))
        .collect();
    let order = || {
        let mut order = Vec::new();
        let index = ObstacleIndex::new(&obstacles).clone();
        let bounds =
            Bounds::of_segment(Point::planar(-9.0, -9.0), Point::planar(5.0, 9.0)).planar();
        let _ = index.for_each_near(&bounds, |index| {
            order.push(index);
            ControlFlow::<()>::Continue(())
        });
        order
    };
    assert_eq!(order(), order());
    assert!(order().len() > 20);
}
