//! Two runs are compared to the last bit, and the first difference is named.

use crate::common;
use starl_core::{Event, Point, Pose, Record, RobotId, Time};
use starl_trace::{Comparison, Reader, TraceError, ViewOptions, first_difference};

fn moved(at: u64, robot: u32, x: f64) -> Record {
    let pose = Pose::level(Point::planar(x, 0.0), 0.0);
    Record {
        at: Time(at),
        robot: Some(RobotId(robot)),
        event: Event::Moved(pose),
    }
}

#[test]
fn equal_runs_have_no_difference() {
    assert_eq!(first_difference(common::records(), common::records()), None);
    assert_eq!(first_difference([], []), None);
}

#[test]
fn the_first_difference_names_time_robot_and_both_events() {
    let recorded = [
        moved(1, 0, 0.0),
        moved(1_500_000_000, 7, 0.1),
        moved(3, 0, 0.0),
    ];
    let rerun = [
        moved(1, 0, 0.0),
        moved(1_500_000_000, 7, 0.1 + 1e-18),
        moved(3, 0, 9.0),
    ];
    assert_eq!(0.1, 0.1 + 1e-18);
    let difference = first_difference(recorded.clone(), rerun).unwrap();
    assert_eq!(
        (difference.agreed, difference.recorded.as_ref()),
        (2, Some(&recorded[2]))
    );

    let rerun = [moved(1, 0, 0.0), moved(1_500_000_000, 7, 0.1f64.next_up())];
    let text = first_difference(recorded, rerun).unwrap().to_string();
    for part in [
        "after 1 equal",
        "1500000000 ns",
        "robot 7",
        "0.1,",
        "0.10000000000000002",
    ] {
        assert!(text.contains(part), "`{part}` is not in: {text}");
    }
}

#[test]
fn the_sign_of_zero_the_robot_and_the_time_make_a_difference() {
    let one = moved(1, 0, 0.0);
    for other in [moved(1, 0, -0.0), moved(1, 1, 0.0), moved(2, 0, 0.0)] {
        assert!(first_difference([one.clone()], [other]).is_some());
    }
    let world = Record {
        robot: None,
        ..one.clone()
    };
    assert!(first_difference([one], [world]).is_some());
}

#[test]
fn a_longer_or_shorter_run_differs() {
    let (first, second) = (moved(1, 0, 0.0), moved(2, 0, 0.0));
    let longer = first_difference([first.clone()], [first.clone(), second.clone()]).unwrap();
    assert_eq!(
        (longer.recorded.clone(), longer.rerun.clone()),
        (None, Some(second.clone()))
    );
    assert!(
        longer.to_string().contains("recorded: nothing more"),
        "{longer}"
    );
    let shorter = first_difference([first.clone(), second.clone()], [first]).unwrap();
    assert_eq!(
        (shorter.recorded, shorter.rerun, shorter.agreed),
        (Some(second), None, 1)
    );
}

#[test]
fn a_file_is_compared_during_the_run() {
    let file = common::file(&ViewOptions::default());
    let mut comparison = Comparison::new(Reader::new(file.as_slice()).unwrap());
    for record in common::records() {
        comparison.push(&record).unwrap();
    }
    assert_eq!(comparison.agreed(), common::records().len() as u64);
    assert_eq!(comparison.finish().unwrap(), None);

    let cut = &file[..file.len() / 2];
    let mut comparison = Comparison::new(Reader::new(cut).unwrap());
    let failed = common::records()
        .iter()
        .find_map(|record| comparison.push(record).err());
    assert!(
        matches!(failed, Some(TraceError::Truncated(_))),
        "{failed:?}"
    );
}
