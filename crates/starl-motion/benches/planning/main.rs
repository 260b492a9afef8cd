//! Measures the speed of planning and the length of its paths: a point compared with OMPL, and robots in their worlds.
//!
//! Every planner runs with many seeds. A run is repeated three times and the fastest counts, because on a busy machine
//! it is closest to processor time, which the peer's figures use; medians are over the seeds.
//!
//! `cargo bench -p starl-motion --bench planning -- [--quick]`

#![allow(clippy::disallowed_methods)] // A benchmark reads the clock.

mod peer;
mod robots;

use std::time::Instant;

fn median(numbers: &mut [f64]) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The least time of three runs in seconds, and what the last gave.
fn quickest<T>(mut run: impl FnMut() -> T) -> (f64, T) {
    let mut timed = || {
        let started = Instant::now();
        let result = run();
        (started.elapsed().as_secs_f64(), result)
    };
    let (first, second, third) = (timed().0, timed().0, timed());
    (first.min(second).min(third.0), third.1)
}

fn main() {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let seeds = if quick { 51 } else { 501 };
    peer::tables(seeds);
    robots::race(seeds);
    robots::giving_up(seeds);
    robots::many_obstacles(seeds);
}
