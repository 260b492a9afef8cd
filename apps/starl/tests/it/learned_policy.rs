//! A program that evaluates a trained network, through the whole command: it holds in calm, a bad radio breaks it, the
//! failure shrinks to a file, and a trace needs nothing else.

use crate::support::{file, folder, json, starl, status, stderr, stdout};
use std::fs;
use std::path::{Path, PathBuf};

/// The files of the example, in a folder of the test's own.
fn crossing(test: &str) -> PathBuf {
    let folder = folder(test);
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/crossing");
    for name in ["crossing.toml", "crossing.starl", "crossing.onnx"] {
        fs::copy(example.join(name), folder.join(name)).expect("the example is there");
    }
    folder
}

fn digest(folder: &Path, arguments: &[&str]) -> String {
    let output = starl(folder, arguments);
    assert_eq!(stderr(&output), "");
    let summary = stdout(&output);
    let line = summary.lines().find(|line| line.starts_with("digest"));
    line.expect("a digest").to_string()
}

#[test]
fn the_network_is_a_part_of_the_run() {
    let folder = crossing("learned_identity");
    let run = digest(&folder, &["run", "crossing.toml"]);
    assert_eq!(
        run,
        digest(&folder, &["run", "crossing"]),
        "that of the command itself"
    );
    assert_eq!(
        digest(
            &folder,
            &["run", "crossing.toml", "--trace", "a.mcap", "--inputs"]
        ),
        run
    );
    for name in ["crossing.toml", "crossing.starl", "crossing.onnx"] {
        fs::remove_file(folder.join(name)).expect("it is there");
    }
    let output = starl(&folder, &["replay", "a.mcap"]);
    assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
    for robot in ["robot0", "robot5"] {
        let output = starl(&folder, &["replay", "a.mcap", "--robot", robot]);
        assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
    }
}

#[test]
fn the_properties_hold_in_calm_and_are_broken_by_loss_and_delay() {
    let folder = crossing("learned_broken");
    let calm = ["test", "crossing", "--profile", "calm", "--seeds", "10"];
    let output = starl(&folder, &calm);
    assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let lossy = [
        "test",
        "crossing.toml",
        "--profile",
        "lossy",
        "--seeds",
        "8",
        "--shrink",
        "60",
        "--out",
        "found",
        "--json",
    ];
    let report = json(&starl(&folder, &lossy));
    let findings = report["findings"].as_array().expect("findings");
    let apart = findings
        .iter()
        .find(|found| found["property"] == "Crossing.apart");
    assert!(apart.is_some(), "{findings:?}");
    // The file finds program and network, fails in the same way, and so does its trace alone.
    let saved = fs::read_dir(folder.join("found")).expect("a folder");
    let mut saved = saved.map(|entry| entry.expect("a file").path());
    let saved = saved.find(|path| path.extension().is_some_and(|kind| kind == "toml"));
    let saved = saved.expect("a scenario").display().to_string();
    let output = starl(&folder, &["run", &saved, "--trace", "b.mcap"]);
    assert_eq!(status(&output), 1, "{}", stderr(&output));
    assert!(
        stdout(&output).contains("violated: Crossing.apart"),
        "{}",
        stdout(&output)
    );
    fs::remove_file(folder.join("crossing.onnx")).expect("it is there");
    let output = starl(&folder, &["replay", "b.mcap"]);
    assert!(
        stdout(&output).contains("identical"),
        "{}{}",
        stdout(&output),
        stderr(&output)
    );
    let output = starl(&folder, &["run", &saved]);
    assert_eq!(status(&output), 2, "{}", stdout(&output));
}

#[test]
fn problems_of_a_network_are_reported_before_the_run() {
    let folder = crossing("learned_wrong");
    let program = fs::read_to_string(folder.join("crossing.starl")).expect("it is there");
    let cut = fs::read(folder.join("crossing.onnx")).expect("it is there");
    file(
        &folder,
        "short.starl",
        &program.replace(
            "[min(1.0, distance(position, goal))] + closeness(ways, ahead)",
            "[1.0]",
        ),
    );
    file(
        &folder,
        "far.starl",
        &program.replace("crossing.onnx", "nets/crossing.onnx"),
    );
    file(
        &folder,
        "cut.starl",
        &program.replace("crossing.onnx", "cut.onnx"),
    );
    fs::write(folder.join("cut.onnx"), &cut[..cut.len() / 2]).expect("it can be written");
    let cases = [
        ("short.starl", "`crossing.onnx` takes 9 numbers, not 1"),
        (
            "far.starl",
            "the model `nets/crossing.onnx` cannot be read: there is no such file",
        ),
        ("cut.starl", "the model `cut.onnx` cannot be evaluated"),
    ];
    for (program, expected) in cases {
        for command in ["check", "run", "test"] {
            let output = starl(&folder, &[command, program]);
            let expected_status = if command == "check" { 1 } else { 2 };
            assert_eq!(status(&output), expected_status, "{command} {program}");
            let said = stdout(&output) + &stderr(&output);
            assert!(
                said.contains(expected) && said.contains(&format!("{program}:")),
                "{said}"
            );
        }
    }
}
