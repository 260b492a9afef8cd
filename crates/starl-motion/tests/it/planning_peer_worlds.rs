//! The worlds on which RRT-Connect is compared with OMPL's: it solves them with every seed, its paths
//! are free, and they are no more than a twentieth longer than OMPL's median. Times are for the
//! benchmark.

use starl_core::Random;
use starl_motion::planning::free_space::FreeSpace;
use starl_motion::planning::grown::GrownList;
use starl_motion::planning::rrt_connect::{Options, rrt_connect};
use starl_motion::planning::shorten::shorten;
use starl_motion::planning::vector::{Vector, between, length};

const SEEDS: u64 = 51;

/// The median length of the paths for these seeds; all are checked.
fn median_length<const D: usize>(text: &str) -> f64 {
    let numbers = text.split_whitespace().map(str::parse);
    let mut numbers = numbers.map(|number: Result<f64, _>| number.expect("a number"));
    let mut next = || numbers.next().expect("another number");
    assert_eq!(next(), D as f64);
    let (low, high, _resolution) = (next(), next(), next());
    let mut point = || -> Vector<D> { core::array::from_fn(|_| next()) };
    let (start, goal) = (point(), point());
    let count = next() as usize;
    let mut point = || -> Vector<D> { core::array::from_fn(|_| next()) };
    let boxes: Vec<_> = (0..count).map(|_| (point(), point())).collect();
    let mut list = GrownList::new();
    for (low, high) in &boxes {
        list.push_box(*low, *high);
    }
    let space = FreeSpace::new([low; D], [high; D], list);
    let options = Options {
        most_nodes: 100_000,
        longest_step: f64::INFINITY,
        shortest_step: 1e-3,
    };
    let inside = |at: &Vector<D>, (low, high): &(Vector<D>, Vector<D>)| {
        (0..D).all(|axis| low[axis] < at[axis] && at[axis] < high[axis])
    };
    let mut lengths = Vec::new();
    for seed in 0..SEEDS {
        let mut random = Random::keyed(seed, &[]);
        let path = rrt_connect(&space, &start, &goal, &options, &mut random);
        let mut path = path.unwrap_or_else(|| panic!("seed {seed}"));
        shorten(&space, &mut path, 8);
        assert_eq!((path[0], path[path.len() - 1]), (start, goal));
        for ends in path.windows(2) {
            for step in 0..=2_000 {
                let at = between(&ends[0], &ends[1], f64::from(step) / 2_000.0);
                assert!(at.iter().all(|at| (low..=high).contains(at)), "{seed}");
                assert!(!boxes.iter().any(|one| inside(&at, one)), "{seed} {at:?}");
            }
        }
        lengths.push(length(&path));
    }
    lengths.sort_by(f64::total_cmp);
    lengths[lengths.len() / 2]
}

#[test]
fn forty_boxes_in_the_plane() {
    let median = median_length::<2>(include_str!("../../benches/worlds/scen_2d_boxes.txt"));
    assert!(median <= 1.05 * 169.0, "{median}");
}

#[test]
fn a_narrow_passage_in_the_plane() {
    let median = median_length::<2>(include_str!("../../benches/worlds/scen_2d_narrow.txt"));
    assert!(median <= 1.05 * 355.0, "{median}");
}

#[test]
fn a_hundred_and_fifty_boxes_in_space() {
    let median = median_length::<3>(include_str!("../../benches/worlds/scen_3d_boxes.txt"));
    assert!(median <= 1.05 * 296.0, "{median}");
}
