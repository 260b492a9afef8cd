//! `starl run` runs programs in the StarL language: by themselves, in a scenario that names them, or in another one;
//! and reports their problems before or during the run.

use crate::support::*;

/// Every robot drives along the x axis for as long as its program says.
const DRIVE: &str = "\
/// Drives.
program Drive

import ways

param far: Float = 50cm
param patience: Duration = 20s

motion = ReachAvoid(vicinity = 10cm, stuck_after = patience)
started: Bool

go()
    pre not started
    eff motion.reach_avoid(ways.ahead(position, far), obstacles()); started = true

arrive()
    pre motion.done
    eff motion.stop(); emit(\"arrived\"); finish()

eventually arrived: finished within 20s
invariant near: position.x < 5m
";

const WAYS: &str = "\
library ways

/// A place that is so far ahead along the x axis.
function ahead(from: Point, far: Float) -> Point = from + Point(far, 0.0)
";

const SCENARIO: &str = "\
program = \"drive.starl\"
duration = \"30s\"

[[robots]]
model = \"holonomic\"
count = 2
start = [{ position = [0, 0] }, { position = [0, 1] }]
";

fn lone(test: &str) -> std::path::PathBuf {
    let folder = folder(test);
    file(&folder, "drive.starl", DRIVE);
    file(&folder, "ways.starl", WAYS);
    folder
}

#[track_caller]
fn has(text: &str, expected: &[&str]) {
    for expected in expected {
        assert!(text.contains(expected), "no {expected:?} in:\n{text}");
    }
}

#[test]
fn a_scenario_runs_the_program_that_it_names() {
    let folder = lone("program_named");
    file(&folder, "scenario.toml", SCENARIO);
    let output = starl(&folder, &["run", "scenario.toml"]);
    assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let text = stdout(&output);
    has(&text, &["goal reached", "Drive.arrived", "Drive.near"]);
    assert_eq!(stderr(&output), "");
}

#[test]
fn a_program_takes_the_scenario_beside_it_and_says_so() {
    let folder = lone("program_beside");
    file(
        &folder,
        "drive.toml",
        &SCENARIO.replace("drive.starl", "race"),
    );
    let output = starl(&folder, &["run", "drive.starl"]);
    assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
    assert_eq!(stderr(&output), "scenario: drive.toml\n");
    let report = json(&starl(&folder, &["run", "drive.starl", "--json"]));
    assert_eq!(report["robots"][0]["model"], "holonomic");
    assert_eq!(report["replay"], "starl run drive.starl --seed 1");
    let quiet = starl(&folder, &["run", "drive.starl", "--quiet"]);
    assert_eq!(stderr(&quiet), "");
}

#[test]
fn a_program_without_a_scenario_has_a_floor_to_drive_on() {
    let folder = lone("program_alone");
    let output = starl(&folder, &["run", "drive.starl"]);
    assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
    assert_eq!(stderr(&output), "scenario: the default scenario\n");
    has(
        &stdout(&output),
        &["drive: goal reached", "robot3", "create"],
    );
}

#[test]
fn a_program_runs_in_the_scenario_that_is_named() {
    let folder = lone("program_elsewhere");
    let below = folder.join("below");
    std::fs::create_dir(&below).expect("the folder can be made");
    file(
        &below,
        "other.toml",
        &SCENARIO.replace("drive.starl", "nowhere.starl"),
    );
    for scenario in ["below/other.toml", "race"] {
        let arguments = ["run", "drive.starl", "--scenario", scenario];
        let trace = ["--trace", "drive.mcap"];
        let output = starl(&folder, &[&arguments[..], &trace].concat());
        assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
        has(&stdout(&output), &["Drive.arrived"]);
        // The trace holds the program and its library, wherever they came from.
        let elsewhere = folder.join("elsewhere");
        let _ = std::fs::create_dir(&elsewhere);
        let output = starl(&elsewhere, &["replay", "../drive.mcap"]);
        assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
        has(&stdout(&output), &["identical"]);
    }
}

#[test]
fn the_files_that_a_run_reads_are_not_written_over() {
    let folder = lone("program_kept");
    for name in ["drive.starl", "ways.starl"] {
        let output = starl(&folder, &["run", "drive.starl", "--trace", name]);
        assert_eq!(status(&output), 2);
        has(&stderr(&output), &["the run reads this file"]);
    }
    assert_eq!(
        std::fs::read_to_string(folder.join("ways.starl")).ok(),
        Some(WAYS.into())
    );
}

#[test]
fn parameters_are_set_by_the_command_line() {
    let folder = lone("program_parameters");
    let run = |sets: &[&str]| {
        let sets = sets.iter().flat_map(|set| ["--set", set]);
        let arguments: Vec<&str> = ["run", "drive.starl"].into_iter().chain(sets).collect();
        starl(&folder, &arguments)
    };
    let far = run(&["parameters.far=1.5m", "parameters.patience=1s"]);
    assert_eq!(status(&far), 0, "{}", stderr(&far));
    for (set, expected) in [
        (
            "parameters.fra=1m",
            "the program has no such parameter; did you mean `far`?",
        ),
        ("parameters.far=true", "true does not fit; give a number"),
        (
            "parameters.patience=3",
            "3 does not fit; give a time, such as \"250ms\"",
        ),
    ] {
        let output = run(&[set]);
        assert_eq!(status(&output), 2, "{set}");
        let place = format!("error: --set {}: ", &set[..set.find('=').unwrap_or(0)]);
        has(&stderr(&output), &[&place, expected]);
    }
}

#[test]
fn errors_are_shown_with_their_lines_and_warnings_once() {
    let folder = lone("program_errors");
    file(
        &folder,
        "wrong.starl",
        &DRIVE.replace("not started", "not startet"),
    );
    let output = starl(&folder, &["run", "wrong.starl"]);
    assert_eq!(status(&output), 2);
    let expected = [
        "error[E0201]: there is no `startet`",
        "wrong.starl:13:13",
        "did you mean `started`?",
        "error: wrong.starl: 1 error\n",
    ];
    has(&stderr(&output), &expected);
    assert_eq!(stdout(&output), "");

    file(
        &folder,
        "ways.starl",
        &WAYS.replace("Point(far, 0.0)", "far"),
    );
    let output = starl(&folder, &["run", "drive.starl"]);
    assert_eq!(status(&output), 2);
    has(
        &stderr(&output),
        &["ways.starl:4:", "ways.starl: 1 error\n"],
    );

    file(&folder, "ways.starl", WAYS);
    file(
        &folder,
        "idle.starl",
        &DRIVE.replace("started: Bool", "started: Bool\nidle: Int"),
    );
    let output = starl(&folder, &["run", "idle.starl"]);
    assert_eq!(status(&output), 0, "{}", stderr(&output));
    assert_eq!(
        stderr(&output).matches("warning[").count(),
        1,
        "{}",
        stderr(&output)
    );
}

#[test]
fn a_run_time_error_names_robot_line_and_reason() {
    let folder = lone("program_fails");
    let text = DRIVE.replace(
        "eff motion.stop();",
        "eff let x = 1 / (Int(position.y) - 1); motion.stop();",
    );
    file(
        &folder,
        "fails.starl",
        &text.replace("finish()", "finish(); log(\"{}\", x)"),
    );
    file(&folder, "scenario.toml", SCENARIO);
    let output = starl(
        &folder,
        &["run", "fails.starl", "--scenario", "scenario.toml"],
    );
    assert_eq!(status(&output), 1);
    let text = stdout(&output);
    // The robot at y = 1 divides by zero, or by -1 if it is a little below; the others continue.
    has(
        &text,
        &[
            "failed: holonomic",
            "fails.starl:18:",
            "division by zero",
            "to see it again: starl run",
        ],
    );
    let arguments = [
        "run",
        "fails.starl",
        "--scenario",
        "scenario.toml",
        "--json",
    ];
    let report = json(&starl(&folder, &arguments));
    assert_eq!(report["outcome"], "failed");
    assert_eq!(report["progress"]["failed"], 1);
    assert_eq!(report["progress"]["finished"], 1);
}

#[test]
fn a_violated_property_is_reported_with_the_state() {
    let folder = lone("program_violated");
    let output = starl(
        &folder,
        &[
            "run",
            "drive.starl",
            "--set",
            "parameters.far=6m",
            "--set",
            "world.bounds.high=[9, 9]",
        ],
    );
    assert_eq!(status(&output), 1);
    let expected = [
        "violated: Drive.near at ",
        " by robot",
        "drive.starl:21:",
        "is not true; robot ",
    ];
    has(&stdout(&output), &expected);
}

#[test]
fn other_files_are_rejected() {
    let folder = lone("program_refused");
    file(
        &folder,
        "scenario.toml",
        &SCENARIO.replace("drive.starl", "lost.starl"),
    );
    let groups =
        "[[robots]]\nmodel = \"create\"\nprogram = \"race\"\nstart = [{ position = [0, 0] }]\n";
    file(&folder, "groups.toml", groups);
    file(&folder, "latin.starl", "program Latin\n");
    std::fs::write(folder.join("latin.starl"), b"program Latin\n// \xe9\n")
        .expect("it can be written");
    for (arguments, expected) in [
        (
            &["run", "lost.starl"][..],
            "lost.starl: cannot be read: there is no such file",
        ),
        (
            &["run", "./missing.toml"],
            "./missing.toml: cannot be read: there is no such file; check the path",
        ),
        (
            &["run", "scenario.toml"],
            "scenario.toml:1:11: program: \"lost.starl\" cannot be read",
        ),
        (
            &["run", "latin.starl"],
            "latin.starl:2: is not text in UTF-8",
        ),
        (
            &["run", "ways.starl"],
            "\"./ways.starl\" is a library, which no robot can run",
        ),
        (
            &["run", "race", "--scenario", "scenario.toml"],
            "--scenario: race is a scenario itself",
        ),
        (
            &["run", "drive.starl", "--scenario", "no.toml"],
            "no.toml: cannot be read: there is no such file; check the path",
        ),
        (
            &["run", "drive.starl", "--scenario", "groups.toml"],
            "no robot of groups.toml would run this",
        ),
    ] {
        let output = starl(&folder, arguments);
        assert_eq!(status(&output), 2, "{arguments:?}");
        has(&stderr(&output), &[expected]);
    }
}
