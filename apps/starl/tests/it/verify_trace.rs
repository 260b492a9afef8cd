//! `starl verify` judges a trace by its records alone, whichever host wrote it and even if it is
//! incomplete.

use crate::support::*;
use starl_core::event::{Fault, MutexEvent};
use starl_core::{Event, Point, Port, Pose, Record, RobotId, Time};
use starl_trace::{Header, Outcome, RobotEntry, ViewOptions, Writer};
use std::fs;
use std::path::Path;

/// The entry of a property.
fn entry<'a>(account: &'a serde_json::Value, property: &str) -> &'a serde_json::Value {
    let entries = account["properties"].as_array().expect("a list");
    let mut found = entries.iter().filter(|entry| entry["property"] == property);
    found
        .next()
        .unwrap_or_else(|| panic!("no {property} in {account}"))
}

fn seconds(seconds: f64) -> Time {
    Time((seconds * 1e9) as u64)
}

fn record(at: f64, robot: u32, event: Event) -> Record {
    Record {
        at: seconds(at),
        robot: Some(RobotId(robot)),
        event,
    }
}

fn mutex(at: f64, robot: u32, event: MutexEvent) -> Record {
    let (port, event) = (Port::named("door"), event.into());
    record(at, robot, Event::Primitive { port, event })
}

fn enter(at: f64, robot: u32) -> Record {
    let enter = MutexEvent::Enter {
        resource: "door".into(),
        fencing: None,
        drift: None,
    };
    mutex(at, robot, enter)
}

fn acquire(at: f64, robot: u32) -> Record {
    let resource = "door".into();
    mutex(at, robot, MutexEvent::Acquire { resource })
}

/// A trace of a host of its own, with two robots and no scenario.
fn foreign(path: &Path, setting: &str, records: &[Record], end: f64) {
    let robot = |id: u32| RobotEntry {
        id: RobotId(id),
        name: format!("rover{id}"),
        model: "rover".into(),
        radius: 0.2,
        height: 0.3,
        flies: false,
    };
    let header = Header {
        starl_version: "of another host".into(),
        setting: setting.into(),
        robots: vec![robot(0), robot(1)],
        ..Header::default()
    };
    let file = fs::File::create(path).expect("the folder can be written to");
    let mut writer = Writer::new(file, &header, &ViewOptions::none()).expect("it can be written");
    for record in records {
        writer.write(record).expect("it can be written");
    }
    let outcome = Outcome {
        outcome: "stopped".into(),
        digest: 0,
        end: seconds(end),
    };
    writer.finish(&outcome).expect("it can be written");
}

#[test]
fn a_run_that_was_well_is_found_so() {
    let folder = folder("verify_well");
    let arguments = ["run", "election", "--quiet", "--trace", "a.mcap"];
    assert_eq!(status(&starl(&folder, &arguments)), 0);
    let output = starl(&folder, &["verify", "a.mcap"]);
    let text = stdout(&output);
    assert_eq!(status(&output), 0, "{text}{}", stderr(&output));
    let account = json(&starl(&folder, &["verify", "a.mcap", "--json"]));
    assert_eq!(account["is_whole"], true);
    assert_eq!(entry(&account, "election.uniqueness")["verdict"], "holds");
    assert_eq!(entry(&account, "no_collision")["verdict"], "holds");
    assert_eq!(entry(&account, "barrier.safety")["reason"], "unused");
    let entries = account["properties"].as_array().expect("a list").iter();
    let live = entries.filter(|entry| entry["reason"] == "live_program");
    assert!(live.count() > 0, "the program has properties: {account}");
    assert!(
        text.contains("not judged: it needs the running program"),
        "{text}"
    );
}

#[test]
fn verdicts_are_those_of_the_run() {
    let folder = folder("verify_same");
    let faults = "[fault_rates]\ncrash = \"0.2/s\"\nrestart_after = \"3s\"\n\
                  partition = \"0.1/s\"\nheal_after = \"4s\"\n";
    file(&folder, "faults.toml", faults);
    for target in ["election", "broadcast", "registration"] {
        let arguments = [
            "run",
            target,
            "--json",
            "--faults",
            "faults.toml",
            "--trace",
            "a.mcap",
        ];
        let run = json(&starl(&folder, &arguments));
        let account = json(&starl(&folder, &["verify", "a.mcap", "--json"]));
        let known = account["properties"].as_array().expect("a list").iter();
        let mut compared = 0;
        for found in known.filter(|entry| entry["reason"].is_null()) {
            let property = found["property"].as_str().expect("a name");
            if property.ends_with("_limit") || property.starts_with("datagram_") {
                // A law, which a run does not report.
                assert_eq!(found["verdict"], "holds", "{target}: {property}");
                continue;
            }
            let live = entry(&run, property);
            assert_eq!(found["verdict"], live["verdict"], "{target}: {property}");
            assert_eq!(found["first"], live["first"], "{target}: {property}");
            compared += 1;
        }
        assert!(compared > 3, "{account}");
    }
}

