//! The nearest point is the one that looking at every point finds.

use starl_core::Random;
use starl_motion::planning::nearest::Nearest;
use starl_motion::planning::vector::{self, Vector};

fn point<const D: usize>(random: &mut Random, low: f64, high: f64) -> Vector<D> {
    core::array::from_fn(|_| random.between(low, high))
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
fn many_points_at_one_place_are_handled() {
    let mut set = Nearest::<2>::new();
    for _ in 0..100 {
        set.add(&[1.0, 2.0]);
    }
    set.add(&[1.0, 2.5]);
    assert_eq!(set.nearest(&[5.0, 9.0]), 100);
    assert!(set.nearest(&[1.0, 1.0]) < 100);
}
