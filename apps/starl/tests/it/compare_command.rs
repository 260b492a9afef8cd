//! `starl compare` runs two versions with the same seeds, and reports the differences.

use crate::support::{self, file, folder, json, starl, status, stderr, stdout};

fn compared(test: &str, more: &[&str]) -> (i32, serde_json::Value) {
    let folder = folder(test);
    file(&folder, "small.toml", support::SMALL);
    let arguments = [
        &["compare", "small.toml"],
        more,
        &["--seeds", "6", "--json"],
    ]
    .concat();
    let output = starl(&folder, &arguments);
    (status(&output), json(&output))
}

#[test]
fn a_version_is_identical_to_itself() {
    let (status, report) = compared("compare_same", &["small.toml"]);
    assert_eq!((status, &report["identical"]), (0, &6.into()));
    assert_eq!(report["changed"], serde_json::json!([]));
    for metric in report["metrics"].as_array().expect("metrics") {
        let difference = &metric["difference"];
        let numbers = ["estimate", "low", "high"].map(|end| difference[end].as_f64());
        assert!(
            metric["pairs"] == 0 || numbers == [Some(0.0); 3],
            "{metric}"
        );
    }
}

#[test]
fn differences_are_those_of_pairs_of_runs() {
    let (_, report) = compared("compare_pairs", &["--set-b", "network.loss=50%"]);
    let folder = folder("compare_pairs_runs");
    file(&folder, "small.toml", support::SMALL);
    let sent = |loss: &str, seed: u32| {
        let seed = seed.to_string();
        let run = [
            "run",
            "small.toml",
            "--json",
            "--set",
            loss,
            "--seed",
            &seed,
        ];
        let report = json(&starl(&folder, &run));
        report["messages"]["sent"].as_f64().expect("a number")
    };
    let pairs = (1..=6).map(|seed| {
        (
            sent("network.loss=20%", seed),
            sent("network.loss=50%", seed),
        )
    });
    let differences: Vec<f64> = pairs.map(|(a, b)| b - a).collect();
    let mean = differences.iter().sum::<f64>() / 6.0;
    let metrics = report["metrics"].as_array().expect("metrics");
    let found = metrics
        .iter()
        .find(|metric| metric["metric"] == "messages_sent");
    let found = &found.expect("messages")["difference"];
    assert!((found["estimate"].as_f64().expect("a number") - mean).abs() < 1e-9);
    let variance = differences
        .iter()
        .map(|d| (d - mean) * (d - mean))
        .sum::<f64>()
        / 5.0;
    // The 97.5 % quantile of Student's distribution for 5 degrees of freedom.
    let half = 2.570_582 * (variance / 6.0).sqrt();
    assert!((found["high"].as_f64().expect("a number") - (mean + half)).abs() < 1e-6);
}

#[test]
fn seeds_that_became_worse_are_named_and_decide_the_status() {
    let worse = ["--set-b", "duration=1s"];
    let (status, report) = compared("compare_worse", &worse);
    assert_eq!((status, &report["worse"]), (1, &6.into()));
    let changed = report["changed"].as_array().expect("a list");
    assert_eq!(changed.len(), 6);
    assert_eq!(
        (&changed[0]["a"], &changed[0]["b"]),
        (&"reached".into(), &"timed_out".into())
    );
    assert_eq!(report["goal"]["difference"]["estimate"], -1.0);
    let (status, report) = compared("compare_better", &["--set-a", "duration=1s"]);
    assert_eq!((status, &report["worse"]), (0, &0.into()));
    assert_eq!(report["changed"].as_array().map(Vec::len), Some(6));
}

#[test]
fn two_programs_are_compared_in_one_scenario() {
    let folder = folder("compare_programs");
    let program = |name: &str, wait: &str| {
        format!("program {name}\n\nwait()\n    pre true for {wait}\n    eff finish()\n")
    };
    file(&folder, "old.starl", &program("Waiter", "1s"));
    file(&folder, "new.starl", &program("Waiter", "3s"));
    file(&folder, "small.toml", support::SMALL);
    let arguments = [
        "compare",
        "old.starl",
        "new.starl",
        "--scenario",
        "small.toml",
        "--seeds",
        "2",
    ];
    let output = starl(&folder, &arguments);
    assert_eq!(status(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    let line = text
        .lines()
        .find(|line| line.starts_with("time_to_goal_seconds"));
    let words: Vec<&str> = line.expect("a line").split_whitespace().collect();
    assert_eq!(words[3], "+2.00", "{text}");
    assert!(text.contains("0 seeds changed the outcome"), "{text}");
}

#[test]
fn a_comparison_needs_two_versions() {
    let folder = folder("compare_one");
    file(&folder, "small.toml", support::SMALL);
    let output = starl(&folder, &["compare", "small.toml"]);
    assert_eq!(status(&output), 2);
    let output = starl(
        &folder,
        &["compare", "small.toml", "--set-b", "network.loss=2"],
    );
    assert_eq!(status(&output), 2);
    let text = stderr(&output);
    assert!(
        text.starts_with("error: --set-b network.loss: 2 is not a probability"),
        "{text}"
    );
}
