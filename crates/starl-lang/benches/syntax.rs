//! Measures the speed of parsing and formatting: `cargo bench -p starl-lang --bench syntax` prints the best and the
//! median milliseconds for a program of 1,000 lines. Reading and checking together should take less than 10.

#![allow(
    clippy::disallowed_methods,
    reason = "a benchmark reads the clock, nothing else does"
)]

use starl_lang::format::format_parse;
use starl_lang::syntax::ast::Expression;
use starl_lang::syntax::{ast::AstNode, parse};
use std::hint::black_box;
use std::time::Instant;

const RACE: &str = include_str!("../tests/listings/race.starl");
const INTERSECTION: &str = include_str!("../tests/listings/intersection.starl");
const LINES: usize = 1000;

/// A program of 1,000 lines: the declarations of two listings again and again.
fn program() -> String {
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

fn measure<T>(name: &str, mut run: impl FnMut() -> T) {
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

fn main() {
    let text = program();
    let read = parse(&text);
    println!(
        "{} lines, {} bytes, {} problems",
        LINES,
        text.len(),
        read.diagnostics().len()
    );
    measure("read", || parse(&text));
    measure("walk every expression", || {
        read.syntax()
            .descendants()
            .filter_map(Expression::cast)
            .map(|expression| expression.span().start)
            .max()
    });
    measure("lay out", || format_parse(&read));
}
