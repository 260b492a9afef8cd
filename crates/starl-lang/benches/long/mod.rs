//! Common code of the benchmarks of reading and formatting: a long program, and the time of a function.

#![allow(
    clippy::disallowed_methods,
    reason = "a benchmark reads the clock, nothing else does"
)]

use std::hint::black_box;
use std::time::Instant;

const RACE: &str = include_str!("../../tests/listings/race.starl");
const INTERSECTION: &str = include_str!("../../tests/listings/intersection.starl");
pub const LINES: usize = 1000;

/// A program of so many lines: the declarations of two listings again and again.
pub fn program() -> String {
    let mut text = String::from("program Long\n");
    let mut sources = [RACE, INTERSECTION].iter().cycle();
    while text.lines().count() < LINES {
        let source = sources.next().map_or("", |source| {
            source.split_once("\n\n").map_or("", |parts| parts.1)
        });
        text.push_str(source);
    }
    text.lines()
        .take(LINES)
        .map(|line| format!("{line}\n"))
        .collect()
}

/// Prints the best and the median milliseconds.
pub fn measure<T>(name: &str, mut run: impl FnMut() -> T) {
    let mut times: Vec<f64> = (0..200)
        .map(|_| {
            let start = Instant::now();
            black_box(run());
            start.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!(
        "{name:<24} best {:.3} ms, median {:.3} ms",
        times[0],
        times[times.len() / 2]
    );
}
