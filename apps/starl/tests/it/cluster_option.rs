//! `--cluster` with a missing or wrong interpreter or package. Runs on real clusters are tested with the package for
//! Python, in `apps/starl-py/tests/test_cluster_command.py`.

use crate::support::{command, folder, names, starl, status, stderr, stdout};
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;

/// An executable file in place of the interpreter.
fn interpreter(folder: &Path, script: &str) -> String {
    let path = folder.join("python");
    fs::write(&path, format!("#!/bin/sh\n{script}\n")).expect("the folder can be written to");
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).expect("the file is ours");
    path.display().to_string()
}

fn refused(test: &str, script: &str, expected: &[&str]) {
    let folder = folder(test);
    let python = interpreter(&folder, script);
    for arguments in [
        ["test", "race", "--seeds", "1"],
        ["sweep", "race", "--seeds", "1"],
    ] {
        let mut arguments = arguments.to_vec();
        arguments.extend(["--cluster", "ray", "--python", &python]);
        let output = starl(&folder, &arguments);
        let said = stderr(&output);
        assert_eq!(
            (status(&output), stdout(&output).as_str()),
            (2, ""),
            "{said}"
        );
        assert_eq!(said.lines().count(), 1, "{said}");
        for part in expected {
            assert!(said.contains(part), "{part} is not in {said}");
        }
    }
    assert_eq!(names(&folder), ["python"]);
}

#[test]
fn an_interpreter_without_the_package_is_named_with_its_last_words() {
    let script = "echo Traceback >&2; echo 'No module named starl' >&2; exit 1";
    let expected = [
        "--cluster: ",
        "has ended: No module named starl; ",
        "--python or STARL_PYTHON",
    ];
    refused("cluster_without_package", script, &expected);
}

#[test]
fn an_interpreter_that_refuses_gives_its_reason() {
    let script = r#"echo '{"error":"a cluster needs Ray"}'"#;
    refused(
        "cluster_refuses",
        script,
        &["error: --cluster: a cluster needs Ray\n"],
    );
}

#[test]
fn an_interpreter_that_answers_nonsense_is_not_believed() {
    let script = "echo Welcome to Ray; sleep 1";
    let expected = ["answers what this command does not understand: Welcome to Ray"];
    refused("cluster_nonsense", script, &expected);
}

#[test]
fn an_interpreter_that_ends_in_the_middle_is_an_error() {
    let script = r#"echo '{"ready":{"processors":2}}'; read job; echo 'lost the cluster' >&2"#;
    refused("cluster_ends", script, &["has ended: lost the cluster"]);
}

#[test]
fn a_result_of_another_shape_is_an_error() {
    let script =
        r#"echo '{"ready":{"processors":2}}'; read job; echo '{"result":{"number":0}}'; read job"#;
    let expected = ["answers what this command does not understand"];
    refused("cluster_shape", script, &expected);
}

#[test]
fn the_interpreter_learns_the_address_and_the_version_and_gets_the_job() {
    let folder = folder("cluster_job");
    let script = r#"echo "$@" > called; echo '{"ready":{"processors":2}}'; head -n 1 > job"#;
    let python = interpreter(&folder, script);
    let arguments = ["sweep", "race", "--seeds", "3", "--cluster", "ray://host:1"];
    let mut sweep = command(&folder, &arguments);
    // The variable stands in for the option.
    let output = sweep
        .env("STARL_PYTHON", &python)
        .output()
        .expect("it ends");
    assert_eq!(status(&output), 2);
    let called = fs::read_to_string(folder.join("called")).expect("it was called");
    let version = env!("CARGO_PKG_VERSION");
    assert_eq!(
        called,
        format!("-m starl._cluster ray://host:1 {version}\n")
    );
    let job = fs::read_to_string(folder.join("job")).expect("it had a job");
    let job: serde_json::Value = serde_json::from_str(&job).expect("a job is JSON");
    assert_eq!(job["work"], "sweep");
    assert_eq!(job["numbers"], serde_json::json!([0, 1, 2]));
}

#[test]
fn the_options_belong_together() {
    let folder = folder("cluster_options");
    for (arguments, expected) in [
        (
            ["--cluster", "ray", "--threads", "2"],
            "cannot be used with",
        ),
        (["--python", "x", "--seeds", "1"], "--cluster"),
    ] {
        let all = [&["test", "race"][..], &arguments].concat();
        let output = starl(&folder, &all);
        assert_eq!(status(&output), 2);
        assert!(stderr(&output).contains(expected), "{}", stderr(&output));
    }
}
