//! `starl explore`: all behaviours of a small fleet, the way to a violation, and how it ends.

use crate::support::{file, folder, json, names, starl, status, stderr, stdout};
use std::path::Path;
use std::process::Output;

/// Mutual exclusion by permission, without the order that breaks ties.
const POLITE: &str = r"program Polite

radio = Broadcast()

message Ask(time: Int)
message Permit(to: RobotId)

phase: enum {rest, wait, use, done} = rest
clock: Int = 0
asked: Int = 0
permits: Int = 0
owed: Set[RobotId]

leave()
    pre phase == use
    eff
        phase = done
        for robot in owed
            radio.broadcast(Permit(robot))
        finish()

enter()
    pre phase == wait and permits + 1 == peers.size()
    eff phase = use

ask()
    pre phase == rest
    eff
        clock += 1
        asked = clock
        phase = wait
        radio.broadcast(Ask(asked))

on Ask(from, time)
    clock = max(clock, time)
    if from != me
        if phase == use or (phase == wait and asked < time)
            owed.add(from)
        else
            radio.broadcast(Permit(from))

on Permit(_, to)
    if to == me then permits += 1

invariant exclusion: forall r, s: r == s or r.phase != use or s.phase != use
";

/// A search that is to come to its end is given all the time that it may need, on however slow a machine.
fn explore(folder: &Path, arguments: &[&str]) -> Output {
    let patient = [&["explore", "--within", "1000h"], arguments].concat();
    starl(folder, &patient)
}

fn polite(folder: &Path) -> String {
    file(folder, "polite.starl", POLITE);
    let two = "program = \"polite.starl\"\n[[robots]]\nmodel = \"create\"\ncount = 2\n\
               start = [{ position = [0, 0] }, { position = [0, 1] }]\n";
    file(folder, "polite.toml", two);
    "polite.toml".to_string()
}

#[test]
fn an_example_is_explored_to_the_end() {
    let folder = folder("explore_example");
    let arguments = [
        "mutex",
        "--robots",
        "2",
        "--set",
        "parameters.entries=1",
        "--set",
        "parameters.longest_use=0s",
        "--timers",
        "1",
        "--loss",
        "1",
        "--doubt",
        "--json",
    ];
    let output = explore(&folder, &arguments);
    let account = json(&output);
    assert_eq!(status(&output), 0, "{account}");
    assert_eq!(account["outcome"], "complete");
    assert_eq!(account["robots"], 2);
    assert_eq!(account["violation"], serde_json::Value::Null);
    assert!(account["compared_turns"].as_u64() > Some(0));
    assert!(account["states"].as_u64() > Some(500));
    assert!(account["transitions"].as_u64() > account["states"].as_u64());
    assert!(names(&folder).is_empty(), "no violation, no file");
}

#[test]
fn a_violation_is_saved_and_can_be_replayed() {
    let folder = folder("explore_violation");
    let target = polite(&folder);
    let output = explore(&folder, &[&target]);
    let text = stdout(&output);
    assert_eq!(status(&output), 1, "{text}");
    assert!(text.contains("Polite.exclusion"), "{text}");
    assert!(text.contains("  1. robot 0 is activated"), "{text}");
    let kept = "polite-counterexample.json";
    assert!(text.contains(kept), "{text}");
    let drawn = starl(
        &folder,
        &["explore", "--replay", kept, "--diagram", "way.svg"],
    );
    assert_eq!(status(&drawn), 1, "{}", stderr(&drawn));
    let drawing = std::fs::read_to_string(folder.join("way.svg")).expect("it was drawn");
    assert!(drawing.contains("Polite.exclusion"), "{drawing}");
    // No other file is needed.
    std::fs::remove_file(folder.join("polite.starl")).expect("it is there");
    let again = starl(&folder, &["explore", "--replay", kept]);
    assert_eq!(status(&again), 1, "{}", stderr(&again));
    let again = stdout(&again);
    assert!(
        again.contains("violated again: Polite.exclusion"),
        "{again}"
    );
    let way = |text: &str| -> Vec<String> {
        let lines = text.lines().skip_while(|line| *line != "start");
        let lines = lines.take_while(|line| !line.is_empty());
        lines.map(str::to_string).collect()
    };
    assert_eq!(way(&text), way(&again));
}

#[test]
fn a_reached_bound_is_not_a_proof() {
    let folder = folder("explore_bounds");
    let target = polite(&folder);
    for (option, outcome) in [("--depth", "depth_bound"), ("--most-states", "state_bound")] {
        let output = explore(&folder, &[&target, option, "3"]);
        assert_eq!(status(&output), 3);
        assert!(
            stdout(&output).contains("NOT complete"),
            "{}",
            stdout(&output)
        );
        let output = explore(&folder, &[&target, option, "3", "--json"]);
        assert_eq!(json(&output)["outcome"], outcome);
    }
}

