//! Two-phase commit (Gray and Lamport 2006, Consensus on Transaction Commit), searched by this crate and by
//! stateright, whose example `2pc` its model is. Both find the same number of states.
//!
//! `-- ours N THREADS` and `-- stateright N THREADS` search with N resource managers, 8 unless another number is given,
//! on one thread unless another number is given (`--features parallel` for ours). For the memory, run the binary under
//! `/usr/bin/time -v`.

#![allow(
    clippy::disallowed_methods,
    reason = "a benchmark is a host: it reads the clock"
)]

mod commit;
mod theirs;

use std::time::Instant;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut numbers = arguments.iter().filter_map(|text| text.parse().ok());
    let managers: usize = numbers.next().unwrap_or(8);
    let threads: usize = numbers.next().unwrap_or(1);
    let is_meant = |name: &str| {
        let names = ["ours", "stateright"].iter();
        arguments.iter().any(|argument| argument == name)
            || !names
                .clone()
                .any(|other| arguments.iter().any(|argument| argument == other))
    };
    let mut counts = Vec::new();
    if is_meant("ours") {
        let begun = Instant::now();
        let report = commit::search(managers, threads);
        tell("starl-explore", report.states as usize, begun);
        let bytes = report.bytes as f64 / f64::from(report.states);
        println!("    {bytes:.1} bytes a state in all tables");
        counts.push(report.states as usize);
    }
    if is_meant("stateright") {
        let begun = Instant::now();
        let states = theirs::search(managers, threads);
        tell("stateright", states, begun);
        counts.push(states);
    }
    assert!(counts.windows(2).all(|pair| pair[0] == pair[1]));
}

fn tell(name: &str, states: usize, begun: Instant) {
    let seconds = begun.elapsed().as_secs_f64();
    let speed = states as f64 / seconds;
    println!("{name}: {states} states in {seconds:.2} s, {speed:.0} a second");
}
