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

function map_int(turns: Int) -> Int
    let counts: Map[Int, Int] = {:}
    for turn in 0..turns
        for i in 0..1000
            let key = i * 7919 % 1000
            counts[key] = (counts.get(key) ?? 0) + 1
    return counts.get(999) ?? 0

function map_apart(turns: Int) -> Int
    let counts: Map[Int, Int] = {i * 7919 % 1000: i for i in 0..1000}
    let s = 0
    for turn in 0..turns
        for i in 0..1000
            let key = i * 7919 % 1000
            s += counts[key]
            counts[key] = i
    return s

function map_string(turns: Int) -> Int
    let keys = [\"key \" + String(i * 7919 % 1000) for i in 0..1000]
    let counts: Map[String, Int] = {:}
    for turn in 0..turns
        for key in keys
            counts[key] = (counts.get(key) ?? 0) + 1
    return counts.get(\"key 999\") ?? 0

function strings(turns: Int) -> Int
    let found = 0
    for turn in 0..turns
        let line = \"\"
        for i in 0..20
            line += \"word\" + String(i) + \",\"
        for word in line.split(\",\")
            if word == \"word7\" then found += 1
    return found

record Particle {x: Float, v: Float, hits: Int}

function records(turns: Int) -> Int
    let particles = [Particle(Float(i), 1.0, 0) for i in 0..100]
    let hits = 0
    for turn in 0..turns
        for i in 0..100
            let p = particles[i]
            p.x += p.v
            if p.x > 50.0
                p.v = -1.0
                p.hits += 1
            elif p.x < 0.0
                p.v = 1.0
            particles[i] = p
            hits += 1
    return hits

function sort(turns: Int) -> Int
    let size = 0
    for turn in 0..turns
        let x = 42
        let numbers: List[Int] = []
        for i in 0..1000
            x = (x * 1103515245 + 12345) % 2147483648
            numbers.add(x)
        let sorted = numbers.sorted()
        if sorted[0] <= sorted[999] then size += sorted.size()
    return size

function escapes(cr: Float, ci: Float) -> Bool
    let x = 0.0
    let y = 0.0
    for i in 0..50
        let next = x * x - y * y + cr
        y = 2.0 * x * y + ci
        x = next
        if x * x + y * y > 4.0
            return true
    return false

function mandelbrot(size: Int) -> Int
    let inside = 0
    for row in 0..size
        for column in 0..size
            if not escapes(3.0 * Float(column) / Float(size) - 2.0, 2.0 * Float(row) / Float(size) - 1.0)
                inside += 1
    return inside
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
    let others = [
        ("map by Int of 1,000, 100 times", "map_int", 100, 100),
        (
            "map read and written, 100 times",
            "map_apart",
            100,
            49_950_000,
        ),
        ("map by String of 1,000, 100 times", "map_string", 100, 100),
        (
            "strings joined and split, 1,000 times",
            "strings",
            1000,
            1000,
        ),
        ("records of 100, 1,000 times", "records", 1000, 100_000),
        ("sort of 1,000, 50 times", "sort", 50, 50_000),
        ("mandelbrot of 100 by 100", "mandelbrot", 100, 2662),
    ];
    for (name, function, argument, expected) in others {
        measure(&program, name, numbered(function), argument, expected);
    }
    measure_compiler("Race", RACE);
}
