//! Without a path every planner ends, and its work is bounded by its number of nodes.

use core::cell::Cell;
use starl_core::Random;
use starl_motion::planning::free_space::FreeSpace;
use starl_motion::planning::grown::GrownList;
use starl_motion::planning::rrt::{self, Straight, rrt};
use starl_motion::planning::rrt_connect::{self, rrt_connect};
use starl_motion::planning::rrt_star::{self, rrt_star};
use starl_motion::planning::space::{Reach, Space};
use starl_motion::planning::vector::Vector;

/// A space that counts the samples drawn from it.
struct Counted {
    space: FreeSpace<2>,
    samples: Cell<u32>,
}

impl Space<2> for Counted {
    fn sample(&self, random: &mut Random) -> Vector<2> {
        self.samples.set(self.samples.get() + 1);
        self.space.sample(random)
    }

    fn reach(&self, a: &Vector<2>, b: &Vector<2>) -> Reach<2> {
        self.space.reach(a, b)
    }

    fn sees(&self, a: &Vector<2>, b: &Vector<2>) -> bool {
        self.space.sees(a, b)
    }

    fn volume(&self) -> f64 {
        self.space.volume()
    }
}

/// A square in two halves, with a wall between.
fn halves() -> Counted {
    let mut list = GrownList::new();
    list.push_box([4.9, -1.0], [5.1, 11.0]);
    Counted {
        space: FreeSpace::new([0.0; 2], [10.0; 2], list),
        samples: Cell::new(0),
    }
}

const START: Vector<2> = [1.0, 5.0];
const TARGET: Vector<2> = [9.0, 5.0];

#[test]
fn rrt_ends_after_at_most_twice_as_many_samples_as_nodes() {
    for most_nodes in [0, 1, 2, 50, 1_000] {
        for seed in 0..10 {
            let space = halves();
            let options = rrt::Options {
                most_nodes,
                threshold: 0.05,
            };
            let steering = Straight { space: &space };
            let random = &mut Random::keyed(seed, &[]);
            let path = rrt(&space, &steering, (&START, ()), &TARGET, &options, random);
            assert_eq!(path, None);
            assert!(space.samples.get() <= 2 * most_nodes);
        }
    }
}

#[test]
fn rrt_connect_ends_after_at_most_twice_as_many_samples_as_nodes() {
    for most_nodes in [0, 1, 2, 50, 1_000] {
        for seed in 0..10 {
            let space = halves();
            let options = rrt_connect::Options {
                most_nodes,
                longest_step: f64::INFINITY,
                shortest_step: 1e-3,
            };
            let random = &mut Random::keyed(seed, &[]);
            assert_eq!(rrt_connect(&space, &START, &TARGET, &options, random), None);
            assert!(space.samples.get() <= 2 * most_nodes);
        }
    }
}

#[test]
fn rrt_star_ends_after_at_most_ten_times_as_many_samples_as_nodes() {
    for most_nodes in [0, 1, 2, 50, 1_000] {
        for seed in 0..10 {
            let space = halves();
            let options = rrt_star::Options {
                most_nodes,
                long_enough: 0.0,
                shortest_step: 1e-3,
            };
            let random = &mut Random::keyed(seed, &[]);
            let path = rrt_star(&space, &START, &TARGET, &[], &options, random);
            assert_eq!(path, None);
            assert!(space.samples.get() <= 10 * most_nodes);
        }
    }
}
