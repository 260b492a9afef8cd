//! A written scenario is read back, equal to the last bit.

use crate::common;
use starl_core::{Event, Record, RobotId, Time, Value};
use starl_trace::{
    Header, Outcome, Reader, ViewOptions, WriteError, Writer, first_difference, read,
};

#[test]
fn every_event_is_read_back_equal() {
    for options in [ViewOptions::default(), ViewOptions::none()] {
        let trace = read(&common::file(&options)).unwrap();
        assert_eq!(trace.header, common::header());
        assert_eq!(trace.records, common::records());
        // Also where equality of numbers would not notice: zeros of either sign.
        assert_eq!(first_difference(trace.records, common::records()), None);
        assert_eq!(trace.summary.outcome, common::outcome());
        assert_eq!(trace.summary.records, common::records().len() as u64);
        assert_eq!(trace.summary.counts["pose"], common::poses().len() as u64);
    }
}

#[test]
fn records_stream_without_holding_the_file() {
    let file = common::file(&ViewOptions::default());
    let mut reader = Reader::new(file.as_slice()).unwrap();
    assert!(reader.summary().is_none());
    let records: Vec<Record> = reader.by_ref().map(Result::unwrap).collect();
    assert_eq!(records.len(), common::records().len());
    assert_eq!(reader.summary().unwrap().outcome, common::outcome());
    assert!(reader.next().is_none());
}

#[test]
fn a_run_in_which_nothing_happens_is_a_trace_too() {
    let writer = Writer::new(Vec::new(), &Header::default(), &ViewOptions::default()).unwrap();
    let trace = read(&writer.finish(&Outcome::default()).unwrap()).unwrap();
    assert_eq!(trace.header, Header::default());
    assert!(trace.records.is_empty());
}

#[test]
fn not_a_number_keeps_its_place_in_a_field() {
    let record = Record {
        at: Time(1),
        robot: None,
        event: Event::Program {
            name: "lost".into(),
            fields: [("distance".into(), Value::Float(f64::NAN))]
                .into_iter()
                .collect(),
        },
    };
    let mut writer = Writer::new(Vec::new(), &common::header(), &ViewOptions::default()).unwrap();
    writer.write(&record).unwrap();
    let trace = read(&writer.finish(&common::outcome()).unwrap()).unwrap();
    assert_eq!(first_difference(trace.records, [record]), None);
}

#[test]
fn a_pose_that_is_not_a_number_is_refused_with_its_place() {
    let mut pose = common::poses()[2];
    pose.yaw = f64::NAN;
    let mut writer = Writer::new(Vec::new(), &common::header(), &ViewOptions::default()).unwrap();
    let error = writer
        .event(Time(5), Some(RobotId(1)), &Event::Moved(pose))
        .unwrap_err();
    let expected = WriteError::NotFinite {
        at: Time(5),
        robot: Some(RobotId(1)),
        topic: "/starl/pose",
    };
    assert_eq!(error, expected);
}

#[test]
fn a_full_disk_is_an_error_not_a_panic() {
    struct Full(usize);
    impl std::io::Write for Full {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            if self.0 < bytes.len() {
                return Err(std::io::Error::other("no space left"));
            }
            self.0 -= bytes.len();
            Ok(bytes.len())
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }
    for room in (0..200_000).step_by(997) {
        let result = Writer::new(Full(room), &common::header(), &ViewOptions::default()).and_then(
            |mut writer| {
                for record in common::records() {
                    writer.write(&record)?;
                }
                writer.finish(&common::outcome()).map(|_| ())
            },
        );
        if let Err(error) = result {
            assert!(error.to_string().contains("no space left"), "{error}");
        } else {
            assert!(room > 10_000);
        }
    }
}

/// A scenario may have such an obstacle, and its trace was called damaged.
#[test]
fn a_polygon_of_many_corners_is_read_back() {
    let corner =
        |index: u32| starl_core::Point::polar(1e3, f64::from(index) * std::f64::consts::TAU / 2e4);
    let corners: Vec<starl_core::Point> = (0..20_000).map(corner).collect();
    let polygon = starl_core::ConvexPolygon::new(&corners).unwrap();
    assert!(polygon.vertices().len() > 10_000);
    let header = Header {
        obstacles: vec![starl_core::Obstacle::polygon(polygon)],
        ..common::header()
    };
    let writer = Writer::new(Vec::new(), &header, &ViewOptions::default()).unwrap();
    let trace = read(&writer.finish(&Outcome::default()).unwrap()).unwrap();
    assert_eq!(trace.header, header);
}
