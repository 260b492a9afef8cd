//! A point on three worlds of boxes, beside the figures of OMPL 1.5 on the same worlds.
//!
//! It moves in a square or cube of side 100 from corner to corner. A run includes building the space
//! from the list of boxes and, where it says so, shortening the path.

use super::{median, quickest};
use starl_core::Random;
use starl_motion::planning::free_space::FreeSpace;
use starl_motion::planning::grown::GrownList;
use starl_motion::planning::rrt::{self, Straight, rrt};
use starl_motion::planning::rrt_connect::{self, rrt_connect};
use starl_motion::planning::rrt_star::{self, rrt_star};
use starl_motion::planning::shorten::shorten;
use starl_motion::planning::vector::{Vector, length};

/// Nodes at which a planner gives up.
const MOST_NODES: u32 = 100_000;

/// Shorter edges are not worth a node.
const SHORTEST_STEP: f64 = 1e-3;

struct World<const D: usize> {
    boxes: Vec<(Vector<D>, Vector<D>)>,
    low: f64,
    high: f64,
    start: Vector<D>,
    goal: Vector<D>,
}

impl<const D: usize> World<D> {
    /// Reads `dimension low high resolution`, start, goal, count, then two corners a box.
    fn read(text: &str) -> World<D> {
        let mut numbers = text
            .split_whitespace()
            .map(|word| word.parse::<f64>().expect("a number"));
        let mut next = || numbers.next().expect("another number");
        assert_eq!(next(), D as f64, "dimension");
        let (low, high, _resolution) = (next(), next(), next());
        let mut point = || core::array::from_fn(|_| next());
        let (start, goal) = (point(), point());
        let count = next() as usize;
        let mut point = || core::array::from_fn(|_| next());
        let boxes = (0..count).map(|_| (point(), point())).collect();
        World {
            boxes,
            low,
            high,
            start,
            goal,
        }
    }

    fn space(&self) -> FreeSpace<D> {
        let mut list = GrownList::new();
        for (low, high) in &self.boxes {
            list.push_box(*low, *high);
        }
        FreeSpace::new([self.low; D], [self.high; D], list)
    }

    fn connect(&self, random: &mut Random, longest_step: f64) -> (FreeSpace<D>, Found<D>) {
        let space = self.space();
        let options = rrt_connect::Options {
            most_nodes: MOST_NODES,
            longest_step,
            shortest_step: SHORTEST_STEP,
        };
        let path = rrt_connect(&space, &self.start, &self.goal, &options, random);
        (space, path)
    }

    fn connect_and_shorten(&self, random: &mut Random, longest_step: f64) -> Found<D> {
        let (space, path) = self.connect(random, longest_step);
        let mut path = path?;
        shorten(&space, &mut path, 8);
        Some(path)
    }

    fn rrt(&self, random: &mut Random) -> Found<D> {
        let space = self.space();
        let steering = Straight { space: &space };
        let options = rrt::Options {
            most_nodes: MOST_NODES,
            threshold: 0.5,
        };
        rrt(
            &space,
            &steering,
            (&self.start, ()),
            &self.goal,
            &options,
            random,
        )
    }

    /// RRT* alone until there is a path, or from a shortened path of RRT-Connect with so many nodes.
    fn star(&self, random: &mut Random, nodes: Option<u32>) -> Found<D> {
        let known = nodes.and_then(|_| self.connect_and_shorten(random, f64::INFINITY));
        let options = rrt_star::Options {
            most_nodes: nodes.unwrap_or(MOST_NODES),
            long_enough: if nodes.is_some() { 0.0 } else { f64::INFINITY },
            shortest_step: SHORTEST_STEP,
        };
        let (start, goal) = (&self.start, &self.goal);
        rrt_star(
            &self.space(),
            start,
            goal,
            &known.unwrap_or_default(),
            &options,
            random,
        )
    }
}

type Found<const D: usize> = Option<Vec<Vector<D>>>;

/// Prints a row: planner, solved, median and worst milliseconds, median length, the peer's.
fn row<const D: usize>(name: &str, seeds: u64, peer: &str, plan: impl Fn(&mut Random) -> Found<D>) {
    let (mut times, mut lengths) = (Vec::new(), Vec::new());
    for seed in 0..seeds {
        let (seconds, found) = quickest(|| plan(&mut Random::keyed(seed, &[])));
        times.push(seconds * 1e3);
        lengths.extend(found.map(|path| length(&path)));
    }
    let solved = format!("{}/{seeds}", lengths.len());
    let worst = times.iter().copied().fold(0.0, f64::max);
    let (time, length) = (median(&mut times), median(&mut lengths));
    println!("{name:<34} {solved:>9} {time:>10.4} {worst:>10.4} {length:>8.1}   {peer}");
}

fn table<const D: usize>(name: &str, text: &str, seeds: u64, peer: [&str; 4]) {
    let world = World::<D>::read(text);
    println!("\n{name}: {} boxes", world.boxes.len());
    println!(
        "{:<34} {:>9} {:>10} {:>10} {:>8}   OMPL: ms, length",
        "planner", "solved", "median ms", "worst ms", "length"
    );
    row("RRT", seeds, peer[0], |random| world.rrt(random));
    row("RRT-Connect", seeds, peer[1], |random| {
        world.connect(random, f64::INFINITY).1
    });
    row("RRT-Connect, shortened", seeds, peer[1], |random| {
        world.connect_and_shorten(random, f64::INFINITY)
    });
    row("RRT-Connect, steps of 5", seeds, peer[1], |random| {
        world.connect(random, 5.0).1
    });
    row(
        "RRT-Connect, steps of 5, shortened",
        seeds,
        peer[1],
        |random| world.connect_and_shorten(random, 5.0),
    );
    let few = seeds / 10;
    row("RRT*, first path", few, peer[2], |random| {
        world.star(random, None)
    });
    row("RRT*, 1,000 nodes", few, peer[3], |random| {
        world.star(random, Some(1_000))
    });
    row("RRT*, 10,000 nodes", few, peer[3], |random| {
        world.star(random, Some(10_000))
    });
}

/// All three worlds.
pub fn tables(seeds: u64) {
    let text = include_str!("../worlds/scen_2d_boxes.txt");
    table::<2>(
        "2d_boxes",
        text,
        seeds,
        ["18.0", "4.9, 169", "322", "1000, 139.8"],
    );
    let text = include_str!("../worlds/scen_2d_narrow.txt");
    table::<2>(
        "2d_narrow",
        text,
        seeds,
        ["1.46", "1.30, 355", "19.0", "1000, 251.4"],
    );
    let text = include_str!("../worlds/scen_3d_boxes.txt");
    table::<3>(
        "3d_boxes",
        text,
        seeds,
        ["15.9", "2.4, 296", "138", "1000, 247.6"],
    );
}
