//! Common code of the machine's benchmarks: the time of a function that needs no host.

#![allow(
    clippy::disallowed_methods,
    reason = "a benchmark reads the clock, nothing else does"
)]

use starl_lang::machine::{Fault, Host, HostCall, Limits, Machine, Program, Workspace};
use std::borrow::Cow;
use std::sync::OnceLock;
use std::time::Instant;

struct NoHost;

impl Host for NoHost {
    fn call(&mut self, _: u32, _: &mut HostCall<'_>) -> Result<u64, Cow<'static, str>> {
        Err("there is nothing to call".into())
    }
}

/// Milliseconds of processor time that this thread has used, so that what else runs on the machine
/// does not count; of wall time where that cannot be known.
pub fn milliseconds() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    std::thread::yield_now(); // Linux brings its count up to date
    let used = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let used = used.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    let wall = || START.get_or_init(Instant::now).elapsed().as_secs_f64() * 1e3;
    used.map_or_else(wall, |nanoseconds| nanoseconds * 1e-6)
}

/// Prints the best and the median time of a function; nothing if the command line names other functions.
pub fn measure(program: &Program, name: &str, function: u32, argument: u64, expected: u64) {
    let wanted: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    if !wanted.is_empty() && !wanted.iter().any(|wanted| name.contains(wanted.as_str())) {
        return;
    }
    let mut workspace = Workspace::new();
    let mut state = program.new_state();
    let mut times: Vec<f64> = (0..21)
        .map(|_| {
            let limits = Limits {
                fuel: u64::MAX,
                ..Limits::default()
            };
            let mut host = NoHost;
            let mut machine = Machine::new(program, &mut state, &mut workspace, &mut host, limits);
            let start = milliseconds();
            let result = machine.call(function, &[argument], &[]).map(|(r, _)| r[0]);
            let elapsed = milliseconds() - start;
            assert_eq!(
                result.map_err(|error| error.fault),
                Ok::<u64, Fault>(expected)
            );
            elapsed
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!(
        "{name:28} best {:8.3} ms   median {:8.3} ms",
        times[0],
        times[times.len() / 2]
    );
}
