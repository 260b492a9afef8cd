//! `starl bench` runs ordinary runs: the same digest on any number of threads, and every message read.

use crate::support::*;
use serde_json::Value;

fn figures(test: &str, arguments: &[&str]) -> Value {
    let mut all = vec!["bench"];
    all.extend_from_slice(arguments);
    all.push("--json");
    json(&starl(&folder(test), &all))
}

#[test]
fn threads_change_speed_only() {
    for workload in ["swarm", "radio", "geocast"] {
        let digest = |threads| {
            let arguments = [
                workload,
                "--robots",
                "700",
                "--seconds",
                "2",
                "--threads",
                threads,
            ];
            figures("bench_threads", &arguments)["digest"].clone()
        };
        assert_eq!(digest("1"), digest("2"), "{workload}");
    }
}

#[test]
fn the_swarm_is_taken_through_every_tick() {
    let figures = figures(
        "bench_ticks",
        &["swarm", "--robots", "100", "--seconds", "3"],
    );
    assert_eq!(figures["robot_ticks"], 3000);
    assert_eq!(figures["sim_seconds"], 3.0);
    for name in [
        "robot_ticks_per_second",
        "robot_ticks_per_cpu_second",
        "speed_factor",
    ] {
        assert!(
            figures[name].as_f64().is_some_and(|figure| figure > 0.0),
            "{name}"
        );
    }
    assert_eq!(figures["messages_delivered"], 0);
}

#[test]
fn each_radio_hears_some_eight_neighbours() {
    let heard = |arguments: &[&str]| {
        let figures = figures("bench_neighbours", arguments);
        let ticks = figures["robot_ticks"].as_f64().unwrap_or(0.0);
        figures["messages_delivered"].as_f64().unwrap_or(0.0) / ticks
    };
    let all = heard(&["radio", "--robots", "500", "--seconds", "2"]);
    assert!((7.0..=10.0).contains(&all), "{all}");
    let occluded = heard(&["radio", "--robots", "500", "--seconds", "2", "--occluded"]);
    assert!(occluded < all, "bodies hide some: {occluded} of {all}");
}
