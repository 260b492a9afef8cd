//! How fast the machine runs, on the programs that `tools/bench_lua.sh` runs in Lua beside it,
//!
//! and a fleet that runs the small race of the tests.
//!
//! `cargo bench -p starl-lang --bench machine` prints each program's best and median milliseconds.

#![allow(
    clippy::disallowed_methods,
    reason = "a benchmark reads the clock, nothing else does"
)]

#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../tests/it/machine_support/mod.rs"]
mod machine_support;
mod measure;

use measure::{measure, milliseconds};
use starl_lang::machine::{Import, Limits, Machine, Program, State, Workspace, assemble};

const PROGRAM: &str = "
type List[Int]
function loop function (Int) (Int) registers 4 objects 0
    int r1 0
    copy r2 r0
    int r0 0
again:
    remainder_constant r3 r1 7
    add_int r0 r0 r3
    loop r1 r2 @again
    return_scalar r0 #0
function fib function (Int) (Int) registers 3 objects 0
    jump_if_less_constant r0 2 @small
    add_constant r1 r0 -1
    call r1 b0 f1
    add_constant r2 r0 -2
    call r2 b0 f1
    add_int r0 r1 r2
small:
    return_scalar r0 #0
function list function (Int) (Int) registers 6 objects 1
    clear_object b0 type0
    int r1 0
    int r5 1000
fill:
    list_add b0 r1 b0 type0
    loop r1 r5 @fill
    copy r3 r0
    int r4 0
    int r0 0
outer:
    int r1 0
inner:
    list_get b0 r1 r2 b0
    add_int r0 r0 r2
    list_set b0 r1 r2 b0
    loop r1 r5 @inner
    loop r4 r3 @outer
    return_scalar r0 #1
";

/// Activations of many robots that are on their way, one workspace for all of them.
fn measure_fleet(robots: usize) {
    let program = machine_support::program(machine_support::RACE);
    let mut host = machine_support::TestHost::default();
    let mut workspace = Workspace::new();
    let mut states: Vec<State> = (0..robots).map(|_| program.new_state()).collect();
    let mut activate = |states: &mut [State], actions: &[u32]| {
        let start = milliseconds();
        for state in states {
            let limits = Limits::default();
            let mut machine = Machine::new(&program, state, &mut workspace, &mut host, limits);
            for &action in actions {
                machine.action(action).expect("the race has no errors");
            }
        }
        (milliseconds() - start) * 1e6 / robots as f64
    };
    let started = activate(&mut states, &[0, 1]);
    let mut times: Vec<f64> = (0..21).map(|_| activate(&mut states, &[0, 1])).collect();
    times.sort_by(f64::total_cmp);
    let bytes = states.iter().map(State::bytes).max().unwrap_or(0);
    println!(
        "{robots} robots, Race: {:.0} ns each to begin, then best {:.0} and median {:.0} ns an \
         activation; {bytes} bytes of state",
        started,
        times[0],
        times[times.len() / 2]
    );
}

fn main() {
    let bytecode = assemble(PROGRAM).expect("the program is well written");
    let program = Program::load(bytecode, &|_: &Import| None).expect("the program is valid");
    measure(&program, "loop of 2,000,000", 0, 2_000_000, 5_999_995);
    measure(&program, "fib 22", 1, 22, 17_711);
    measure(&program, "fib 30", 1, 30, 832_040);
    measure(&program, "list of 1,000, 1,000 times", 2, 1000, 499_500_000);
    measure_fleet(100_000);
}
