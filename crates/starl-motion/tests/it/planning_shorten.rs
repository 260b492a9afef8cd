//! Shortening keeps what a path must keep, and makes it taut.

use starl_core::Random;
use starl_motion::planning::free_space::FreeSpace;
use starl_motion::planning::grown::GrownList;
use starl_motion::planning::shorten::shorten;
use starl_motion::planning::space::Space;
use starl_motion::planning::vector::{self, Vector};

fn point<const D: usize>(random: &mut Random, low: f64, high: f64) -> Vector<D> {
    core::array::from_fn(|_| random.between(low, high))
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
