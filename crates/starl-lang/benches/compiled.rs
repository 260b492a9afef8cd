//! How fast compiled programs run: those of the benchmark of the machine, and of `tools/bench_lua.sh`,
//! written in the language; and how long compiling takes.
//!
//! `cargo bench -p starl-lang --bench compiled` prints each program's best and median milliseconds.

#![allow(
    clippy::disallowed_methods,
    reason = "a benchmark reads the clock, nothing else does"
)]

mod measure;

use measure::{measure, milliseconds};
use starl_lang::check::{NoLibraries, check};
use starl_lang::compile::compile;
use starl_lang::machine::{Bytecode, Import, Program};

const SOURCE: &str = "library benchmark

function loop(turns: Int) -> Int
    let s = 0
    for i in 0..turns
        s += i % 7
    return s

function fib(n: Int) -> Int
    if n < 2
        return n
    return fib(n - 1) + fib(n - 2)

function list(turns: Int) -> Int
    let numbers = [i for i in 0..1000]
    let s = 0
    for turn in 0..turns
        for i in 0..1000
            let number = numbers[i]
            s += number
            numbers[i] = number
    return s
";

const RACE: &str = include_str!("../tests/listings/race.starl");

fn compiled(source: &str) -> Bytecode {
    compile(&check(source, &NoLibraries)).expect("the program is correct")
}

fn measure_compiler(name: &str, source: &str) {
    let mut times: Vec<f64> = (0..101)
        .map(|_| {
            let start = milliseconds();
            assert!(!compiled(source).code.is_empty());
            milliseconds() - start
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!(
        "{name}: read, checked and compiled in {:.3} ms, median of 101",
        times[times.len() / 2]
    );
}

fn main() {
    let program = Program::load(compiled(SOURCE), &|_: &Import| None).expect("it is valid");
    let numbered = |name: &str| {
        let functions = program.bytecode().functions.iter();
        let mut names = functions.map(|function| function.name.as_str());
        names.position(|found| found == name).expect("it is there") as u32
    };
    let (turns, sum) = (2_000_000, 5_999_995);
    measure(&program, "loop of 2,000,000", numbered("loop"), turns, sum);
    measure(&program, "fib 22", numbered("fib"), 22, 17_711);
    measure(&program, "fib 30", numbered("fib"), 30, 832_040);
    let list = numbered("list");
    measure(
        &program,
        "list of 1,000, 1,000 times",
        list,
        1000,
        499_500_000,
    );
    measure_compiler("Race", RACE);
}
