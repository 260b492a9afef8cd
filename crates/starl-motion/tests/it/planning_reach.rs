//! The first obstacle on a ray decides its length, independent of the order of tests.

use starl_core::Random;
use starl_motion::planning::free_space::FreeSpace;
use starl_motion::planning::grown::GrownList;
use starl_motion::planning::space::Space;
use starl_motion::planning::vector::{Vector, between};

const NOWHERE: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

#[test]
fn a_wall_is_not_forgotten_for_a_slope_behind_it() {
    // The start is in the box around the triangle and before the wall.
    let mut list = GrownList::<2>::new();
    let wall = [[-5.0, 1.0], [5.0, 1.0]];
    list.push_round(wall.into_iter(), 0.1, NOWHERE);
    let triangle = [[-4.0, -4.0], [4.0, 4.0], [-4.0, 4.0]];
    list.push_round(triangle.into_iter(), 0.1, NOWHERE);
    let space = FreeSpace::new([-9.0; 2], [9.0; 2], list);
    let reach = space.reach(&[3.0, 0.0], &[3.0, 10.0]);
    assert!((reach.free - 0.09).abs() < 1e-6, "{reach:?}");
}

#[test]
fn the_reachable_part_is_clear_and_a_longer_one_is_not() {
    let mut random = Random::keyed(3, &[]);
    let point =
        |random: &mut Random| -> Vector<2> { core::array::from_fn(|_| random.between(0.0, 10.0)) };
    let mut stopped = 0;
    for _ in 0..60 {
        let mut list = GrownList::<2>::new();
        for _ in 0..12 {
            let at = point(&mut random);
            let mut near = || {
                [
                    at[0] + random.between(0.0, 3.0),
                    at[1] + random.between(0.0, 3.0),
                ]
            };
            let [a, b, c] = [near(), near(), near()];
            let turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            let corners = if turn > 0.0 { [a, b, c] } else { [a, c, b] };
            list.push_round(corners.into_iter(), 0.2, NOWHERE);
        }
        let space = FreeSpace::new([0.0; 2], [10.0; 2], list);
        for _ in 0..200 {
            let (a, b) = (point(&mut random), point(&mut random));
            let reach = space.reach(&a, &b);
            if !space.is_free(&a) {
                assert_eq!(reach.free, 0.0);
            } else if reach.free > 0.0 {
                assert!(space.sees(&a, &between(&a, &b, reach.free)));
                let further = reach.free * (1.0 + 1e-5);
                assert!(reach.free >= 1.0 || !space.sees(&a, &between(&a, &b, further)));
                stopped += u32::from(reach.free < 1.0);
            }
        }
    }
    assert!(stopped > 500, "{stopped}");
}
