//! The cost of an entry, an election, an agreed registration and a crossing: messages, time and processor
//! time, for 3 to 100 robots, each against the theory of its algorithm.
//!
//! `cargo bench -p starl-primitives --bench coordination -- [--quick]`
//!
//! Robots have only the primitive, and a network without loss that takes the same time for each
//! datagram. Each task is done with several seeds, with delays of 1 ms and of 2 ms. Time that grows with the
//! delay counts as delays, the rest as waits of the algorithm. Messages count once for each receiver.
//! Processor time is that of all robots together with the test's network: the median over the seeds by the
//! clock, or for tasks of more than 2 ms the mean by the kernel's count.

#![allow(
    clippy::disallowed_methods,
    reason = "a benchmark reads the clock, nothing else does"
)]

#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../../tests/it/harness/mod.rs"]
mod harness;
mod tasks;

use std::time::Instant;
use tasks::Task;

const SIZES: [usize; 7] = [3, 4, 9, 16, 25, 49, 100];

/// The cost of doing a task once.
#[derive(Clone, Copy, Default)]
struct Cost {
    messages: f64,
    datagrams: f64,
    milliseconds: f64,
    /// By the clock, and by what the kernel counts for this thread, which lags by some milliseconds.
    elapsed_us: f64,
    counted_us: f64,
}

/// Tasks that take longer than this are likely to be interrupted, microseconds.
const LONG_US: f64 = 2000.0;

/// Microseconds for which this process's first thread has computed, if anything tells.
fn counted_us() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/schedstat").ok()?;
    let nanoseconds: f64 = text.split(' ').next()?.parse().ok()?;
    Some(nanoseconds * 1e-3)
}

fn measure(task: &Task, robots: usize, seed: u64, delay_ms: u64) -> Cost {
    let mut world = (task.prepare)(robots, seed, delay_ms);
    let before = world.traffic_on(task.port);
    let (counted, started) = (counted_us(), Instant::now());
    let waited = (task.run)(&mut world);
    let elapsed = started.elapsed().as_secs_f64() * 1e6;
    let counted = counted.zip(counted_us());
    let counted = counted.map_or(elapsed, |(before, after)| after - before);
    let after = world.traffic_on(task.port);
    let times = if task.is_of_each { robots } else { 1 } as f64;
    Cost {
        messages: (after.1 - before.1) as f64 / times,
        datagrams: (after.0 - before.0) as f64 / times,
        milliseconds: waited.seconds() * 1e3 / times,
        elapsed_us: elapsed / times,
        counted_us: counted / times,
    }
}

fn mean(costs: &[Cost], of: impl Fn(&Cost) -> f64) -> f64 {
    costs.iter().map(of).sum::<f64>() / costs.len() as f64
}

fn median(costs: &[Cost], of: impl Fn(&Cost) -> f64) -> f64 {
    let mut numbers: Vec<f64> = costs.iter().map(of).collect();
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}

/// Prints a task's lines, and gives the processor time for each number of robots, microseconds.
fn table(task: &Task, seeds: u64) -> Vec<f64> {
    let line = |robots: usize| {
        let with = |delay_ms| -> Vec<Cost> {
            let seeds = 1..=seeds;
            seeds
                .map(|seed| measure(task, robots, seed, delay_ms))
                .collect()
        };
        let (short, long) = (with(1), with(2));
        let time = mean(&short, |cost| cost.milliseconds);
        let delays = mean(&long, |cost| cost.milliseconds) - time;
        let times = if task.is_of_each { robots } else { 1 } as f64;
        let elapsed = median(&short, |cost| cost.elapsed_us);
        let processor = match elapsed * times > LONG_US {
            true => mean(&short, |cost| cost.counted_us),
            false => elapsed,
        };
        let messages = mean(&short, |cost| cost.messages);
        println!(
            "| {} | {robots} | {messages:.1} | {} | {:.1} | {:.1} | {} | {:.0} | {processor:.1} | {:.0} |",
            task.name,
            (task.messages)(robots as f64),
            mean(&short, |cost| cost.datagrams),
            delays,
            task.delays,
            (time - delays).max(0.0),
            processor * 1e3 / messages,
        );
        processor
    };
    SIZES.into_iter().map(line).collect()
}

fn main() {
    let is_quick = std::env::args().any(|argument| argument == "--quick");
    let seeds = if is_quick { 3 } else { 31 };
    println!(
        "| | robots | messages | theory | datagrams | delays | theory | waits, ms | processor, us | ns a message |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |");
    let times: Vec<(Task, Vec<f64>)> = tasks::all()
        .into_iter()
        .map(|task| {
            let times = table(&task, seeds);
            (task, times)
        })
        .collect();
    println!(
        "\n| processor time, us | {} |",
        SIZES.map(|size| size.to_string()).join(" | ")
    );
    println!("| --- |{}", " --- |".repeat(SIZES.len()));
    for (task, times) in times {
        let times: Vec<String> = times.iter().map(|time| format!("{time:.1}")).collect();
        println!("| {} | {} |", task.name, times.join(" | "));
    }
}
