//! Ctrl-C, or a request to terminate, ends a run like a timeout: with a summary and a complete trace; and a search with
//! its findings so far.

#![cfg(unix)]

use crate::support::*;
use std::process::{Child, Command, Stdio};

#[test]
fn an_interrupted_run_can_be_replayed() {
    interrupt("interrupted", "-INT");
}

#[test]
fn so_can_one_that_was_asked_to_end() {
    interrupt("terminated", "-TERM");
}

fn interrupt(test: &str, signal: &str) {
    let folder = folder(test);
    // It would take days.
    let endless = SMALL.replacen("\"30s\"", "\"1000000s\"\ngoal = \"duration\"", 1);
    file(&folder, "endless.toml", &endless);
    let mut run = command(
        &folder,
        &["run", "endless.toml", "--json", "--trace", "a.mcap"],
    )
    .stdout(Stdio::piped())
    .stderr(Stdio::piped())
    .spawn()
    .expect("the command was built");
    // It is under way once the trace has grown beyond its header.
    let trace = folder.join("a.mcap");
    let has_grown = || trace.metadata().is_ok_and(|file| file.len() > 2_000_000);
    while !has_grown() {
        assert!(
            run.try_wait().expect("it can be asked").is_none(),
            "the run ended by itself"
        );
        std::thread::yield_now();
    }
    send(signal, &run);
    let output = run.wait_with_output().expect("it ends");
    assert_eq!(status(&output), 1, "{}", stderr(&output));
    assert_eq!(json(&output)["outcome"], "interrupted");
    assert_eq!(names(&folder), ["a.mcap", "endless.toml"]);
    let replayed = starl(&folder, &["replay", "a.mcap"]);
    assert_eq!(
        status(&replayed),
        0,
        "{}{}",
        stdout(&replayed),
        stderr(&replayed)
    );
}

/// Every run of the search goes wrong: the goal is not reached.
#[test]
fn an_interrupted_search_reports_its_findings() {
    let folder = folder("interrupted_search");
    file(&folder, "short.toml", &SMALL.replacen("30s", "1s", 1));
    let mut search = command(
        &folder,
        &[
            "test",
            "short.toml",
            "--profile",
            "calm",
            "--seeds",
            "1000000000",
            "--out",
            "found",
            "--json",
        ],
    )
    .stdout(Stdio::piped())
    .stderr(Stdio::piped())
    .spawn()
    .expect("the command was built");
    // It is about to begin when it has made its folder.
    while !folder.join("found").is_dir() {
        assert!(
            search.try_wait().expect("it can be asked").is_none(),
            "the search ended by itself"
        );
        std::thread::yield_now();
    }
    send("-INT", &search);
    let output = search.wait_with_output().expect("it ends");
    assert_eq!(status(&output), 1, "{}", stderr(&output));
    let report = json(&output);
    assert_eq!(report["interrupted"], true);
    let findings = report["findings"].as_array().expect("a list");
    let times: u64 = findings.iter().filter_map(|f| f["times"].as_u64()).sum();
    assert_eq!(report["targets"][0]["profiles"][0]["wrong"], times);
    assert_eq!(report["runs"], times);
}

fn send(signal: &str, process: &Child) {
    let sent = Command::new("kill")
        .args([signal, &process.id().to_string()])
        .status();
    assert!(sent.is_ok_and(|status| status.success()));
}
