//! `starl verify` recomputes the laws of the simulated world from a trace alone: each test changes one thing in the
//! trace of a good run, and the law that it breaks is the only one that is reported.

use crate::support::*;
use starl_core::event::Event;
use starl_core::{Duration, Point, Record, RobotId, Time};
use starl_trace::{Reader, ViewOptions, Writer};
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

const SCENARIO: &str = "program = \"radio\"\nduration = \"6s\"\ngoal = \"duration\"\n\
    [network]\ndelay = \"8ms\"\ndistribution = \"constant\"\nrange = \"30m\"\n\
    [[robots]]\nmodel = \"create\"\n\
    [[robots.start]]\nposition = [0, 0]\n[[robots.start]]\nposition = [4, 0]\n";

const CARS: &str = "program = \"race.starl\"\nduration = \"6s\"\ngoal = \"duration\"\n\
    [[world.way_point]]\nname = \"A\"\nposition = [8, 0]\n\
    [[robots]]\nmodel = \"car\"\n[[robots.start]]\nposition = [0, 0]\n";

/// The trace of a run of a scenario.
fn trace(folder: &Path, scenario: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let program = std::fs::read_to_string(root.join("examples/race/race.starl"));
    file(folder, "race.starl", &program.expect("the program of Race"));
    file(folder, "good.toml", scenario);
    let output = starl(
        folder,
        &["run", "good.toml", "--quiet", "--trace", "good.mcap"],
    );
    assert_ne!(status(&output), 2, "{}", stderr(&output));
    folder.join("good.mcap")
}

/// Writes a trace again with changed records, and returns the names of the properties that `verify` finds violated.
fn found(name: &str, scenario: &str, change: impl Fn(&mut Vec<Record>)) -> Vec<String> {
    let folder = folder(name);
    let path = trace(&folder, scenario);
    let file = File::open(path).expect("the run wrote a trace");
    let mut reader = Reader::new(BufReader::new(file)).expect("it can be read");
    let header = reader.header().clone();
    let records: Result<Vec<Record>, _> = (&mut reader).collect();
    let mut records = records.expect("the trace is whole");
    let summary = reader.summary().cloned().expect("the trace is whole");
    change(&mut records);
    let file = File::create(folder.join("changed.mcap")).expect("the folder can be written to");
    let mut writer = Writer::new(file, &header, &ViewOptions::none()).expect("it can be written");
    for record in &records {
        writer.write(record).expect("it can be written");
    }
    writer.finish(&summary.outcome).expect("it can be written");
    let account = json(&starl(&folder, &["verify", "changed.mcap", "--json"]));
    let entries = account["properties"].as_array().expect("a list").iter();
    let entries = entries.filter(|entry| entry["verdict"] == "violated");
    let names = entries.map(|entry| entry["property"].as_str().expect("a name").to_string());
    names.collect()
}

/// Moves all recorded poses of a robot by what `by` says for their times in seconds.
fn shift(records: &mut [Record], robot: u32, by: impl Fn(f64) -> Point) {
    for record in records {
        if let (Some(RobotId(number)), Event::Moved(pose)) = (record.robot, &mut record.event)
            && number == robot
        {
            pose.position += by(record.at.seconds());
        }
    }
}

/// The places of all deliveries.
fn deliveries(records: &[Record]) -> Vec<usize> {
    let is_one = |&index: &usize| matches!(records[index].event, Event::Delivered { .. });
    (0..records.len()).filter(is_one).collect()
}

fn sort(records: &mut [Record]) {
    records.sort_by_key(|record| record.at);
}

#[test]
fn a_good_run_keeps_all_laws() {
    for (name, scenario) in [("laws_radio", SCENARIO), ("laws_cars", CARS)] {
        assert_eq!(found(name, scenario, |_| ()), [""; 0]);
    }
}

