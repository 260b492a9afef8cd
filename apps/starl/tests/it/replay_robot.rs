//! `starl replay --robot` runs one robot's software again from a trace, with no simulator.

use crate::support::{file, folder, starl, status, stderr, stdout};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

const FAULTS: &str = r#"
[[fault]]
at = "2s"
kind = "crash"
robots = ["iRobot1"]

[[fault]]
at = "3s"
kind = "restart"
robots = ["iRobot1"]

[[fault]]
at = "4s"
kind = "corrupt_state"
robots = "all"
"#;

const ROBOTS: [&str; 4] = ["iRobot0", "iRobot1", "quadcopter0", "quadcopter1"];

/// A run of Race with faults, in `a.mcap`; nothing else is left of it.
fn recorded(name: &str, arguments: &[&str]) -> PathBuf {
    let folder = folder(name);
    file(&folder, "faults.toml", FAULTS);
    let run = [
        "run",
        "race",
        "--faults",
        "faults.toml",
        "--quiet",
        "--trace",
        "a.mcap",
    ];
    let output = starl(&folder, &[&run[..], arguments].concat());
    assert_eq!(stderr(&output), "");
    fs::remove_file(folder.join("faults.toml")).expect("it was written before");
    folder
}

fn replay(folder: &Path, arguments: &[&str]) -> Output {
    starl(
        folder,
        &[&["replay", "a.mcap", "--robot"], arguments].concat(),
    )
}

/// The program of Race as the example has it.
fn race() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/race/race.starl");
    fs::read_to_string(path).expect("the example is there")
}

#[test]
fn every_robot_replays_identically() {
    let folder = recorded("robot_identical", &["--inputs"]);
    for robot in ROBOTS {
        let output = replay(&folder, &[robot]);
        let text = stdout(&output);
        assert_eq!(
            (status(&output), stderr(&output)),
            (0, String::new()),
            "{text}"
        );
        assert!(
            text.starts_with(&format!("a.mcap: robot {robot}: identical: ")),
            "{text}"
        );
        let lives = if robot == "iRobot1" {
            "2 lives"
        } else {
            "1 life"
        };
        assert!(text.trim_end().ends_with(lives), "{text}");
    }
    let whole = starl(&folder, &["replay", "a.mcap"]);
    assert_eq!(status(&whole), 0, "{}{}", stdout(&whole), stderr(&whole));
}

#[test]
fn recording_inputs_changes_nothing_else() {
    let with = recorded("robot_with", &["--inputs"]);
    let without = recorded("robot_without", &[]);
    let told = [&with, &without].map(|folder| stdout(&starl(folder, &["replay", "a.mcap"])));
    assert_eq!(told[0], told[1]);
    assert!(told[0].contains("identical: "), "{}", told[0]);
    let again = recorded("robot_with_again", &["--inputs", "--threads", "2"]);
    let [one, two] =
        [&with, &again].map(|folder| fs::read(folder.join("a.mcap")).expect("it was written"));
    assert!(one == two, "the traces of equal runs differ");
}

