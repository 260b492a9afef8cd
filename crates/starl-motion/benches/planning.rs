//! Planners on three worlds of boxes, beside the figures of OMPL 1.5 on the same worlds.
//!
//! A point moves in a square or cube of side 100 from corner to corner. Each planner runs with many
//! seeds; a run includes building the space from the list of boxes and, where it says so, shortening
//! the path. Every run is repeated and the quickest counts, because on a busy machine that is what
//! comes nearest to the processor time OMPL's figures are; medians are over the seeds.
//!
//! `cargo bench -p starl-motion --bench planning -- [--quick]`

#![allow(clippy::disallowed_methods)] // A benchmark reads the clock.

use starl_core::Random;
use starl_motion::planning::free_space::FreeSpace;
use starl_motion::planning::grown::GrownList;
use starl_motion::planning::rrt_connect::{self, rrt_connect};
use starl_motion::planning::shorten::shorten;
use starl_motion::planning::vector::{Vector, length};
use std::time::Instant;

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
}

type Plan<'a, const D: usize> =
    dyn Fn(&FreeSpace<D>, &World<D>, &mut Random) -> Option<Vec<Vector<D>>> + 'a;

fn median(numbers: &mut [f64]) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Prints a row: planner, solved, median and worst milliseconds, median length.
fn measure<const D: usize>(name: &str, world: &World<D>, seeds: u64, plan: &Plan<D>, peer: &str) {
    let (mut times, mut lengths) = (Vec::new(), Vec::new());
    for seed in 0..seeds {
        let mut best = f64::INFINITY;
        let mut found = None;
        for _ in 0..3 {
            let mut random = Random::keyed(seed, &[]);
            let started = Instant::now();
            let space = world.space();
            found = plan(&space, world, &mut random);
            best = best.min(started.elapsed().as_secs_f64() * 1e3);
        }
        times.push(best);
        lengths.extend(found.map(|path| length(&path)));
    }
    let solved = lengths.len();
    let worst = times.iter().copied().fold(0.0, f64::max);
    println!(
        "{name:<34} {solved:>4}/{seeds:<4} {:>9.4} {worst:>9.4} {:>8.1}   {peer}",
        median(&mut times),
        median(&mut lengths),
    );
}

fn connect<const D: usize>(step: f64, rounds: Option<u32>) -> Box<Plan<'static, D>> {
    let options = rrt_connect::Options {
        most_nodes: 100_000,
        longest_step: step,
        shortest_step: 1e-3,
    };
    Box::new(move |space, world, random| {
        let mut path = rrt_connect(space, &world.start, &world.goal, &options, random)?;
        if let Some(rounds) = rounds {
            shorten(space, &mut path, rounds);
        }
        Some(path)
    })
}

fn table<const D: usize>(name: &str, text: &str, seeds: u64, peer: [&str; 3]) {
    let world = World::<D>::read(text);
    println!("\n{name}: {} boxes", world.boxes.len());
    println!(
        "{:<34} {:>9} {:>9} {:>9} {:>8}   peer: median ms, length",
        "planner", "solved", "median ms", "worst ms", "length"
    );
    measure(
        "RRT-Connect",
        &world,
        seeds,
        &*connect(f64::INFINITY, None),
        "",
    );
    measure(
        "RRT-Connect, shortened",
        &world,
        seeds,
        &*connect(f64::INFINITY, Some(8)),
        peer[1],
    );
    measure(
        "RRT-Connect, shortened 1",
        &world,
        seeds,
        &*connect(f64::INFINITY, Some(1)),
        peer[1],
    );
    measure(
        "RRT-Connect, steps of 5",
        &world,
        seeds,
        &*connect(5.0, None),
        peer[1],
    );
    measure(
        "RRT-Connect, steps of 5, shortened",
        &world,
        seeds,
        &*connect(5.0, Some(8)),
        peer[1],
    );
    measure(
        "RRT-Connect, steps of 5, shortened 1",
        &world,
        seeds,
        &*connect(5.0, Some(1)),
        peer[1],
    );
}

fn main() {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let seeds = if quick { 51 } else { 501 };
    table::<2>(
        "2d_boxes",
        include_str!("worlds/scen_2d_boxes.txt"),
        seeds,
        ["18.0", "4.9, 169", "322; 139.8 after 1 s"],
    );
    table::<2>(
        "2d_narrow",
        include_str!("worlds/scen_2d_narrow.txt"),
        seeds,
        ["1.46", "1.30, 355", "19.0; 251.4 after 1 s"],
    );
    table::<3>(
        "3d_boxes",
        include_str!("worlds/scen_3d_boxes.txt"),
        seeds,
        ["15.9", "2.4, 296", "138; 247.6 after 1 s"],
    );
}
