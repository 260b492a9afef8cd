//! How many cars pass the intersection in a minute and how long they are held up, by the way in which it is
//! governed. The tables of the example's README.

use crate::intersection_support::{Traffic, drive};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// The variants of the README, with the setting that selects each.
const CONTROLS: [(&str, &str); 4] = [
    ("zones", "parameters.as_one=false"),
    ("whole", "parameters.as_one=true"),
    ("light", "program=light.starl"),
    ("light_and_zones", "parameters.lights=2"),
];

/// One in five datagrams is lost, and the others take 100 ms.
const BAD_NETWORK: [&str; 2] = ["network.loss=0.2", "network.delay=100ms"];

fn traffic(control: &str, rate: u32, draw: u32, network: &[&str]) -> Traffic {
    let setting = CONTROLS.iter().find(|(name, _)| *name == control);
    let sets = [
        setting.expect("a variant").1.to_string(),
        format!("parameters.rate={rate}"),
        format!("parameters.draw={draw}"),
        format!("seed={draw}"),
        "duration=30min".to_string(),
    ];
    let mut sets: Vec<&str> = sets.iter().map(String::as_str).collect();
    sets.extend(network);
    drive("intersection-stream", &sets, "")
}

/// `cargo test --release -p starl-catalog --test it intersection_throughput -- --ignored --nocapture`; `DRAWS` and
/// `RATES` in the environment say how many draws, and at which rates, `CONTROLS` by what it is governed, and
/// `NETWORK=bad` has datagrams delayed and lost.
#[test]
#[ignore = "minutes; prints the tables of the README"]
fn measure() {
    let from = |name: &str, default: &str| std::env::var(name).unwrap_or(default.to_string());
    let draws = from("DRAWS", "5").parse().expect("a number of draws");
    let (rates, controls) = (
        from("RATES", "10 20 30 40"),
        from("CONTROLS", &CONTROLS.map(|(name, _)| name).join(" ")),
    );
    let network: &[&str] = match from("NETWORK", "good").as_str() {
        "bad" => &BAD_NETWORK,
        _ => &[],
    };
    println!(
        "| cars come in a minute | governed by | pass in a minute | mean delay | greatest | through | violated |"
    );
    for rate in rates.split(' ') {
        let rate = rate.parse().expect("a rate");
        for control in controls.split(' ') {
            let runs: Vec<Traffic> = (1..=draws)
                .into_par_iter()
                .map(|draw| traffic(control, rate, draw, network))
                .collect();
            let mean =
                |of: &dyn Fn(&Traffic) -> f64| runs.iter().map(of).sum::<f64>() / runs.len() as f64;
            let greatest = runs.iter().map(|run| run.delays().1).fold(0.0, f64::max);
            let violated: BTreeSet<&String> = runs.iter().flat_map(|run| &run.violated).collect();
            println!(
                "| {rate} | `{control}` | {:.1} | {:.1} s | {greatest:.0} s | {:.1} | {violated:?} |",
                mean(&Traffic::per_minute),
                mean(&|run| run.delays().0),
                mean(&|run| run.through.len() as f64),
            );
            // Cars may wait for longer than they should, and that is reported; they never collide.
            for safety in ["Intersection.traffic_safety", "no_collision"] {
                assert!(!violated.contains(&safety.to_string()), "{rate} {control}");
            }
            for run in runs.iter().filter(|_| network.is_empty()) {
                assert_eq!(run.through.len(), 100, "{rate} {control}");
            }
        }
    }
}
