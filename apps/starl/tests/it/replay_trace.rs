//! `starl replay` proves that a trace is what its inputs bring about, or shows where it is not.

use crate::support::*;
use starl_catalog::programs::Registry;
use starl_core::{Duration, Event, Intervention, Point, Pose, RobotId, Time};
use starl_sim::read::{Inputs, Request, Source};
use starl_trace::{Outcome, Reader, ViewOptions, Writer};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

fn recorded(name: &str, arguments: &[&str]) -> std::path::PathBuf {
    let folder = folder(name);
    file(&folder, "small.toml", SMALL);
    let mut all = vec!["run", "small.toml", "--quiet", "--trace", "a.mcap"];
    all.extend_from_slice(arguments);
    let output = starl(&folder, &all);
    assert_eq!(stderr(&output), "");
    // A replay needs only the trace.
    fs::remove_file(folder.join("small.toml")).expect("it was written before");
    folder
}

#[test]
fn a_fresh_trace_is_identical() {
    let folder = recorded(
        "replay_fresh",
        &["--seed", "9", "--set", "network.loss=0.3"],
    );
    let output = starl(&folder, &["replay", "a.mcap"]);
    assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
    assert!(
        stdout(&output).contains("identical: "),
        "{}",
        stdout(&output)
    );
}

#[test]
fn so_is_that_of_an_example_with_another_fleet_and_faults() {
    let folder = folder("replay_race");
    file(
        &folder,
        "faults.toml",
        "[[fault]]\nat = \"2s\"\nkind = \"crash\"\nrobots = [\"iRobot1\"]\n\
         [[event]]\nat = \"1s\"\nkind = \"network\"\nloss = \"30%\"\n\
         [[event]]\nrate = \"1/s\"\nkind = \"push\"\nrobot = \"iRobot0\"\nby = [0.01, 0]\n",
    );
    let arguments = [
        "run",
        "race",
        "--robots",
        "create=3,drone=1",
        "--faults",
        "faults.toml",
    ];
    let arguments = [
        &arguments[..],
        &["--duration", "5s", "--quiet", "--trace", "a.mcap"],
    ]
    .concat();
    let output = starl(&folder, &arguments);
    assert_eq!(stderr(&output), "");
    fs::remove_file(folder.join("faults.toml")).expect("it was written before");
    let output = starl(&folder, &["replay", "a.mcap", "--threads", "2"]);
    assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
}

/// Rewrites a trace with one pose slightly changed, and returns the time of that record.
fn tamper(from: &Path, to: &Path) -> f64 {
    let mut reader = Reader::new(fs::File::open(from).expect("it is there")).expect("it is whole");
    let file = fs::File::create(to).expect("the folder can be written to");
    let header = reader.header().clone();
    let mut writer = Writer::new(file, &header, &ViewOptions::none()).expect("it can be written");
    let (mut moves, mut changed) = (0, 0.0);
    for record in &mut reader {
        let mut record = record.expect("the trace is whole");
        if let Event::Moved(pose) = &mut record.event {
            moves += 1;
            if moves == 20 {
                pose.position.x += 1e-9;
                changed = record.at.seconds();
            }
        }
        writer.write(&record).expect("it can be written");
    }
    let outcome = reader
        .summary()
        .expect("the trace is whole")
        .outcome
        .clone();
    writer.finish(&outcome).expect("it can be written");
    changed
}

#[test]
fn a_changed_record_is_found() {
    let folder = recorded("replay_tampered", &[]);
    let at = tamper(&folder.join("a.mcap"), &folder.join("b.mcap"));
    let output = starl(&folder, &["replay", "b.mcap"]);
    assert_eq!(status(&output), 1, "{}{}", stdout(&output), stderr(&output));
    let text = stdout(&output);
    for expected in [
        &format!("first at {at:.9} s, robot holonomic"),
        "recorded:  ",
        "run again: ",
        "Moved",
    ] {
        assert!(text.contains(expected), "no {expected:?} in {text}");
    }
}

#[test]
fn a_truncated_trace_is_replayed_to_its_end() {
    let folder = recorded("replay_truncated", &[]);
    let whole = fs::read(folder.join("a.mcap")).expect("it was written");
    let mut records = Vec::new();
    for part in [whole.len() - 1, whole.len() * 2 / 3, whole.len() / 3] {
        fs::write(folder.join("cut.mcap"), &whole[..part]).expect("the folder can be written to");
        let output = starl(&folder, &["replay", "cut.mcap"]);
        let text = stdout(&output);
        assert_eq!((status(&output), stderr(&output)), (0, String::new()));
        let start = "cut.mcap: identical as far as the trace goes: ";
        let told = text
            .strip_prefix(start)
            .unwrap_or_else(|| panic!("{part}: {text}"));
        let count = told.split(' ').next().expect("a number").replace(',', "");
        records.push(count.parse::<u64>().expect("a number"));
        assert!(
            text.contains("the trace is truncated: the file stops at byte"),
            "{text}"
        );
    }
    assert!(
        records.is_sorted_by(|more, fewer| more >= fewer),
        "{records:?}"
    );
    assert!(records[0] > 100, "{records:?}");
}