#[test]
fn bodies_that_overlap_are_found() {
    let found = found("laws_overlap", SCENARIO, |records| {
        shift(records, 1, |_| Point::planar(-3.8, 0.0));
    });
    assert_eq!(found, ["no_collision"]);
}

#[test]
fn a_robot_that_is_too_fast_is_found() {
    // A Create goes half a metre a second at the most.
    let found = found("laws_speed", SCENARIO, |records| {
        shift(records, 1, |second| Point::planar(0.6 * second, 0.0));
    });
    assert_eq!(found, ["speed_limit"]);
}

#[test]
fn a_car_that_gathers_speed_too_fast_is_found() {
    let found = found("laws_acceleration", CARS, |records| {
        // Backwards and forwards by 2 cm in 0.2 s: slow, but with 2 m/s2 more than the car has at most.
        shift(records, 0, |second| {
            let beat = (second * 10.0).round() as i64 % 2;
            Point::planar(0.0, 0.03 * beat as f64)
        });
    });
    assert_eq!(found, ["acceleration_limit"]);
}

#[test]
fn a_robot_that_turns_too_fast_is_found() {
    let found = found("laws_turn", SCENARIO, |records| {
        for record in records {
            if let Event::Moved(pose) = &mut record.event {
                pose.yaw += 5.0 * record.at.seconds();
            }
        }
    });
    assert_eq!(found, ["turn_rate_limit"]);
}

#[test]
fn delays_that_the_network_does_not_have_are_found() {
    // All links take 8 ms, and the network's resolution is 1 ms.
    for late in [Duration::from_millis(2), Duration::from_millis(600)] {
        let found = found("laws_delay", SCENARIO, |records| {
            let place = *deliveries(records).last().expect("a delivery");
            records[place].at += late;
            sort(records);
        });
        assert_eq!(found, ["datagram_delay"], "{late}");
    }
    let found = found("laws_early", SCENARIO, |records| {
        let place = deliveries(records)[3];
        records[place].at = Time(records[place].at.0 - 1_000_000);
        sort(records);
    });
    assert_eq!(found, ["datagram_delay"]);
}

#[test]
fn datagrams_that_overtake_where_none_can_are_found() {
    // A datagram is on its way for longer than it takes until the next one.
    let slow = SCENARIO.replace("8ms", "250ms");
    let found = found("laws_overtaking", &slow, |records| {
        let from_first = |place: &usize| records[*place].robot == Some(RobotId(1));
        let places: Vec<usize> = deliveries(records).into_iter().filter(from_first).collect();
        let (first, second) = (places[0], places[1]);
        let event = records[first].event.clone();
        records[first].event = std::mem::replace(&mut records[second].event, event);
    });
    assert_eq!(found, ["datagram_delay", "datagram_order"]);
}

#[test]
fn records_out_of_order_are_found() {
    let found = found("laws_order", SCENARIO, |records| {
        let middle = records.len() / 2;
        let later = (middle..).find(|&place| records[place].at > records[middle].at);
        records.swap(middle, later.expect("time goes on"));
    });
    assert!(found.contains(&"datagram_order".to_string()), "{found:?}");
}

#[test]
fn duplicate_and_unsent_datagrams_are_found() {
    let found_twice = found("laws_twice", SCENARIO, |records| {
        let place = deliveries(records)[0];
        records.insert(place, records[place].clone());
    });
    assert_eq!(found_twice, ["datagram_integrity"]);
    let found = found("laws_nowhere", SCENARIO, |records| {
        for place in deliveries(records) {
            if let Event::Delivered { sequence, .. } = &mut records[place].event {
                *sequence += 10_000;
            }
        }
    });
    assert_eq!(found, ["datagram_integrity"]);
}

#[test]
fn datagrams_from_out_of_range_are_found() {
    let near = SCENARIO.replace("30m", "6m");
    let found = found("laws_range", &near, |records| {
        shift(records, 1, |_| Point::planar(5.0, 0.0));
    });
    assert_eq!(found, ["datagram_range"]);
}