#[test]
fn an_exploration_that_takes_too_long_reports_its_coverage() {
    let folder = folder("explore_within");
    let target = polite(&folder);
    let arguments = ["explore", &target, "--within", "1ns"];
    let output = starl(&folder, &arguments);
    assert_eq!(status(&output), 3);
    let text = stdout(&output);
    assert!(
        text.contains("NOT complete: stopped after --within 1ns"),
        "{text}"
    );
    assert!(
        text.contains("nothing is violated within 0 steps"),
        "{text}"
    );
    let output = starl(&folder, &[&arguments[..], &["--json"]].concat());
    assert_eq!(json(&output)["outcome"], "time_bound");
    assert_eq!(json(&output)["within"], "1ns");
}

#[test]
fn requests_that_are_never_granted_are_noted() {
    let folder = folder("explore_notes");
    let output = explore(&folder, &["election"]);
    assert_eq!(status(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    assert!(text.contains("no robot is ever elected"), "{text}");
    assert!(text.contains("--tick"), "{text}");
    let ballots = [
        "election",
        "--robots",
        "2",
        "--set",
        "parameters.algorithm=ballots",
        "--depth",
        "9",
    ];
    let output = explore(&folder, &ballots);
    let text = stdout(&output);
    assert!(!text.contains("no robot is ever elected"), "{text}");
}

#[test]
fn robots_find_again_what_they_stored() {
    let folder = folder("explore_storage");
    let program = "program Starts\n\nstable starts: Int = 0\nbegun: Bool = false\n\nbegin()\n    pre not begun\n    eff\n        \
                   begun = true\n        starts += 1\n        finish()\n\ninvariant once: forall r: r.starts <= 1\n";
    file(&folder, "starts.starl", program);
    let outcome = |storage: &str| {
        let set = format!("storage.kept={storage}");
        let arguments = ["starts.starl", "--crashes", "1", "--set", &set, "--json"];
        let account = json(&explore(&folder, &arguments));
        assert_eq!(account["bounds"]["storage"].to_string(), storage);
        account["outcome"].clone()
    };
    assert_eq!(outcome("false"), "complete");
    assert_eq!(outcome("true"), "violated");
    let kept = "starts-counterexample.json";
    let replayed = starl(&folder, &["explore", "--replay", kept]);
    assert_eq!(status(&replayed), 1, "{}", stderr(&replayed));
}

#[test]
fn properties_that_are_not_judged_are_noted() {
    let folder = folder("explore_unjudged");
    let program = "program Counter\n\nn: Int = 0\n\ncount()\n    pre n == 0\n    eff\n        n += 1\n        finish()\n\n\
                   invariant small: forall r: r.n <= 1\neventually done: n == 1 within 5s\n";
    file(&folder, "counter.starl", program);
    let text = stdout(&explore(&folder, &["counter.starl"]));
    assert!(text.contains("not judged: Counter.done\n"), "{text}");
}

#[test]
fn bad_input_is_refused() {
    let folder = folder("explore_bad");
    let target = polite(&folder);
    file(&folder, "torn.json", "{");
    let refused: [(&[&str], &str); 7] = [
        (&[], "name what to explore"),
        (
            &["--replay", "torn.json"],
            "torn.json: is not a counterexample",
        ),
        (&["nothing.toml"], "nothing.toml"),
        (&[&target, "--robots", "3"], "the scenario has 2 robots"),
        (&[&target, "--within", "0s"], "--within: give a time"),
        (
            &[&target, "--tick", "5"],
            "--tick 5: is not a time; write one",
        ),
        (&[&target, "--tick", "1ms", "--time", "1000s"], "--time"),
    ];
    for (arguments, message) in refused {
        let arguments: Vec<&str> = ["explore"]
            .into_iter()
            .chain(arguments.iter().copied())
            .collect();
        let output = starl(&folder, &arguments);
        assert_eq!(status(&output), 2, "{arguments:?}");
        assert!(stderr(&output).contains(message), "{}", stderr(&output));
    }
}

#[test]
fn an_impossible_path_is_reported() {
    let folder = folder("explore_stale");
    let target = polite(&folder);
    let output = explore(&folder, &[&target, "--save", "way.json", "--quiet"]);
    assert_eq!(status(&output), 1);
    let text = std::fs::read_to_string(folder.join("way.json")).expect("it is there");
    // The program has been fixed.
    let fixed = text.replace("asked < time", "asked <= time");
    assert_ne!(text, fixed);
    file(&folder, "way.json", &fixed);
    let output = starl(&folder, &["explore", "--replay", "way.json"]);
    assert_eq!(status(&output), 2, "{}", stdout(&output));
    assert!(stderr(&output).contains("cannot be taken any more"));
}