#[test]
fn a_difference_before_the_cut_is_found() {
    let folder = recorded("replay_cut_tampered", &[]);
    tamper(&folder.join("a.mcap"), &folder.join("b.mcap"));
    let mut bytes = fs::read(folder.join("b.mcap")).expect("it was written");
    bytes.pop();
    fs::write(folder.join("b.mcap"), bytes).expect("it can be written");
    let output = starl(&folder, &["replay", "b.mcap"]);
    assert_eq!(status(&output), 1, "{}{}", stdout(&output), stderr(&output));
    assert!(
        stdout(&output).contains("different: first at"),
        "{}",
        stdout(&output)
    );
}

#[test]
fn a_trace_cut_before_its_records_is_refused() {
    let folder = recorded("replay_headless", &[]);
    let whole = fs::read(folder.join("a.mcap")).expect("it was written");
    for part in [1_000, 100, 8, 3, 0] {
        fs::write(folder.join("cut.mcap"), &whole[..part]).expect("the folder can be written to");
        let output = starl(&folder, &["replay", "cut.mcap"]);
        assert_eq!(
            (status(&output), stdout(&output)),
            (2, String::new()),
            "{part} bytes"
        );
        let text = stderr(&output);
        assert!(
            text.starts_with("error: cut.mcap: "),
            "{part} bytes: {text}"
        );
        assert!(!text.contains("panicked"), "{text}");
    }
}

#[test]
fn a_flipped_bit_anywhere_is_reported_without_a_panic() {
    let folder = recorded("replay_flipped", &["--duration", "2s"]);
    let whole = fs::read(folder.join("a.mcap")).expect("it was written");
    for place in (0..whole.len()).step_by(whole.len() / 40) {
        let mut damaged = whole.clone();
        damaged[place] ^= 0x10;
        fs::write(folder.join("bad.mcap"), &damaged).expect("the folder can be written to");
        let output = starl(&folder, &["replay", "bad.mcap"]);
        let text = stderr(&output) + &stdout(&output);
        assert!(!text.contains("panicked"), "byte {place}: {text}");
        // A bit of a view or of the index beyond the end record may change unnoticed.
        assert!([0, 1, 2].contains(&status(&output)), "byte {place}: {text}");
    }
}

/// Runs `small.toml` with interventions of the test's own, and writes the trace of it.
fn steer(folder: &Path, text: &str) {
    let ordinary = fs::File::open(folder.join("a.mcap")).expect("it was written");
    let header = Reader::new(ordinary).expect("it is whole").header().clone();
    let inputs = Inputs {
        request: Request::new(Source::new("small.toml", text)),
        files: BTreeMap::new(),
    };
    let application = starl_catalog::read(&inputs.request, &inputs, &Registry::default());
    let mut run = application.expect("it is right").run().expect("it starts");
    let file = fs::File::create(folder.join("steered.mcap")).expect("it can be written");
    let mut writer =
        Writer::new(file, &header, &ViewOptions::default()).expect("it can be written");
    let at = |millis: u64| Time::ZERO + Duration::from_millis(millis);
    let push = || Intervention::Push {
        robot: RobotId(0),
        by: Point::planar(-0.2, 0.0),
    };
    // The scenario has the same push at the same time.
    run.apply(at(2000), push()).expect("it is fine");
    let name = "cup".to_string();
    let nothing = Intervention::RemoveThing { name };
    run.apply(at(2500), nothing).expect("it may be there then");
    let join = Intervention::Join {
        like: RobotId(0),
        name: "late".into(),
        pose: Pose::level(Point::planar(-2.0, 0.0), 0.0),
    };
    run.apply(at(1000), join).expect("it is fine");
    while run.simulation().now() < at(5000) {
        for record in run.step() {
            writer.write(record).expect("it can be written");
        }
        if run.simulation().now() == at(3000) {
            let late = Intervention::Leave(vec![RobotId(2)]);
            run.apply(at(3000), late).expect("it has joined");
            run.apply(at(3000), push()).expect("it is fine");
        }
    }
    let outcome = Outcome {
        outcome: "interrupted".into(),
        digest: run.simulation().digest().value(),
        end: run.simulation().now(),
    };
    writer.finish(&outcome).expect("it can be written");
}

#[test]
fn a_run_that_was_steered_is_steered_again() {
    let text = format!(
        "{SMALL}\n[[event]]\nat = \"2s\"\nkind = \"push\"\nrobot = \"holonomic0\"\nby = [-0.2, 0]\n"
    );
    let folder = folder("replay_steered");
    file(&folder, "small.toml", &text);
    let arguments = ["run", "small.toml", "--quiet", "--trace", "a.mcap"];
    starl(&folder, &arguments);
    steer(&folder, &text);
    let output = starl(&folder, &["replay", "steered.mcap"]);
    assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
}