#[test]
fn pushes_between_steps_break_no_law_and_robots_that_join_are_named() {
    let folder = folder("verify_steered");
    let push = |at: &str, robot: &str, by: &str| {
        format!("[[event]]\nat = \"{at}\"\nkind = \"push\"\nrobot = \"{robot}\"\nby = {by}\n")
    };
    let events = [
        push("2.012s", "robot0", "[0.05, 0.0]"),
        push("3.001s", "robot1", "[0.05, 0.0]"),
        "[[event]]\nat = \"1.505s\"\nkind = \"join\"\nlike = \"robot0\"\nname = \"late\"\nposition = [2, 2]\n".into(),
        push("1.507s", "late", "[-4, -4]"),
    ];
    file(&folder, "events.toml", &events.concat());
    let arguments = [
        "run",
        "crossing",
        "--faults",
        "events.toml",
        "--json",
        "--trace",
        "a.mcap",
    ];
    let run = json(&starl(&folder, &arguments));
    let account = json(&starl(&folder, &["verify", "a.mcap", "--json"]));
    assert_eq!(entry(&account, "speed_limit")["verdict"], "holds");
    assert_eq!(entry(&account, "acceleration_limit")["verdict"], "holds");
    let (live, read) = (entry(&run, "no_collision"), entry(&account, "no_collision"));
    assert_eq!(
        live["first"]["robots"],
        serde_json::json!(["robot2", "late"])
    );
    assert_eq!(read["first"], live["first"]);
}

#[test]
fn a_run_in_which_nothing_arrives_is_judged_by_its_trace() {
    let folder = folder("verify_silence");
    let arguments = [
        "run",
        "intersection",
        "--set",
        "network.loss=1",
        "--duration",
        "10s",
        "--quiet",
        "--trace",
        "a.mcap",
    ];
    starl(&folder, &arguments);
    let account = json(&starl(&folder, &["verify", "a.mcap", "--json"]));
    assert_eq!(
        entry(&account, "failure_detector.accuracy")["verdict"],
        "holds"
    );
}

#[test]
fn a_violation_is_shown_with_its_place_and_makes_the_status_1() {
    let folder = folder("verify_violated");
    let records = [
        acquire(1.0, 0),
        enter(1.5, 0),
        acquire(2.0, 1),
        enter(3.25, 1),
    ];
    foreign(&folder.join("a.mcap"), "", &records, 4.0);
    let output = starl(&folder, &["verify", "a.mcap"]);
    let text = stdout(&output);
    assert_eq!(status(&output), 1, "{text}");
    assert!(
        text.contains("violated: mutex.safety at 3.250 s by rover1, rover0"),
        "{text}"
    );
    let account = json(&starl(&folder, &["verify", "a.mcap", "--json"]));
    let safety = entry(&account, "mutex.safety");
    assert_eq!(safety["verdict"], "violated");
    assert_eq!(safety["first"]["at_seconds"], 3.25);
    // Without poses contacts are unknown.
    assert_eq!(entry(&account, "no_collision")["reason"], "missing_records");
}

#[test]
fn excused_violations_are_counted() {
    let folder = folder("verify_excused");
    let crash = record(3.0, 0, Event::Fault(Fault::Crash));
    let records = [acquire(2.0, 1), crash];
    foreign(&folder.join("a.mcap"), "", &records, 60.0);
    let text = stdout(&starl(&folder, &["verify", "a.mcap"]));
    assert!(
        text.contains("holds; 1 excused: a robot was down"),
        "{text}"
    );
}

