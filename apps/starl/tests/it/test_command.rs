//! `starl test` finds what goes wrong, saves it as a scenario that goes wrong in the same way, and draws it.

use crate::support::{self, file, folder, json, names, starl, status, stderr, stdout};
use std::fs;

/// A robot that promises not to hear much, and speaks ten times itself.
const HASTY: &str = "program Hasty

message Word(count: Int)

radio = Broadcast()

heard: Int = 0
spoken: Int = 0

invariant shy: heard < 5

speak()
    pre spoken < 10
    eff radio.broadcast(Word(spoken)); spoken += 1

rest()
    pre spoken >= 10
    eff finish()

on Word(_, _)
    heard += 1
";

#[test]
fn an_example_that_is_right_passes() {
    let folder = folder("test_passes");
    let scenario = file(&folder, "small.toml", support::SMALL);
    let name = scenario.display().to_string();
    let arguments = [
        "test",
        &name,
        "--seeds",
        "3",
        "--profile",
        "calm,lossy",
        "--json",
    ];
    let output = starl(&folder, &arguments);
    assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let report = json(&output);
    assert_eq!(report["runs"], 6);
    let rows = report["targets"][0]["profiles"].as_array().expect("rows");
    let profiles: Vec<_> = rows.iter().map(|row| row["profile"].as_str()).collect();
    assert_eq!(profiles, [Some("calm"), Some("lossy")]);
    for row in rows {
        assert_eq!(
            (&row["runs"], &row["reached"]),
            (&3.into(), &3.into()),
            "{row}"
        );
    }
    assert_eq!(report["findings"], serde_json::json!([]));
    assert_eq!(names(&folder), ["small.toml"]);
}

#[test]
fn findings_do_not_depend_on_the_number_of_threads() {
    let folder = folder("test_threads");
    file(&folder, "small.toml", &short(support::SMALL));
    let on = |threads: &str| {
        let arguments = [
            "test",
            "small.toml",
            "--seeds",
            "4",
            "--threads",
            threads,
            "--shrink",
            "0",
        ];
        let output = starl(&folder, &[&arguments[..], &["--json"]].concat());
        let mut report = json(&output);
        for finding in report["findings"].as_array_mut().expect("findings") {
            finding["scenario"] = serde_json::Value::Null;
            finding["diagram"] = serde_json::Value::Null;
        }
        (report["targets"].clone(), report["findings"].clone())
    };
    assert_eq!(on("1"), on("3"));
}

/// So short a run that the goal cannot be reached.
fn short(scenario: &str) -> String {
    scenario.replace("30s", "2s")
}

#[test]
fn a_goal_that_is_not_reached_is_saved_and_can_be_run_again() {
    let folder = folder("test_unreached");
    file(&folder, "small.toml", &short(support::SMALL));
    fs::create_dir(folder.join("found")).expect("it can be made");
    let arguments = [
        "test",
        "small.toml",
        "--seeds",
        "2",
        "--profile",
        "lossy",
        "--out",
        "found",
    ];
    let output = starl(&folder, &arguments);
    assert_eq!(status(&output), 1, "{}", stderr(&output));
    let said = stdout(&output);
    assert!(
        said.contains("the goal was not reached in 2 runs"),
        "{said}"
    );
    let saved = "found/small-unreached-lossy-1.toml";
    assert!(said.contains(&format!("starl run {saved}")), "{said}");
    assert!(said.contains("to 1 robot, 0 faults"), "{said}");
    let again = starl(&folder, &["run", saved, "--json"]);
    assert_eq!(status(&again), 1, "{}", stderr(&again));
    assert_eq!(json(&again)["outcome"], "timed_out");
    // Existing files stay.
    let before = fs::read(folder.join(saved)).expect("it is there");
    starl(&folder, &arguments);
    assert_eq!(fs::read(folder.join(saved)).expect("it is there"), before);
    let files = [
        "small-unreached-lossy-1-2.svg",
        "small-unreached-lossy-1-2.toml",
        "small-unreached-lossy-1.svg",
        "small-unreached-lossy-1.toml",
    ];
    assert_eq!(names(&folder.join("found")), files);
}

#[test]
fn an_invariant_of_a_program_is_found_and_shrunk() {
    let folder = folder("test_invariant");
    file(&folder, "hasty.starl", HASTY);
    let arguments = [
        "test",
        "hasty.starl",
        "--seeds",
        "3",
        "--quiet",
        "--out",
        ".",
    ];
    let output = starl(&folder, &arguments);
    assert_eq!(status(&output), 1, "{}{}", stdout(&output), stderr(&output));
    let saved = "hasty-Hasty.shy-calm-1.toml";
    let text = fs::read_to_string(folder.join(saved)).expect("it was saved");
    assert!(
        text.starts_with("# hasty.starl fails here: Hasty.shy.\n"),
        "{text}"
    );
    assert_eq!(
        text.matches("{ position").count(),
        2,
        "two robots are enough:\n{text}"
    );
    let again = starl(&folder, &["run", saved, "--json"]);
    assert_eq!(status(&again), 1, "{}", stderr(&again));
    let properties = json(&again)["properties"].clone();
    let violated = |property: &serde_json::Value| property["verdict"] == "violated";
    let violated: Vec<_> = properties
        .as_array()
        .expect("a list")
        .iter()
        .filter(|p| violated(p))
        .collect();
    assert_eq!(violated.len(), 1);
    assert_eq!(violated[0]["property"], "Hasty.shy");
    let picture =
        fs::read_to_string(folder.join("hasty-Hasty.shy-calm-1.svg")).expect("it was drawn");
    assert!(picture.contains("Hasty.shy: "), "{picture}");
}

#[test]
fn a_saved_scenario_finds_the_program_of_an_example_from_anywhere() {
    let folder = folder("test_example");
    let arguments = [
        "test",
        "race",
        "--seeds",
        "1",
        "--profile",
        "calm",
        "--duration",
        "3s",
        "--quiet",
    ];
    let output = starl(&folder, &arguments);
    assert_eq!(status(&output), 1, "{}", stderr(&output));
    let text = fs::read_to_string(folder.join("race-unreached-calm-1.toml")).expect("it was saved");
    assert!(
        text.contains("program = \"example:race/race.starl\""),
        "{text}"
    );
    let again = starl(&folder, &["run", "race-unreached-calm-1.toml", "--json"]);
    assert_eq!(json(&again)["outcome"], "timed_out", "{}", stderr(&again));
}

#[test]
fn bad_input_is_reported() {
    let folder = folder("test_bad_input");
    file(&folder, "small.toml", support::SMALL);
    let cases: [(&[&str], &str); 6] = [
        (
            &["test", "nothing"],
            "there is no example or scenario file called this",
        ),
        (
            &["test", "small.toml", "--profile", "clam"],
            "did you mean `calm`?",
        ),
        (
            &["test", "small.toml", "--out", "small.toml"],
            "small.toml: ",
        ),
        (
            &["test", "small.toml", "--seeds", "0"],
            "give a whole number from 1",
        ),
        (
            &["test", "small"],
            "small: there is no example called this; did you mean the file small.toml?",
        ),
        (
            &["explore", "small.toml", "--robots", "create=3"],
            "give a whole number from 1 to 256; their models are those of the scenario",
        ),
    ];
    for (arguments, told) in cases {
        let output = starl(&folder, arguments);
        assert_eq!(status(&output), 2, "{arguments:?}");
        assert!(stderr(&output).contains(told), "{}", stderr(&output));
    }
    assert_eq!(names(&folder), ["small.toml"]);
}
