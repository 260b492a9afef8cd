//! Planners keep to the box of the world they are given.

use starl_core::Random;
use starl_motion::planning::free_space::FreeSpace;
use starl_motion::planning::grown::GrownList;
use starl_motion::planning::rrt::{self, Straight, rrt};
use starl_motion::planning::rrt_connect::{self, rrt_connect};
use starl_motion::planning::rrt_star::{self, rrt_star};
use starl_motion::planning::space::Space;
use starl_motion::planning::vector::Vector;

const MOST_NODES: u32 = 2_000;

/// Paths of all planners between two points of the space.
fn paths<const D: usize>(
    space: &FreeSpace<D>,
    start: &Vector<D>,
    target: &Vector<D>,
    seed: u64,
) -> [Option<Vec<Vector<D>>>; 3] {
    let random = || Random::keyed(seed, &[]);
    let (most_nodes, shortest_step) = (MOST_NODES, 1e-3);
    let options = rrt_connect::Options {
        most_nodes,
        longest_step: f64::INFINITY,
        shortest_step,
    };
    let connect = rrt_connect(space, start, target, &options, &mut random());
    let options = rrt_star::Options {
        most_nodes,
        long_enough: 0.0,
        shortest_step,
    };
    let star = rrt_star(space, start, target, &[], &options, &mut random());
    let options = rrt::Options {
        most_nodes,
        threshold: 0.05,
    };
    let steering = Straight { space };
    let tree = rrt(
        space,
        &steering,
        (start, ()),
        target,
        &options,
        &mut random(),
    );
    [connect, star, tree]
}

/// A wall across a square of side 10, with a gap at the bottom; it sticks out at the top, past which
/// there would be a shorter way round.
fn walled(gap: f64) -> FreeSpace<2> {
    let mut list = GrownList::new();
    list.push_box([4.0, gap], [5.0, 10.5]);
    FreeSpace::new([0.0; 2], [10.0; 2], list)
}

#[test]
fn paths_stay_in_the_box_even_if_a_path_outside_is_shorter() {
    let space = walled(1.0);
    for seed in 0..20 {
        for path in paths(&space, &[1.0, 9.0], &[9.0, 9.0], seed) {
            let path = path.expect("a path through the gap");
            assert!(
                path.iter().flatten().all(|at| (0.0..=10.0).contains(at)),
                "{path:?}"
            );
            assert!(path.windows(2).all(|ends| space.sees(&ends[0], &ends[1])));
            assert!(path.iter().any(|at| at[1] < 1.0));
        }
    }
}

#[test]
fn without_a_gap_there_is_no_path() {
    for path in paths(&walled(-1.0), &[1.0, 9.0], &[9.0, 9.0], 1) {
        assert_eq!(path, None);
    }
}

#[test]
fn in_space_too() {
    let mut list = GrownList::new();
    list.push_box([4.0, -1.0, 1.0], [5.0, 11.0, 11.0]);
    let space = FreeSpace::new([0.0; 3], [10.0; 3], list);
    for seed in 0..20 {
        for path in paths(&space, &[1.0, 5.0, 9.0], &[9.0, 5.0, 9.0], seed) {
            let path = path.expect("a path under the wall");
            assert!(
                path.iter().flatten().all(|at| (0.0..=10.0).contains(at)),
                "{path:?}"
            );
            assert!(path.windows(2).all(|ends| space.sees(&ends[0], &ends[1])));
        }
    }
}

#[test]
fn a_start_or_target_outside_the_box_gives_no_path() {
    let space = walled(1.0);
    for seed in 0..3 {
        assert_eq!(
            paths(&space, &[-1.0, 9.0], &[9.0, 9.0], seed),
            [None, None, None]
        );
        assert_eq!(
            paths(&space, &[1.0, 9.0], &[9.0, 11.0], seed),
            [None, None, None]
        );
    }
}