#[test]
fn a_trace_without_inputs_says_how_to_record_them() {
    let folder = recorded("robot_no_inputs", &[]);
    let output = replay(&folder, &["iRobot0"]);
    assert_eq!((status(&output), stdout(&output)), (2, String::new()));
    assert!(
        stderr(&output).contains("starl run --trace FILE --inputs"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn an_unknown_robot_is_reported_with_the_known_ones() {
    let folder = recorded("robot_unknown", &["--inputs"]);
    let output = replay(&folder, &["iRobot7"]);
    assert_eq!((status(&output), stdout(&output)), (2, String::new()));
    let text = stderr(&output);
    for robot in ROBOTS {
        assert!(text.contains(robot), "{text}");
    }
}

#[test]
fn an_incomplete_trace_is_replayed_to_its_end() {
    let folder = recorded("robot_cut", &["--inputs"]);
    let mut whole = fs::read(folder.join("a.mcap")).expect("it was written");
    whole.truncate(whole.len() - 1_000);
    fs::write(folder.join("a.mcap"), whole).expect("it can be written");
    let output = replay(&folder, &["iRobot0"]);
    let text = stdout(&output);
    assert_eq!((status(&output), stderr(&output)), (0, String::new()));
    assert!(
        text.contains("identical as far as the trace goes: "),
        "{text}"
    );
    assert!(text.contains("truncated"), "{text}");
}

#[test]
fn a_changed_program_shows_where_it_begins_to_differ() {
    let folder = recorded("robot_changed", &["--inputs"]);
    file(
        &folder,
        "same.starl",
        &(race() + "\n/// Says nothing new.\n"),
    );
    let output = replay(&folder, &["iRobot0", "--program", "same.starl"]);
    assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
    assert!(stdout(&output).contains("robot iRobot0 with same.starl: identical: "));
    let changed = race().replace(
        "eff radio.broadcast(Reached(currentIndex))",
        "eff emit(\"here\", index = currentIndex); radio.broadcast(Reached(currentIndex))",
    );
    assert_ne!(changed, race());
    file(&folder, "changed.starl", &changed);
    let outputs = ROBOTS.map(|robot| replay(&folder, &[robot, "--program", "changed.starl"]));
    // The first robot to arrive anywhere announced it.
    let different: Vec<&Output> = outputs
        .iter()
        .filter(|output| status(output) == 1)
        .collect();
    assert!(!different.is_empty());
    for output in different {
        let text = stdout(output);
        for expected in [
            "different: first at ",
            "input:     ",
            "recorded:  ",
            "run again: ",
            "here",
        ] {
            assert!(text.contains(expected), "no {expected:?} in {text}");
        }
    }
}

#[test]
fn a_changed_program_with_errors_is_refused() {
    let folder = recorded("robot_broken", &["--inputs"]);
    file(
        &folder,
        "broken.starl",
        &race().replace("program Race", "program"),
    );
    let output = replay(&folder, &["iRobot0", "--program", "broken.starl"]);
    assert_eq!((status(&output), stdout(&output)), (2, String::new()));
    assert!(
        stderr(&output).contains("broken.starl"),
        "{}",
        stderr(&output)
    );
    // The scenario gives it no parameter of this name.
    file(
        &folder,
        "more.starl",
        &race().replace("param vicinity", "param needed: Int\nparam vicinity"),
    );
    let output = replay(&folder, &["iRobot0", "--program", "more.starl"]);
    assert_eq!(status(&output), 2, "{}", stdout(&output));
    assert!(stderr(&output).contains("needed"), "{}", stderr(&output));
}

/// A robot that joins is recorded too, and replayed under its name.
#[test]
fn a_robot_that_joins_replays_identically() {
    const JOIN: &str = r#"
[[event]]
at = "2s"
kind = "join"
like = "iRobot0"
name = "late"
position = [-1, 1]

[[event]]
at = "4s"
kind = "join"
like = "late"
name = "later"
position = [-1, 2]
"#;
    let folder = folder("robot_that_joins");
    file(&folder, "join.toml", JOIN);
    let run = "run race --faults join.toml --quiet --inputs --trace a.mcap --duration 10s";
    let arguments: Vec<&str> = run.split(' ').collect();
    let output = starl(&folder, &arguments);
    assert!(!stderr(&output).contains("panicked"), "{}", stderr(&output));
    for robot in ["iRobot0", "late", "later"] {
        let output = replay(&folder, &[robot]);
        let text = stdout(&output);
        assert_eq!(status(&output), 0, "{text}{}", stderr(&output));
        assert!(
            text.contains(&format!("robot {robot}: identical")),
            "{text}"
        );
    }
    let output = replay(&folder, &["latest"]);
    assert!(
        stderr(&output).contains("late, later"),
        "{}",
        stderr(&output)
    );
}
