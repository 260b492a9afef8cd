//! Records written and read per second: the events of a race, with and without views.
//!
//! `cargo bench -p starl-trace`; one line for each case. A plain program, so that only the crate
//! itself has to be built.

#![allow(clippy::disallowed_methods)] // a measurement needs a clock

use starl_core::{Destination, Event, Payload, Point, Port, Pose, Record, RobotId, Time};
use starl_trace::{Header, Outcome, Reader, RobotEntry, ViewOptions, Writer};
use std::time::Instant;

const ROBOTS: u32 = 4;
/// The best of several is what the machine can do when nothing else runs on it.
const ROUNDS: u32 = 20;

/// Poses every 20 ms, estimates every 50 ms, and a datagram with its delivery every 100 ms.
fn race(seconds: u64) -> Vec<Record> {
    let mut records = Vec::new();
    let mut push = |at, robot, event| {
        records.push(Record {
            at: Time(at),
            robot: Some(RobotId(robot)),
            event,
        });
    };
    for step in 0..seconds * 100 {
        let at = step * 10_000_000;
        let angle = step as f64 * 0.00137;
        for robot in 0..ROBOTS {
            let reach = 1.0 + f64::from(robot) / 3.0;
            let position = Point::planar(reach * angle, reach * (1.0 - angle) / 0.7);
            let pose = Pose::level(position, angle);
            if step % 2 == 0 {
                push(at, robot, Event::Moved(pose));
            }
            if step % 5 == 0 {
                push(at, robot, Event::Estimated(pose));
            }
            if step % 10 == 0 {
                let (sequence, port) = (step as u32, Port::named("broadcast"));
                let payload = Payload::from_slice(&[7; 20]);
                push(
                    at,
                    robot,
                    Event::Sent {
                        sequence,
                        destination: Destination::All,
                        port,
                        payload,
                    },
                );
                push(
                    at,
                    (robot + 1) % ROBOTS,
                    Event::Delivered {
                        from: RobotId(robot),
                        sequence,
                    },
                );
            }
        }
    }
    records
}

fn header() -> Header {
    let robot = |id| RobotEntry {
        id: RobotId(id),
        name: format!("robot{id}"),
        model: "create".into(),
        radius: 0.17,
        height: 0.1,
        flies: false,
    };
    Header {
        robots: (0..ROBOTS).map(robot).collect(),
        ..Header::default()
    }
}

fn main() {
    let records = race(200);
    println!(
        "{} records of {ROBOTS} robots, best of {ROUNDS}",
        records.len()
    );
    for (name, options) in [
        ("records only", ViewOptions::none()),
        ("records and views", ViewOptions::default()),
    ] {
        let (mut written, mut read) = (f64::INFINITY, f64::INFINITY);
        let mut bytes = 0;
        for _ in 0..ROUNDS {
            let started = Instant::now();
            let mut writer = Writer::new(Vec::new(), &header(), &options).expect("memory");
            for record in &records {
                writer.write(record).expect("finite");
            }
            let file = writer.finish(&Outcome::default()).expect("memory");
            written = written.min(started.elapsed().as_secs_f64());
            let started = Instant::now();
            let trace = Reader::new(file.as_slice()).expect("just written");
            assert_eq!(trace.filter(Result::is_ok).count(), records.len());
            read = read.min(started.elapsed().as_secs_f64());
            bytes = file.len();
        }
        for (what, seconds) in [("write", written), ("read", read)] {
            let count = records.len() as f64;
            println!(
                "{what:5} {name:18} {:5.2} million records/s  {:4.0} ns/record  {:3.0} bytes/record",
                count / seconds / 1e6,
                seconds / count * 1e9,
                bytes as f64 / count
            );
        }
    }
}
