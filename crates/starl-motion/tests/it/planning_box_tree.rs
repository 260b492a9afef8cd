//! The tree of boxes finds what looking at every box does, and a touch counts.

use starl_core::Random;
use starl_motion::planning::box_tree::BoxTree;
use starl_motion::planning::ray::Ray;
use starl_motion::planning::vector::Vector;

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
fn the_tree_of_boxes_agrees_with_a_list() {
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
