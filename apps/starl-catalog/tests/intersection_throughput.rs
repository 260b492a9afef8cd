//! How many cars pass the intersection in a minute and how long they are held up, by the way in which it is
//! governed. The table of the example's README.

mod intersection_support;

use intersection_support::{Traffic, drive};
use rayon::prelude::*;

const CONTROLS: [&str; 4] = ["zones", "whole", "light_and_zones", "light"];

fn traffic(control: &str, rate: u32, draw: u32) -> Traffic {
    let sets = [
        format!("parameters.control={control}"),
        format!("parameters.rate={rate}"),
        format!("parameters.draw={draw}"),
        format!("seed={draw}"),
        "duration=30min".to_string(),
    ];
    let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
    let traffic = drive("intersection-stream", &sets, "");
    assert!(
        traffic.violations.is_empty(),
        "{sets:?} {:?}",
        traffic.violations
    );
    assert_eq!(traffic.through.len(), 100, "{sets:?}");
    traffic
}

/// `cargo test --release -p starl-catalog --test intersection_throughput -- --ignored --nocapture`; `DRAWS` and
/// `RATES` in the environment say how many draws, and at which rates.
#[test]
#[ignore = "minutes; prints the table of the README"]
fn measure() {
    let draws = std::env::var("DRAWS").map_or(2, |draws| draws.parse().unwrap());
    let rates = std::env::var("RATES").unwrap_or("10 15 20 30".into());
    let rates: Vec<u32> = rates.split(' ').map(|rate| rate.parse().unwrap()).collect();
    println!("| cars come in a minute | governed by | pass in a minute | mean delay | greatest |");
    for rate in rates {
        for control in CONTROLS {
            let runs: Vec<Traffic> = (1..=draws)
                .into_par_iter()
                .map(|draw| traffic(control, rate, draw))
                .collect();
            let mean =
                |of: &dyn Fn(&Traffic) -> f64| runs.iter().map(of).sum::<f64>() / runs.len() as f64;
            let greatest = runs.iter().map(|run| run.delays().1).fold(0.0, f64::max);
            println!(
                "| {rate} | {control} | {:.1} | {:.1} s | {greatest:.0} s |",
                mean(&Traffic::per_minute),
                mean(&|run| run.delays().0),
            );
        }
    }
}
