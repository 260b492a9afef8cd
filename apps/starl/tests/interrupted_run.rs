//! Ctrl-C, or a request to end, ends a run as if its time were up: with a summary, and with a trace
//! that is whole.

#![cfg(unix)]

mod support;
use std::process::{Command, Stdio};
use support::*;

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
    let grown = |name: &String| {
        name.starts_with("a.mcap.partial")
            && folder
                .join(name)
                .metadata()
                .is_ok_and(|file| file.len() > 2_000_000)
    };
    while !names(&folder).iter().any(grown) {
        assert!(
            run.try_wait().expect("it can be asked").is_none(),
            "the run ended by itself"
        );
        std::thread::yield_now();
    }
    let interrupted = Command::new("kill")
        .args([signal, &run.id().to_string()])
        .status();
    assert!(interrupted.is_ok_and(|status| status.success()));
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