#[test]
fn an_incomplete_trace_is_judged_to_its_end() {
    let folder = folder("verify_early");
    let pose = |at| record(at, 0, Event::Moved(Pose::level(Point::ZERO, 0.0)));
    let records = [
        pose(0.0),
        acquire(1.0, 0),
        enter(1.5, 0),
        acquire(2.0, 1),
        pose(2.5),
    ];
    // A writer that was killed: no summary, no footer.
    foreign(&folder.join("whole.mcap"), "", &records, 9.0);
    let whole = fs::read(folder.join("whole.mcap")).expect("it was written");
    fs::write(folder.join("a.mcap"), &whole[..whole.len() - 40]).expect("the folder is ours");
    let output = starl(&folder, &["verify", "a.mcap", "--json"]);
    let account = json(&output);
    assert_eq!(status(&output), 0, "{account}");
    assert_eq!(account["is_whole"], false);
    assert_eq!(entry(&account, "mutex.safety")["verdict"], "holds");
    assert_eq!(entry(&account, "mutex.progress")["reason"], "cut_short");
    let text = stdout(&starl(&folder, &["verify", "a.mcap"]));
    assert!(text.contains("the trace is truncated: "), "{text}");
    assert!(
        text.contains("the trace ends before its bound is over"),
        "{text}"
    );
}

#[test]
fn a_host_can_set_the_bounds_of_its_properties() {
    let folder = folder("verify_setting");
    let records = [acquire(2.0, 1)];
    let setting =
        r#"{ "bodies": [], "properties": { "mutex_alone_bound": 5000000000, "barrier": false } }"#;
    foreign(&folder.join("a.mcap"), setting, &records, 10.0);
    let bodies = r#"[{"radius":0.2,"height":0.3,"workspace":"Ground"},{"radius":0.2,"height":0.3,"workspace":"Ground"}]"#;
    let setting = setting.replace("[]", bodies);
    foreign(&folder.join("b.mcap"), &setting, &records, 10.0);
    let account = json(&starl(&folder, &["verify", "b.mcap", "--json"]));
    let progress = entry(&account, "mutex.non_interference");
    assert_eq!(progress["first"]["at_seconds"], 7.0, "{account}");
    let entries = account["properties"].as_array().expect("a list").iter();
    assert!(
        entries
            .clone()
            .all(|entry| entry["property"] != "barrier.safety")
    );
}

/// A robot whose records end early may hold what another waits for, and may release it unseen.
#[test]
fn a_fleet_is_judged_only_as_far_as_all_its_robots_are_recorded() {
    let folder = folder("verify_unrecorded");
    let bodies = r#"[{"radius":0.2,"height":0.3,"workspace":"Ground"},{"radius":0.2,"height":0.3,"workspace":"Ground"}]"#;
    let setting = |unrecorded: &str| {
        format!(
            r#"{{ "bodies": {bodies}, "properties": {{ "mutex_alone_bound": 5000000000 }}, "unrecorded": [{unrecorded}] }}"#
        )
    };
    let verdict = |name: &str, unrecorded: &str, records: &[Record], property: &str| {
        foreign(&folder.join(name), &setting(unrecorded), records, 20.0);
        let account = json(&starl(&folder, &["verify", name, "--json"]));
        entry(&account, property)["verdict"].clone()
    };
    let lost = "[1, 4000000000]";
    // Robot 0 waits from 2 s on; the bound passes at 7 s.
    let waits = [acquire(2.0, 0)];
    let interference = "mutex.non_interference";
    assert_eq!(verdict("a.mcap", "", &waits, interference), "violated");
    assert_ne!(verdict("b.mcap", lost, &waits, interference), "violated");
    // Both hold the door: before the records end it is a violation, after that nothing is known.
    let both = |at: f64| [enter(1.0, 1), enter(at, 0)];
    assert_eq!(
        verdict("c.mcap", lost, &both(3.0), "mutex.safety"),
        "violated"
    );
    assert_ne!(
        verdict("d.mcap", lost, &both(5.0), "mutex.safety"),
        "violated"
    );
    assert_eq!(
        verdict("e.mcap", "", &both(5.0), "mutex.safety"),
        "violated"
    );
}

#[test]
fn bad_input_is_one_message_and_the_status_2() {
    let folder = folder("verify_bad");
    file(&folder, "no.mcap", "this is no trace");
    foreign(&folder.join("a.mcap"), "{ \"step\": 0 }", &[], 1.0);
    foreign(&folder.join("b.mcap"), "{ \"step\": \"soon\" }", &[], 1.0);
    for (trace, says) in [
        ("no.mcap", "no.mcap"),
        ("missing.mcap", "cannot be read"),
        ("a.mcap", "`step` must be greater than 0"),
        ("b.mcap", "setting.json"),
    ] {
        let output = starl(&folder, &["verify", trace]);
        assert_eq!(status(&output), 2, "{trace}");
        assert_eq!(stdout(&output), "", "{trace}");
        let message = stderr(&output);
        assert!(
            message.starts_with("error: ") && message.contains(says),
            "{message}"
        );
        assert_eq!(message.matches("error: ").count(), 1, "{message}");
    }
}
