//! RRT*: more nodes buy shorter paths, and enough of them nearly the shortest.

use crate::planning_support::{Case, length, model, rectangle};
use starl_core::motion::Planner;
use starl_core::{Point, Random};
use starl_motion::planning::free_space::FreeSpace;
use starl_motion::planning::grown::GrownList;
use starl_motion::planning::rrt_star::{Options, rrt_star};
use starl_motion::planning::vector;

/// A block in the middle of a square; the shortest way round it is by hand.
fn space() -> FreeSpace<2> {
    let mut list = GrownList::new();
    list.push_box([30.0, 10.0], [70.0, 80.0]);
    FreeSpace::new([0.0, 0.0], [100.0, 100.0], list)
}

/// Over the upper corners, each at 30 and 30 from an end.
const SHORTEST: f64 = 2.0 * 30.0 * core::f64::consts::SQRT_2 + 40.0;

#[test]
fn it_approaches_the_shortest_path_with_more_nodes() {
    let (start, target) = ([0.0, 50.0], [100.0, 50.0]);
    let mut sums = [0.0; 4];
    for seed in 0..20 {
        for (sum, most_nodes) in sums.iter_mut().zip([100, 300, 1_000, 5_000]) {
            let options = Options {
                most_nodes,
                long_enough: 0.0,
                shortest_step: 1e-3,
            };
            let mut random = Random::keyed(seed, &[]);
            let path = rrt_star(&space(), &start, &target, &[], &options, &mut random);
            let path = path.expect("a path");
            assert_eq!((path[0], path[path.len() - 1]), (start, target));
            *sum += vector::length(&path) / 20.0;
        }
    }
    assert!(sums.windows(2).all(|pair| pair[1] < pair[0]), "{sums:?}");
    assert!(
        sums[3] >= SHORTEST && sums[3] < 1.0005 * SHORTEST,
        "{sums:?}"
    );
}

#[test]
fn with_every_further_node_the_path_is_as_short_or_shorter() {
    let (start, target) = ([0.0, 50.0], [100.0, 50.0]);
    for seed in 0..20 {
        let (mut before, mut first) = (f64::INFINITY, f64::INFINITY);
        for most_nodes in (20..=400).step_by(20) {
            let options = Options {
                most_nodes,
                long_enough: 0.0,
                shortest_step: 1e-3,
            };
            let mut random = Random::keyed(seed, &[]);
            let path = rrt_star(&space(), &start, &target, &[], &options, &mut random);
            let now = path.map_or(f64::INFINITY, |path| vector::length(&path));
            assert!(now <= before, "seed {seed}, {most_nodes} nodes");
            first = if first.is_finite() { first } else { now };
            before = now;
        }
        assert!(before < first, "seed {seed}: {before} {first}");
    }
}

#[test]
fn a_known_path_is_where_it_starts_from() {
    let (start, target) = ([0.0, 50.0], [100.0, 50.0]);
    let known = [start, [20.0, 5.0], [80.0, 5.0], target];
    let options = Options {
        most_nodes: 4,
        long_enough: 0.0,
        shortest_step: 1e-3,
    };
    let mut random = Random::keyed(1, &[]);
    let path = rrt_star(&space(), &start, &target, &known, &options, &mut random);
    assert_eq!(path, Some(known.to_vec()));
    let options = Options {
        most_nodes: 2_000,
        ..options
    };
    let path = rrt_star(&space(), &start, &target, &known, &options, &mut random).expect("a path");
    // The other way round the block is shorter, and only a search over all of the space finds it.
    assert!(vector::length(&path) < 1.01 * SHORTEST, "{path:?}");
}

#[test]
fn for_robots_it_finds_the_shorter_way_round() {
    let model = model("create");
    let obstacles = vec![rectangle((1.0, -0.6), (1.2, 3.0))];
    let case = Case::new(Point::ZERO, Point::planar(2.2, 0.0), obstacles);
    let reach = 0.165 * (1.0 + starl_motion::planning::Options::default().margin_radii);
    // Taut round the lower corners of the grown block, except for its rounding.
    let (x, y): (f64, f64) = (1.0 - reach * 0.3, 0.6 + reach);
    let about = 2.0 * (x * x + y * y).sqrt() + 0.2 + reach;
    for seed in 0..10 {
        let case = case.clone().with(Planner::RrtStar, seed);
        let path = case.plan(&*model).expect("a path");
        let length = length(&case.whole(&*model, &path));
        assert!(length < about, "{length} {about} {path:?}");
    }
}
